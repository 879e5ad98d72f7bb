// SPDX-License-Identifier: BSD-3-Clause
// The seed's study of the cell size, with all that has a say beside it: edge of a cell, shape of a bin, skin, h/dx. None
// of them changes a bit of the result at equal bins; here is what they cost.
#include "support/least.hpp"
#include "support/scenes.hpp"
#include "support/stages.hpp"

using namespace bench;

namespace {

constexpr int n = 40; // particles along an edge: 64,000

/// A step of the dam break, whose fastest flow is c0/10, with cfl 0.2: two evaluations by midpoint. Two particles close in
/// by the diagonal of the box of all displacements: between one and two times the fastest flow; one and a half is taken.
double evaluations_of_a_list(double skin)
{
    constexpr double support = 2, cfl = 0.2, fastest = 0.1, closing = 1.5; // [h], [-], [c0], [fastest]
    const double a_step = closing * fastest * cfl / (1 + fastest);         // [h]
    return 2 * std::max(1.0, std::floor(skin * support / a_step));
}

void cell_size(benchmark::State& state)
{
    const double skin = 1e-3 * double(state.range(2)), h = 0.1 * double(state.range(3));
    auto sim = block(n,
                     water(h, Continuity<2>{}, DensityDiffusion{.delta = 0.1}, PressureForce<2>{},
                           ArtificialViscosity{.alpha = 0.1}, Gravity<3>{{0, 0, -g}}),
                     RungeKutta2{}, Double{}, {.skin = skin, .finer = int(state.range(1))}, int(state.range(0)));
    auto& s = sim.system();
    SweepsOf sweeps(s);
    Least rebuild, sweep;
    for (auto _ : state) {
        rebuild.of([&] { s.rebuild(); });
        sweep.of([&] { sweeps.run(); });
        sweep.of([&] { sweeps.run(); });
    }
    const double particles = double(s.total());
    auto& c = state.counters;
    c["sweep_ns"] = sweep.ns(particles);
    c["rebuild_ns"] = rebuild.ns(particles);
    c["sweep_ns_pair"] = sweep.ns(double(s.pairs()));
    c["pairs"] = double(s.pairs()) / particles;
    c["slots_pair"] = slots(s) / double(s.pairs());
    c["flow_ns"] = sweep.ns(particles) + rebuild.ns(particles) / evaluations_of_a_list(skin);
}
BENCHMARK(cell_size)
    ->ArgNames({"cell", "finer", "skin_permille", "h_tenths"})
    ->ArgsProduct({{1, 2, 4, 8, 16}, {1, 2, 4, 8}, {30, 70, 120, 200}, {12, 13, 15}})
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

} // namespace
