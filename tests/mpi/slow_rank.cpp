// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: a process that works at half speed gets half as much to do. Costs are processor time, so that other programs on
// the machine have no say.
#include "spate/backend/mpi.hpp"
#include "spate/spate.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;

/// Work for nothing in the tasks of a rank: on a processor of half the speed they take about twice as long.
struct Toil {
    static constexpr Fields adds{acceleration};
    int turns; ///< for each block of targets
    void operator()(auto& i) const
    {
        for (int k = 0; k < turns; ++k) asm volatile("" ::: "memory"); // not left out
        i[acceleration] += Vec<2, double>{};
    }
};

struct Seen {
    double imbalance = 0; ///< processor time in tasks of cells, the cost that is balanced here: largest over the mean
    double slow = 0;      ///< share of all pairs of the last rank, the slow one
    double step = 0;      ///< wall time [s]
    std::int64_t cuts = 0;
    std::uint64_t hash = 0;
};
/// Processor time in tasks of cells since lists were built [ns].
std::int64_t in_tasks(auto const& system)
{
    std::int64_t ns = 0;
    for (int s = 0; s < 2; ++s)
        for (const auto cost : system.parts().cost(s)) ns += cost;
    return ns;
}
/// Water in one corner of a tank; the first steps are for shares to settle.
Seen corner(Balance balance)
{
    const MpiRanks ranks;
    const bool slow = ranks.rank() == ranks.count() - 1;
    constexpr double dx = 0.0025, g = 9.81, height = 0.5;
    auto water =
        wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 10 * std::sqrt(2 * g * height)}, Continuity<2>{},
              PressureForce<2>{}, ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -g}}, Toil{slow ? 3000 : 0});
    Bce tank(Box<2>{{}, {{2, 1}}}, dx, Adami{}, open(top));
    Simulation sim(water, RungeKutta2{}, tank, Mpi{Serial{}, 4, balance});
    sim.fill(Box<2>{{}, {{0.5, height}}}, dx, hydrostatic);
    auto& p = sim.particles();
    for (std::size_t i = 0; i < p.size(); ++i) p.put(velocity, i, {{4 * p.at(position, i)[0], 0}}); // already falling
    sim.run({.steps = 150, .cfl = 0.2});
    const auto start = std::chrono::steady_clock::now();
    constexpr int steps = 150;
    std::int64_t ns = 0; // in tasks
    auto const& s = sim.system();
    for (int k = 0; k < steps; ++k) { // what cells have cost is forgotten when lists are built
        const auto before = in_tasks(s), lists = s.rebuilds();
        sim.run({.steps = 1, .cfl = 0.2});
        ns += in_tasks(s) - (s.rebuilds() == lists ? before : 0);
    }
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    const auto most = ranks.all(ns, agree::Most{}), sum = ranks.all(ns, agree::Sum{});
    const auto pairs = std::int64_t(s.template lists<0, 0>().pairs() + s.template lists<0, 1>().pairs() +
                                    s.template lists<1, 0>().pairs());
    const auto of_slow = ranks.all(slow ? pairs : 0, agree::Sum{}), of_all = ranks.all(pairs, agree::Sum{});
    return {double(most) * ranks.count() / double(sum), double(of_slow) / double(of_all),
            ranks.all(wall.count(), agree::Most{}) / steps, s.parts().report().cuts, sim.state_hash()};
}

// Shares of like numbers are not of like cost, and those of like cost leave the slow rank less. How much slower it is depends on
// what else its core does: the costs of the run itself are what is compared.
TEST(LongSlowRank, GetsLess)
{
    const Seen off = corner({.every = 0, .by_cpu = true}),
               on = corner({.every = 1, .tolerated = 1, .a_particle = 0, .by_cpu = true});
    if (MpiRanks().rank() == 0)
        for (Seen const& s : {off, on})
            std::printf("time of the slowest rank %.3f of the mean, pairs of the slow one %.3f of all, %.2f ms a step, "
                        "%lld cuts\n",
                        s.imbalance, s.slow, 1e3 * s.step, static_cast<long long>(s.cuts));
    EXPECT_EQ(on.hash, off.hash);
    EXPECT_EQ(off.cuts, 0);
    EXPECT_GT(on.cuts, 0);
    EXPECT_GT(off.imbalance, 1.2);
    EXPECT_LT(on.imbalance, 1.1);
    EXPECT_LT(on.slow, 0.8 * off.slow);
}

} // namespace
