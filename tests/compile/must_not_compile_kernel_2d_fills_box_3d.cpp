// expect: spate: the box has another number of dimensions than the kernel
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

void scene()
{
    Simulation s(wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, PressureForce<2>{}),
                 RungeKutta2{}, Open{});
    s.fill(Box<3>{{0, 0, 0}, {1, 1, 1}}, 0.01);
}
