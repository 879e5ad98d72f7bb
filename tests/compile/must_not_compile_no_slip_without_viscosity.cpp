// expect: spate: no_slip acts in viscous terms, and the model has none
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

void scene()
{
    auto water = wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, PressureForce<2>{});
    Simulation s(water, RungeKutta2{}, Bce(Box<2>{{0, 0}, {1, 1}}, 0.01, Adami{}, no_slip));
    s.step({});
}
