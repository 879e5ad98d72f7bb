// expect: spate: the term uses a field of j that it does not declare; name it in reads or reads_j, for an interaction in its reads; a pair term changes i only
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

struct ActionAndReaction {
    static constexpr Fields reads{velocity};
    static constexpr Fields adds{acceleration};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        i[acceleration] -= ij.w * i[velocity];
        j[acceleration] += ij.w * i[velocity];
    }
};
void scene()
{
    Simulation s(wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, ActionAndReaction{}), RungeKutta2{},
                 Open{});
    s.step({});
}
