// expect: spate: a term reads a field that nothing provides
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

void scene()
{
    Simulation s(
        physics(Smoothing<CubicSpline<2>>{{.h = 0.012}}, Uniform{mass, 0.1}, Continuity<2>{}, PressureForce<2>{}),
        RungeKutta2{}, Open{});
    s.step({});
}
