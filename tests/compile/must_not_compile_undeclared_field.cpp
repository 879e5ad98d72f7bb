// expect: spate: the term uses a field that it does not declare
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

struct Drag {
    static constexpr Fields adds{acceleration};
    void operator()(auto& i) const { i[acceleration] -= 0.1 * i[velocity]; }
};
void scene()
{
    Simulation s(wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Drag{}), RungeKutta2{}, Open{});
    s.step({});
}
