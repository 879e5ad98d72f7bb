// SPDX-License-Identifier: BSD-3-Clause
// What is run on many ranks, whatever the transport: program(backend) for each scene, and the bits of one rank.
#pragma once

#include "simulation/scenes.hpp"

#include <functional>

namespace ranked {

using namespace spate;

inline constexpr struct Age : ScalarField {
    static constexpr std::string_view name = "age", unit = "1";
} age{};

/// A push that grows with each evaluation that a contact has lived: it remembers pairs.
struct GrowingPush {
    static constexpr Fields adds{acceleration};
    static constexpr Fields keeps{age};
    double unit; ///< [m/s^2]
    void operator()(auto& i, auto const&, auto const& ij) const
    {
        i[age] += 1;
        i[acceleration] += (unit * i[age]) * ij.n;
    }
};

/// Discs that remember their contacts: columns in touch, stirred by others that pass at speed.
template <class Backend>
scenes::Outcome crowd(Backend backend)
{
    constexpr double r = 0.01;
    Simulation box(dem<2>({.mass = 0.1, .radius = r}, LinearSpring{.k = 2e3}, GrowingPush{1e-3}), SymplecticEuler{},
                   Periodic(Box<2>{{0, 0}, {1, 1}}), backend, Double{}, NoWatch{});
    for (int k = 0; k < 300; ++k) box.add({0.15 + 1.9 * r * (k % 15), 0.05 + 0.045 * (k / 15)}, {0.002 * (k % 7), 0});
    for (int k = 0; k < 40; ++k) box.add({0.6 + 0.03 * (k % 10), 0.1 + 0.2 * (k / 10)}, {0.3, 4.0 + 0.02 * k});
    box.run({.steps = 400, .dt = 1e-4});
    return {box.state_hash(), box.system().rebuilds()};
}

template <class Backend>
scenes::Outcome dam(Backend backend, std::int64_t steps = 1500)
{
    return scenes::dam_break(RungeKutta2{}, Adami{}, backend, scenes::usual, steps);
}

/// A dam break with density re-initialisation every 20 steps: a phase that reads neighbours outside of evaluations.
template <class Backend>
scenes::Outcome smoothed_dam(Backend backend)
{
    constexpr double dx = 0.02, g = 9.81;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 10 * std::sqrt(2 * g * 0.4)},
                       Continuity<2>{}, PressureForce<2>{}, ArtificialViscosity{.alpha = 0.05},
                       DensityReinit<Shepard>{.every = 20}, Gravity<2>{{0, -g}});
    Bce tank(Box<2>{{}, {{0.8, 0.6}}}, dx, ByContinuity{}, open(top));
    Simulation sim(water, Leapfrog{}, tank, backend);
    sim.fill(Box<2>{{}, {{0.3, 0.4}}}, dx, hydrostatic);
    return scenes::outcome(sim, 800);
}

} // namespace ranked
