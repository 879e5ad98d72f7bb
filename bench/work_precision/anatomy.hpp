// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What a feature costs where it is named: whole evaluations and rebuilds of a jittered periodic block in 3D, cubic
/// spline with h = 1.3 dx, midpoint; figure W9 (numerics A.13). There is no error here: the figures stand in its place.
#pragma once

#include "family.hpp"

#include <limits>
#include <random>

namespace work_precision {

/// Continuity, pressure force, Tait, and what else is named.
template <class Precision, class... Term>
void add_feature(std::string const& name, Term... term)
{
    auto run = [=](Setting const& s) {
        const double dx = 1.0 / s.n, c0 = 10;
        const Box<3> box{{0, 0, 0}, {1, 1, 1}};
        const auto fluid = wcsph(CubicSpline<3>{.h = 1.3 * dx}, Tait{.rho0 = 1, .c0 = c0}, Continuity<2>{},
                                 PressureForce<2>{}, term...);
        Simulation scene(fluid, RungeKutta2{}, Periodic(box), Threads{s.threads, s.cell}, Precision{}, Watch{},
                         lists_of(s, fluid.interaction.neighbours));
        std::mt19937_64 dice(1);
        auto draw = [&] { return double(dice() >> 11) * 0x1p-52 - 1; };
        scene.fill(box, dx, [&](auto& p, std::size_t i) {
            auto x = p.at(position, i);
            for (int c = 0; c < 3; ++c) x[c] += 0.2 * dx * draw();
            p.put(position, i, x), p.put(velocity, i, {0.1 * draw(), 0.1 * draw(), 0.1 * draw()});
        });
        auto& system = scene.system();
        auto least = [&](auto const& call) { // of many turns: the rest is who else was busy
            double best = std::numeric_limits<double>::infinity();
            for (int turn = 0; turn < 20; ++turn) {
                const std::clock_t start = std::clock();
                call();
                best = std::min(best, double(std::clock() - start) / CLOCKS_PER_SEC);
            }
            return best;
        };
        const double dt = 1e-6 * dx / c0; // particles stay where they are
        scene.step({.dt = dt});
        const std::int64_t pairs = system.pairs();
        const double step = least([&] { scene.step({.dt = dt}); }), rates = least([&] { system.rates(system.all); });
        const double rebuild = least([&] { system.rebuild(true); });
        Outcome o;
        o.particles = system.total(), o.steps = scene.steps(), o.force_evals = 2 * o.steps;
        o.pairs = pairs, o.dt = dt, o.wall = o.cpu = step;
        const auto n = double(o.particles), all = double(pairs);
        o.errors = {{"rates_ns_pair", 1e9 * rates / all},
                    {"step_ns_particle", 1e9 * step / n},
                    {"rebuild_ns_particle", 1e9 * rebuild / n},
                    {"pairs_a_particle", all / n}};
        return o;
    };
    families().push_back({"anatomy", "cubic_spline", 1.3, name, "runge_kutta2", precision_name<Precision>(), run});
}

} // namespace work_precision
