// SPDX-License-Identifier: BSD-3-Clause
// The engine's sweep against the same sums written by hand: same records, same lists, one thread, turn by turn.
// The demand (numerics A.13 iv): at most 1.02 of the hand-written loop.
#include "hand_loop.hpp"

#include <spate/spate.hpp>

#include <benchmark/benchmark.h>

#include <cstdio>
#include <ctime>
#include <random>

using namespace spate;

namespace {

constexpr int n = 44; // particles along an edge: 85,184
constexpr double dx = 0.01, c0 = 40, mu = 1e-3;

/// A block, jittered by a fifth of the spacing, with speeds and densities at random.
auto block()
{
    Simulation s(wcsph(CubicSpline<3>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = c0}, Continuity<2>{}, PressureForce<2>{},
                       LaminarViscosity{.mu = mu}),
                 RungeKutta2{}, Open{}, Serial{});
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> any(-1, 1);
    s.fill(Box<3>{{0, 0, 0}, {n * dx, n * dx, n * dx}}, dx, [&](auto& p, std::size_t i) {
        auto x = p.at(position, i);
        for (int c = 0; c < 3; ++c) x[c] += 0.2 * dx * any(random);
        p.put(position, i, x);
        p.put(velocity, i, {any(random), any(random), any(random)});
        p.put(density, i, 1000 * (1 + 0.01 * any(random)));
    });
    s.system().rebuild();
    s.system().rates(s.system().all); // fills pressure and the records
    return s;
}

template <class S>
struct Engine {
    using System = typename S::Engine;
    using M = typename System::M;
    using V = typename System::V;
    // Terms that one sweep fuses: all but the equation of state.
    static constexpr Mask terms = 0b1110;
    static constexpr auto sums = Fields{density_rate, acceleration};
    static constexpr auto target = Fields{position, velocity, density, pressure};

    static void sweep(System& s)
    {
        auto& fluid = s.template species<0>();
        using P = std::remove_cvref_t<decltype(fluid.particles)>;
        using R = std::remove_cvref_t<decltype(fluid.packed)>;
        const Source<terms, Fields<>, P, R> source{fluid.particles, fluid.packed, s.template lists<0, 0>(), true,
                                                   nullptr};
        for (std::size_t cell = 0; cell < fluid.bins.cells(); ++cell)
            sweep_cell<V, terms, Set<sums>, Set<target>>(s.physics().interaction, s.terms(), fluid.particles,
                                                         fluid.bins, cell, false, source);
    }
};

double cpu_seconds()
{
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}
double seconds_of(auto const& f)
{
    const double start = cpu_seconds();
    f();
    return cpu_seconds() - start;
}

void hand_loop(benchmark::State& state)
{
    auto sim = block();
    auto& s = sim.system();
    auto& p = s.mobile();
    auto& fluid = s.species<0>();
    using L = typename std::remove_cvref_t<decltype(fluid.packed)>::L;
    static_assert(L::stride == 8 && L::offset<Position> == 0 && L::offset<Velocity> == 3 && L::offset<Density> == 6 &&
                  L::offset<Pressure> == 7);
    static_assert(hand::width == width<typename Engine<decltype(sim)>::V>);

    Array<double> out[4];
    for (auto& a : out) a.assign(p.size(), 0);
    auto const& x = p.column(position);
    auto const& u = p.column(velocity);
    const CubicSpline<3> kernel{.h = 1.2 * dx};
    const hand::Scene scene{.record = fluid.packed.data.data(),
                            .x = x[0].data(),
                            .y = x[1].data(),
                            .z = x[2].data(),
                            .u = u[0].data(),
                            .v = u[1].data(),
                            .w = u[2].data(),
                            .rho = p.column(density)[0].data(),
                            .p = p.column(pressure)[0].data(),
                            .drho = out[0].data(),
                            .ax = out[1].data(),
                            .ay = out[2].data(),
                            .az = out[3].data(),
                            .h = kernel.h,
                            .sigma = kernel.sigma(),
                            .mass = p.value(mass),
                            .mu = mu,
                            .eps = 0.01};
    auto by_hand = [&] {
        for (std::size_t cell = 0; cell < fluid.bins.cells(); ++cell) {
            auto const& lists = s.lists<0, 0>().of_cell(cell);
            const auto first = fluid.bins.begin(cell);
            hand::sweep(scene, {.begin = lists.begin.data(),
                                .target = lists.target.data(),
                                .place = lists.index.data(),
                                .blocks = lists.begin.size() - 1,
                                .first = first,
                                .targets = fluid.bins.end(cell) - first});
        }
    };
    auto by_engine = [&] { Engine<decltype(sim)>::sweep(s); };

    double hand_best = 1e9, engine_best = 1e9;
    for (auto _ : state) {
        hand_best = std::min(hand_best, seconds_of(by_hand));
        engine_best = std::min(engine_best, seconds_of(by_engine));
    }

    double worst = 0;
    auto compare = [&](Array<double> const& a, Array<double> const& b) {
        double scale = 0, off = 0;
        for (std::size_t i = 0; i < p.size(); ++i)
            scale = std::max(scale, std::abs(b[i])), off = std::max(off, std::abs(a[i] - b[i]));
        worst = std::max(worst, off / scale);
    };
    compare(p.column(density_rate)[0], out[0]);
    for (std::size_t c = 0; c < 3; ++c) compare(p.column(acceleration)[c], out[c + 1]);
    if (!(worst < 1e-12)) state.SkipWithError("the hand-written sums differ from the engine's");

    const double pairs = double(s.pairs()), slots = double(s.lists<0, 0>().slots());
    state.counters["engine_ns_pair"] = 1e9 * engine_best / pairs;
    state.counters["hand_ns_pair"] = 1e9 * hand_best / pairs;
    state.counters["ratio"] = engine_best / hand_best;
    state.counters["engine_ns_slot"] = 1e9 * engine_best / slots;
    state.counters["hand_ns_slot"] = 1e9 * hand_best / slots;
    state.counters["pairs_a_particle"] = pairs / double(p.size());
    state.counters["difference"] = worst;
}
BENCHMARK(hand_loop)->Iterations(60)->Unit(benchmark::kMillisecond);

} // namespace
