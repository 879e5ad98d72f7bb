// SPDX-License-Identifier: BSD-3-Clause
// One scene under a watch and without: check.sh compares the instructions of its sweeps, and the bits of its state.
#include <spate/spate.hpp>

#include <cstdio>

using namespace spate;

int main()
{
    constexpr double dx = 0.02;
    Simulation dam(wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 20}, Continuity<2>{},
                         DensityDiffusion{}, PressureForce<2>{}, ArtificialViscosity{.alpha = 0.02},
                         Gravity<2>{{0, -9.81}}),
                   RungeKutta2{}, Bce(Box<2>{{0, 0}, {0.6, 0.4}}, dx, Adami{}, open(top)), Serial{}, Double{}, WATCH{});
    dam.fill(Box<2>{{0, 0}, {0.2, 0.2}}, dx, hydrostatic);
    dam.run({.steps = 100});
    std::printf("%016lx\n", dam.state_hash());
}
