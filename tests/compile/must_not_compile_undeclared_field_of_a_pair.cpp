// expect: spate: the term uses a field of j that it does not declare
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

struct Alignment {
    static constexpr Fields reads_i{velocity};
    static constexpr Fields adds{acceleration};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        i[acceleration] -= ij.w * (i[velocity] - j[velocity]);
    }
};
void scene()
{
    Simulation s(wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Alignment{}), RungeKutta2{}, Open{});
    s.step({});
}
