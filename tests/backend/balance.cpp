// SPDX-License-Identifier: BSD-3-Clause
// Shares follow what cells cost; tasks do not wait for messages that they do not need.
#include "spate/backend/virtual_ranks.hpp"
#include "spate/spate.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;

struct Seen {
    double imbalance = 0; ///< pairs: largest of a rank over the mean
    std::int64_t tasks = 0, early = 0, cuts = 0, moved = 0;
    std::uint64_t hash = 0;
};
/// Water in one corner of a tank, on so many ranks.
Seen corner(int count, Balance balance)
{
    Seen seen;
    VirtualRanks(count).run([&](auto rank) {
        constexpr double dx = 0.0125, g = 9.81, height = 0.5;
        auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 10 * std::sqrt(2 * g * height)},
                           Continuity<2>{}, PressureForce<2>{}, ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -g}});
        Bce tank(Box<2>{{}, {{2, 1}}}, dx, Adami{}, open(top));
        Simulation sim(water, RungeKutta2{}, tank, OnRank{rank, Serial{}, 1, balance});
        sim.fill(Box<2>{{}, {{0.5, height}}}, dx, hydrostatic);
        auto& p = sim.particles();
        for (std::size_t i = 0; i < p.size(); ++i)
            p.put(velocity, i, {{4 * p.at(position, i)[0], 0}}); // already falling
        sim.run({.steps = 120, .cfl = 0.2});
        auto const& s = sim.system();
        const auto here =
            s.template lists<0, 0>().pairs() + s.template lists<0, 1>().pairs() + s.template lists<1, 0>().pairs();
        const auto most = rank.all(here, agree::Most{}), sum = rank.all(here, agree::Sum{});
        auto const& r = s.parts().report();
        const Seen all{double(most) * count / double(sum), rank.all(r.tasks, agree::Sum{}),
                       rank.all(r.early, agree::Sum{}),    r.cuts,
                       rank.all(r.moved, agree::Sum{}),    sim.state_hash()};
        EXPECT_GE(s.rebuilds(), 4);
        if (rank.rank() == 0) seen = all;
    });
    return seen;
}

// Particles of the wall are as many as those of the water and cost less: shares of like numbers are not of like cost.
TEST(Balance, MakesRanksCostAlike)
{
    for (int ranks : {4, 8}) {
        const Seen off = corner(ranks, {.every = 0});
        const Seen on = corner(ranks, {.every = 1, .tolerated = 1, .by_pairs = true, .a_particle = 0});
        EXPECT_GT(off.imbalance, 1.3) << ranks;
        EXPECT_LT(on.imbalance, 1.1) << ranks;
        EXPECT_EQ(off.cuts, 0);
        EXPECT_GT(on.cuts, 0);
        EXPECT_GT(on.moved, off.moved);
        EXPECT_EQ(on.hash, off.hash);
    }
}
TEST(Balance, LeavesSharesThatCostAlike)
{
    const Seen once = corner(4, {.every = 1, .tolerated = 1.5, .by_pairs = true, .a_particle = 0});
    EXPECT_LE(once.cuts, 1);
}
TEST(Overlap, RunsTasksWhileMessagesAreOnTheirWay)
{
    const Seen seen = corner(4, {});
    EXPECT_GT(seen.early, seen.tasks / 50);
    EXPECT_LT(seen.early, seen.tasks);
}

} // namespace
