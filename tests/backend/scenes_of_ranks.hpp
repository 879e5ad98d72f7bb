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

/// Grains with friction in a box whose walls have it too.
template <class Backend>
auto hopper_box(Backend backend)
{
    constexpr double r = 0.01;
    const LinearSpring spring{.k = 2e4};
    const Friction friction{.mu = 0.5};
    Simulation box(dem<2>({.mass = 0.1, .radius = r}, spring, Dashpot{.e = 0.5}, friction, Gravity<2>{{0, -9.81}}),
                   Leapfrog{}, Walls(Box<2>{{0, 0}, {0.6, 0.8}}, contact(spring, friction)), backend);
    for (int k = 0; k < 200; ++k)
        box.add({0.02 + 2.1 * r * (k % 20) + 1e-4 * (k / 20), 0.02 + 2.1 * r * (k / 20)}, {0.1, -0.5});
    return box;
}
inline auto hopper_pour()
{
    return Pour(Box<2>{{0.1, 0.5}, {0.5, 0.7}}, {.rate = 2000, .velocity = {0, -2}, .apart = 0.02, .every = 7});
}
inline auto hopper_outlet() { return Outlet(Box<2>{{-0.1, -0.1}, {0.08, 0.06}}, {.every = 11}); }

/// They are poured in, pile up, and run out of one corner.
template <class Backend>
scenes::Outcome hopper(Backend backend)
{
    auto box = hopper_box(backend);
    auto pour = hopper_pour();
    auto outlet = hopper_outlet();
    box.run({.steps = 600, .dt = 2e-4}, pour, outlet);
    auto bits = std::bit_cast<std::uint64_t>(box.exchanged().energy());
    bits ^= std::uint64_t(pour.particles()) << 32 ^ std::uint64_t(outlet.particles()) << 48;
    return {box.state_hash() + 31 * bits,
            outlet.particles() > 5 && pour.particles() > 100 ? box.system().rebuilds() : 0};
}

/// A column of water falls over; its density is made smooth again every 20 steps.
template <class Precision = Double, class Backend>
auto column(Backend backend, double dx = 0.02, Neighbours neighbours = scenes::usual)
{
    constexpr double g = 9.81, height = 0.4;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 10 * std::sqrt(2 * g * height)},
                       Continuity<2>{}, DensityDiffusion{.delta = 0.1}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.05}, DensityReinit<Shepard>{.every = 20}, Gravity<2>{{0, -g}});
    Bce tank(Box<2>{{}, {{0.8, 0.6}}}, dx, Adami{}, open(top));
    Simulation sim(water, RungeKutta2{}, tank, backend, Precision{}, Watch{}, neighbours);
    sim.fill(Box<2>{{}, {{0.3, height}}}, dx, hydrostatic);
    return sim;
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
