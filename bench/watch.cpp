// SPDX-License-Identifier: BSD-3-Clause
// What the watch costs: whole steps of the same scene with it and without, turn by turn.
#include "support/least.hpp"

#include <spate/spate.hpp>

#include <benchmark/benchmark.h>

using namespace bench;
using namespace spate;

namespace {

constexpr int steps = 320; // a look at a calm energy, some rebuilds

template <class W>
auto dam(W watch)
{
    constexpr double dx = 0.005;
    Simulation sim(wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 30}, Continuity<2>{},
                         DensityDiffusion{}, PressureForce<2>{}, ArtificialViscosity{.alpha = 0.02},
                         Gravity<2>{{0, -9.81}}),
                   Leapfrog{}, Bce(Box<2>{{0, 0}, {2, 1}}, dx, ByContinuity{}, open(top)), Serial{}, Double{}, watch);
    sim.fill(Box<2>{{0, 0}, {1, 0.5}}, dx, hydrostatic);
    return sim;
}
template <class W>
auto gas(W watch)
{
    constexpr double r = 0.01;
    constexpr int n = 150;
    Simulation sim(dem<2>({.mass = 0.1, .radius = r}, LinearSpring{.k = 1e5}), Leapfrog{},
                   Periodic(Box<2>{{0, 0}, {2.5 * r * n, 2.5 * r * n}}), Serial{}, Double{}, watch);
    std::uint64_t state = 1;
    auto u = [&] {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return 2 * double(state >> 11) / double(std::uint64_t(1) << 53) - 1;
    };
    for (int k = 0; k < n * n; ++k) sim.add({(k % n + 0.5) * 2.5 * r, (k / n + 0.5) * 2.5 * r}, {u(), u()});
    return sim;
}
void compare(benchmark::State& state, auto with, auto without)
{
    with.run({.steps = steps}), without.run({.steps = steps}); // the first looks, which are frequent
    auto go = [](auto& sim) {
        for (int k = 0; k < steps; ++k) sim.step({});
    };
    Least t_with, t_without;
    for (auto _ : state) {
        t_with.of([&] { go(with); });
        t_without.of([&] { go(without); });
    }
    const double n = double(steps) * double(with.particles().size());
    state.counters["with_ns"] = t_with.ns(n);
    state.counters["without_ns"] = t_without.ns(n);
    state.counters["cost_percent"] = 100 * (t_with.ns(n) / t_without.ns(n) - 1);
}
void watch_of_a_dam(benchmark::State& state) { compare(state, dam(Watch{}), dam(NoWatch{})); }
void watch_of_grains(benchmark::State& state) { compare(state, gas(Watch{}), gas(NoWatch{})); }
BENCHMARK(watch_of_a_dam)->Iterations(12)->Unit(benchmark::kMillisecond);
BENCHMARK(watch_of_grains)->Iterations(30)->Unit(benchmark::kMillisecond);

} // namespace
