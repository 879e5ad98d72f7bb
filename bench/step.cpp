// SPDX-License-Identifier: BSD-3-Clause
// What whole steps cost, and how far they are from the arithmetic: the figures to reach. The developed flow is computed by
// the first run (about two minutes) and kept in build/bench.
#include "support/developed.hpp"
#include "support/from_l1.hpp"

using namespace bench;

namespace {

template <class Precision>
auto developed_dam(int threads)
{
    auto dam = big_dam(threads, Precision{});
    Developed::flow().put_into(dam);
    return dam;
}

/// Full steps from t = 0.30 to 0.32 s, rebuilds and all else counted.
template <class Precision>
void dam_break_big(benchmark::State& state)
{
    const int threads = int(state.range(0));
    Developed::flow();
    Cost cost;
    for (auto _ : state)
        run_on(
            cost, [&] { return developed_dam<Precision>(threads); }, like_dam_break, window);
    cost.say(state, threads);
    state.counters["markers"] = cost.markers;
    if (threads == 1) {
        auto dam = developed_dam<Precision>(1);
        dam.step(like_dam_break);
        state.counters["bytes_a_marker"] = double(dam.system().bytes()) / cost.markers;
        state.counters["slots_pair"] = slots(dam.system()) / double(dam.system().pairs());
    }
}
BENCHMARK(dam_break_big<Double>)->ArgName("threads")->Arg(1)->Arg(2)->Iterations(2)->Unit(benchmark::kSecond);
BENCHMARK(dam_break_big<Float>)->ArgName("threads")->Arg(1)->Iterations(2)->Unit(benchmark::kSecond);
BENCHMARK(dam_break_big<Mixed>)->ArgName("threads")->Arg(1)->Iterations(2)->Unit(benchmark::kSecond);

/// The seed's run of 139,332 markers, of which the seed's own code takes 1.2 s a step: the first 200 steps.
void dam_break_seed(benchmark::State& state)
{
    Cost cost;
    for (auto _ : state) run_on(cost, seed_dam, {.dt = 1e-4}, 200 * 1e-4);
    cost.say(state, 1);
    state.counters["ms_step"] = 1e3 * Cost::sum(cost.cpu) / double(cost.steps);
    state.counters["markers"] = cost.markers;
}
BENCHMARK(dam_break_seed)->Iterations(2)->Unit(benchmark::kSecond);

/// What markers cost that get their pressure from the fluid: the dam break "big" in developed flow between walls of Adami
/// and between walls by continuity, evaluations of the rates turn by turn, and whole steps.
void walls(benchmark::State& state)
{
    auto with = [](auto wall) {
        auto dam = big_dam(1, Double{}, wall);
        Developed::flow().put_into(dam);
        return dam;
    };
    auto adami = with(Adami{.suction = false});
    auto by_continuity = with(ByContinuity{});
    adami.step(like_dam_break), by_continuity.step(like_dam_break);
    Least a, c;
    Cost step_a, step_c;
    for (int k = 0; k < 40; ++k) {
        a.of([&] { adami.system().rates(adami.system().all); });
        c.of([&] { by_continuity.system().rates(by_continuity.system().all); });
    }
    for (auto _ : state) {
        run_on(
            step_a, [&] { return with(Adami{.suction = false}); }, like_dam_break, window);
        run_on(
            step_c, [&] { return with(ByContinuity{}); }, like_dam_break, window);
    }
    auto a_step = [](Cost const& cost) { return 1e3 * Cost::sum(cost.cpu) / double(cost.steps); };
    auto& counters = state.counters;
    counters["adami_ms"] = 1e3 * a.seconds, counters["by_continuity_ms"] = 1e3 * c.seconds;
    counters["adami_ms_step"] = a_step(step_a), counters["by_continuity_ms_step"] = a_step(step_c);
    counters["rates_over"] = a.seconds / c.seconds;
    counters["step_over"] = a_step(step_a) / a_step(step_c);
}
BENCHMARK(walls)->Iterations(2)->Unit(benchmark::kSecond);

/// Sweeps of the developed flow in double, in float and mixed, turn by turn with the same terms on packs and records from L1.
void sweep(benchmark::State& state)
{
    auto one = developed_dam<Double>(1);
    auto other = developed_dam<Float>(1);
    auto third = developed_dam<Mixed>(1);
    one.step(like_dam_break), other.step(like_dam_break), third.step(like_dam_break);
    auto& s = one.system();
    SweepsOf in_double(s);
    SweepsOf in_float(other.system());
    SweepsOf in_mixed(third.system());
    using P = std::remove_cvref_t<decltype(one.physics())>;
    using B = std::remove_cvref_t<decltype(s.boundary())>;
    const double m = one.particles().value(mass);
    FromL1<P, B, Double, 0, 0> fluid_fluid(one.physics(), s.boundary(), m);
    FromL1<P, B, Double, 0, 1> fluid_wall(one.physics(), s.boundary(), m);
    FromL1<P, B, Double, 1, 0> wall_fluid(one.physics(), s.boundary(), m);
    Least d, f, x, rates, rebuild, packs[3], records[3];
    auto turn = [&](int k, auto& l1) {
        packs[k].of([&] {
            for (int n = 0; n < 20; ++n) l1.on_packs();
        });
        records[k].of([&] {
            for (int n = 0; n < 20; ++n) l1.on_records();
        });
    };
    for (auto _ : state) {
        d.of([&] { in_double.run(); });
        f.of([&] { in_float.run(); });
        x.of([&] { in_mixed.run(); });
        rates.of([&] { s.rates(s.all); });
        rebuild.of([&] { s.rebuild(); });
        s.rates(s.all); // the records in the order of the new lists
        turn(0, fluid_fluid), turn(1, fluid_wall), turn(2, wall_fluid);
    }
    const double pairs = double(s.pairs());
    const double share[3] = {double(s.lists<0, 0>().pairs()) / pairs, double(s.lists<0, 1>().pairs()) / pairs,
                             double(s.lists<1, 0>().pairs()) / pairs};
    double on_packs = 0, on_records = 0;
    for (int k = 0; k < 3; ++k) {
        on_packs += share[k] * packs[k].ns(20 * fluid_fluid.pairs);
        on_records += share[k] * records[k].ns(20 * fluid_fluid.pairs);
    }
    auto& c = state.counters;
    c["double_ns_pair"] = d.ns(pairs);
    c["float_ns_pair"] = f.ns(double(other.system().pairs()));
    c["float_over_double"] = c["float_ns_pair"] / c["double_ns_pair"];
    c["mixed_ns_pair"] = x.ns(double(third.system().pairs()));
    c["mixed_over_double"] = c["mixed_ns_pair"] / c["double_ns_pair"];
    c["packs_ns_pair"] = on_packs;
    c["records_ns_pair"] = on_records;
    c["over_packs"] = d.ns(pairs) / on_packs;
    c["over_records"] = d.ns(pairs) / on_records;
    c["slots_pair"] = slots(s) / pairs;
    const double markers = double(s.total());
    c["sweep_ns_marker"] = d.ns(markers);
    c["rates_ns_marker"] = rates.ns(markers);
    c["rebuild_ns_marker"] = rebuild.ns(markers);
}
BENCHMARK(sweep)->Iterations(25)->Unit(benchmark::kMillisecond);

/// 262,144 discs at an area fraction of 0.8, mixed by 600 steps, then 300 steps by symplectic Euler.
void dense_discs(benchmark::State& state)
{
    const int threads = int(state.range(0));
    auto mixed = [&] {
        auto box = discs(512, 0.8, threads, {.skin = 0.4, .finer = 2});
        for (int k = 0; k < 600; ++k) box.step({.dt = 1e-4});
        return box;
    };
    Cost cost;
    for (auto _ : state) run_on(cost, mixed, {.dt = 1e-4}, 300 * 1e-4);
    cost.say(state, threads);
}
BENCHMARK(dense_discs)->ArgName("threads")->Arg(1)->Arg(2)->Iterations(2)->Unit(benchmark::kSecond);

} // namespace
