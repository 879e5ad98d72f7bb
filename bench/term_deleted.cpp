// SPDX-License-Identifier: BSD-3-Clause
// One term deleted from the scene: the sweep over the same block of water with all terms, and with each of them left out.
// bench/instructions.py counts the instructions of the same sweeps in this executable.
#include "support/least.hpp"
#include "support/scenes.hpp"
#include "support/stages.hpp"

using namespace bench;

namespace {

constexpr int n = 40; // particles along an edge
const Continuity<2> continuity;
const PressureForce<2> pressure_force;
const DensityDiffusion diffusion{.delta = 0.1};
const ArtificialViscosity viscosity{.alpha = 0.1};
const Gravity<3> gravity{{0, 0, -g}};

/// All sweeps turn by turn, so that a slow moment of the machine meets all of them.
void term_deleted(benchmark::State& state)
{
    auto all = block(n, water(1.2, continuity, diffusion, pressure_force, viscosity, gravity));
    auto no_viscosity = block(n, water(1.2, continuity, diffusion, pressure_force, gravity));
    auto no_diffusion = block(n, water(1.2, continuity, pressure_force, viscosity, gravity));
    auto neither = block(n, water(1.2, continuity, pressure_force, gravity));
    SweepsOf sweep_all(all.system());
    SweepsOf sweep_no_viscosity(no_viscosity.system());
    SweepsOf sweep_no_diffusion(no_diffusion.system());
    SweepsOf sweep_neither(neither.system());
    Least t_all, t_no_viscosity, t_no_diffusion, t_neither;
    for (auto _ : state) {
        t_all.of([&] { sweep_all.run(); });
        t_no_viscosity.of([&] { sweep_no_viscosity.run(); });
        t_no_diffusion.of([&] { sweep_no_diffusion.run(); });
        t_neither.of([&] { sweep_neither.run(); });
    }
    const double pairs = double(all.system().pairs());
    auto& c = state.counters;
    c["all_ns_pair"] = t_all.ns(pairs);
    c["no_viscosity_ns_pair"] = t_no_viscosity.ns(pairs);
    c["no_diffusion_ns_pair"] = t_no_diffusion.ns(pairs);
    c["neither_ns_pair"] = t_neither.ns(pairs);
}
BENCHMARK(term_deleted)->Iterations(40)->Unit(benchmark::kMillisecond);

} // namespace
