// expect: spate: the term changes a field that it only reads
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

struct Stop_j {
    static constexpr Fields reads{velocity};
    static constexpr Fields adds{acceleration};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        i[acceleration] -= ij.w * i[velocity];
        j[velocity] -= ij.w * i[velocity];
    }
};
void scene()
{
    Simulation s(wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Stop_j{}), RungeKutta2{}, Open{});
    s.step({});
}
