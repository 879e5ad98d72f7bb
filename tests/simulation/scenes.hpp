// SPDX-License-Identifier: BSD-3-Clause
// Small scenes that run until their lists have been rebuilt many times, for tests of what their bits depend on.
#pragma once

#include "spate/spate.hpp"

#include <random>

namespace scenes {

using namespace spate;

struct Outcome {
    std::uint64_t hash = 0;
    std::int64_t rebuilds = 0;
};
/// \param piece  steps of one call of run
inline Outcome outcome(auto& sim, std::int64_t steps, std::int64_t piece = 1 << 30)
{
    while (sim.steps() < steps) sim.run({.steps = std::min(piece, steps - sim.steps()), .cfl = 0.2});
    return {sim.state_hash(), sim.system().rebuilds()};
}

inline constexpr Neighbours usual = Smoothing<CubicSpline<2>>::neighbours;

/// A column of water 0.3 m by 0.4 m falls over in a tank of 0.8 m.
template <class Precision = Double, class W = Watch, class I, class State, class Backend>
Outcome dam_break(I integrator, State state, Backend backend, Neighbours neighbours = usual, std::int64_t steps = 1500)
{
    constexpr double dx = 0.02, g = 9.81, height = 0.4;
    const double c0 = 10 * std::sqrt(2 * g * height);
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = c0}, Continuity<2>{},
                       DensityDiffusion{.delta = 0.1}, PressureForce<2>{}, ArtificialViscosity{.alpha = 0.05},
                       Gravity<2>{{0, -g}});
    Bce tank(Box<2>{{}, {{0.8, 0.6}}}, dx, state, open(top));
    Simulation sim(water, integrator, tank, backend, Precision{}, W{}, neighbours);
    sim.fill(Box<2>{{}, {{0.3, height}}}, dx, hydrostatic);
    return outcome(sim, steps);
}

/// Vortices in a periodic cube.
template <class W = Watch, class Precision = Double, class Backend>
Outcome vortices(Backend backend, Neighbours neighbours = usual, std::int64_t piece = 1 << 30)
{
    constexpr int n = 10;
    const Box<3> box{{}, {{n, n, n}}};
    auto fluid = wcsph(CubicSpline<3>{.h = 1.2}, LinearEos{.rho0 = 1, .c0 = 15}, Continuity<1>{}, PressureForce<1>{},
                       LaminarViscosity{.mu = 0.05});
    Simulation sim(fluid, Leapfrog{}, Periodic(box), backend, Precision{}, W{}, neighbours);
    sim.fill(box, 1, [&](auto& p, std::size_t i) {
        const auto x = p.at(position, i);
        auto wave = [](double y) { // a parabola for each half wave: the same bits with every libm
            const double s = y / (n / 2.0), t = s < 1 ? s : s - 1;
            return (s < 1 ? 4 : -4) * t * (1 - t);
        };
        p.put(velocity, i, {{wave(x[1]), wave(x[2]), wave(x[0])}});
    });
    return outcome(sim, 200, piece);
}

/// Discs that bounce off each other in a periodic box.
template <class W = Watch, class Precision = Double, class Backend>
Outcome discs(Backend backend, Neighbours neighbours = Discs::neighbours)
{
    constexpr int side = 20;
    constexpr double r = 0.01, pitch = 2.3 * r;
    const Box<2> box{{}, {{side * pitch, side * pitch}}};
    Simulation sim(dem<2>({.mass = 0.1, .radius = r}, LinearSpring{.k = 1e5}), SymplecticEuler{}, Periodic(box),
                   backend, Precision{}, W{}, neighbours);
    std::mt19937 random(3);
    auto uniform = [&] { return double(random()) / 2147483648.0 - 1; };
    for (int n = 0; n < side * side; ++n)
        sim.add({{(n % side + 0.5) * pitch, (n / side + 0.5) * pitch}}, {{uniform(), uniform()}});
    return outcome(sim, 1000);
}

} // namespace scenes
