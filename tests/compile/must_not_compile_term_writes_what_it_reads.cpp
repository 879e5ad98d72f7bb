// expect: spate: the term changes a field that it only reads
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

struct Limiter {
    static constexpr Fields reads{density};
    static constexpr Fields writes{pressure};
    void operator()(auto& i) const { i[density] = 1000; }
};
void scene()
{
    Simulation s(
        wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, PressureForce<2>{}, Limiter{}),
        RungeKutta2{}, Open{});
    s.step({});
}
