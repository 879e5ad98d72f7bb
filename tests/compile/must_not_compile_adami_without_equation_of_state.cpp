// expect: spate: Adami needs an equation of state in the model
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

void scene()
{
    Simulation s(physics(Smoothing<CubicSpline<2>>{{.h = 0.012}}, Uniform{mass, 0.1}, Continuity<2>{}), RungeKutta2{},
                 Bce(Box<2>{{0, 0}, {1, 1}}, 0.01, Adami{}));
    s.step({});
}
