// SPDX-License-Identifier: BSD-3-Clause
// Two discs meet head-on (the granular seed's: numerics V44, C.2, figure W6): m = 0.1 kg, r = 0.01 m, k = 1e5 N/m, 1 m/s. The
// contact is met at 64 phases of the step; the ladder is in omega dt.
#include "family.hpp"

#include <cmath>
#include <numbers>

namespace work_precision {
namespace {

constexpr double m = 0.1, r = 0.01, k = 1e5, v = 1; // [kg], [m], [N/m], [m/s]
const double omega = std::sqrt(2 * k / m);          // [1/s]

template <class I>
void add()
{
    auto run = [](Setting const& s) {
        constexpr int phases = 64;
        const double dt = s.omega_dt / omega;
        // skin > 0: the watch as it is; else it only looks
        const Watch watch{.energy_every = 1, .warn = 1e9, .stop = s.skin > 0 ? 0.05 : 1e9, .calm = 1};
        Outcome all;
        double squares = 0, energy = 0;
        try {
            for (int phase = 0; phase < phases; ++phase) {
                Simulation scene(dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k}), I{}, Open{}, Serial{},
                                 Double{}, watch);
                const double gap = v * dt * (phase + 0.5) / phases;
                scene.add({-r - gap / 2, 0}, {v / 2, 0});
                scene.add({r + gap / 2, 0}, {-v / 2, 0});
                auto apart = [&] {
                    auto const& p = scene.particles();
                    const auto x = p.at(position, 1) - p.at(position, 0), u = p.at(velocity, 1) - p.at(velocity, 0);
                    return scene.steps() > 1 && x.squaredNorm() > 4 * r * r && x.dot(u) > 0;
                };
                scene.interrupt_when(apart);
                const double before = scene.energy().kinetic;
                scene.run({.until = 100 * std::numbers::pi / omega, .dt = dt});
                const double after = scene.energy().kinetic;
                squares += std::pow(std::sqrt(after / before) - 1, 2) / phases, energy += (after / before - 1) / phases;
                auto const& report = scene.report();
                all.particles = 2, all.dt = dt, all.steps += report.steps;
                all.force_evals += report.steps * I::evaluations, all.pairs += 2 * report.steps * I::evaluations;
                all.wall += report.wall, all.cpu += report.cpu;
            }
            all.errors = {{"restitution", std::sqrt(squares)}, {"energy_a_contact", std::abs(energy)}};
        }
        catch (Stop const& stop) {
            all.status = stop.name();
            all.particles = 2, all.dt = dt;
        }
        return all;
    };
    families().push_back({"contact", "none", 0, "linear_spring", I::name, "double", run});
}
const bool added = (add<ForwardEuler>(), add<SymplecticEuler>(), add<RungeKutta2>(), add<Leapfrog>(), true);

} // namespace
} // namespace work_precision
