// SPDX-License-Identifier: BSD-3-Clause
// Shares follow what cells cost.
#include "spate/backend/virtual_ranks.hpp"
#include "spate/spate.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;

struct Seen {
    double imbalance = 0; ///< pairs, times the pace of a rank: largest over the mean
    std::int64_t cuts = 0, moved = 0;
    std::uint64_t hash = 0;
};
/// What all ranks have seen of a scene, on rank 0.
void see(Seen& seen, auto const& rank, auto const& sim, double pairs)
{
    auto const& r = sim.system().parts().report();
    const auto cost = std::int64_t(pairs * sim.system().backend().balance.pace);
    const auto most = rank.all(cost, agree::Most{}), sum = rank.all(cost, agree::Sum{});
    const Seen all{double(most) * rank.count() / double(sum), r.cuts, rank.all(r.moved, agree::Sum{}),
                   sim.state_hash()};
    EXPECT_GE(sim.system().rebuilds(), 4);
    if (rank.rank() == 0) seen = all;
}
/// Water in one corner of a tank, on so many ranks. \param pace  of rank 1
Seen corner(int count, Balance balance, double pace = 1)
{
    Seen seen;
    VirtualRanks(count).run([&](auto rank) {
        constexpr double dx = 0.0125, g = 9.81, height = 0.5;
        auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 10 * std::sqrt(2 * g * height)},
                           Continuity<2>{}, PressureForce<2>{}, ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -g}});
        Bce tank(Box<2>{{}, {{2, 1}}}, dx, Adami{}, open(top));
        auto mine = balance;
        if (rank.rank() == 1) mine.pace = pace;
        Simulation sim(water, RungeKutta2{}, tank, OnRank{rank, Serial{}, 1, mine});
        sim.fill(Box<2>{{}, {{0.5, height}}}, dx, hydrostatic);
        auto& p = sim.particles();
        for (std::size_t i = 0; i < p.size(); ++i)
            p.put(velocity, i, {{4 * p.at(position, i)[0], 0}}); // already falling
        sim.run({.steps = 120, .cfl = 0.2});
        auto const& s = sim.system();
        see(seen, rank, sim,
            double(s.template lists<0, 0>().pairs() + s.template lists<0, 1>().pairs() +
                   s.template lists<1, 0>().pairs()));
    });
    return seen;
}
/// A pile of grains in a corner, and as many again in the air above it, which meet nobody.
Seen pile(int count, Balance balance)
{
    Seen seen;
    VirtualRanks(count).run([&](auto rank) {
        constexpr double r = 0.01;
        const LinearSpring spring{.k = 2e4};
        Simulation box(dem<2>({.mass = 0.1, .radius = r}, spring, Dashpot{.e = 0.5}, Gravity<2>{{0, -9.81}}),
                       Leapfrog{}, Walls(Box<2>{{0, 0}, {3, 3}}, contact(spring)), OnRank{rank, Serial{}, 1, balance});
        for (int row = 0; row < 50; ++row)
            for (int k = 0; k < 50 - row; ++k) // in touch: contacts of a heap at rest do not come and go
                box.add({r * (1 + 1.998 * k + 0.999 * (row % 2)), r * (1 + 1.729 * row)}, {});
        for (int k = 0; k < 1250; ++k) box.add({0.03 + 0.08 * (k % 37), 1.2 + 0.05 * (k / 37)}, {0, -2});
        box.run({.steps = 400, .dt = 1e-4});
        see(seen, rank, box, double(box.system().template lists<0, 0>().pairs()));
    });
    return seen;
}
/// Shares that are looked at whenever lists are built, by what is counted here: pairs.
constexpr Balance counted{.every = 1, .tolerated = 1, .by_pairs = true, .a_particle = 0};

void expect_like_cost(auto const& scene, double unlike)
{
    for (int ranks : {4, 8}) {
        const Seen off = scene(ranks, Balance{.every = 0}), on = scene(ranks, counted);
        EXPECT_GT(off.imbalance, unlike) << ranks;
        EXPECT_LT(on.imbalance, 1.1) << ranks;
        EXPECT_EQ(off.cuts, 0);
        EXPECT_GT(on.cuts, 0);
        EXPECT_GT(on.moved, off.moved);
        EXPECT_EQ(on.hash, off.hash);
    }
}
// Particles of the wall are as many as those of the water and cost less: shares of like numbers are not of like cost.
TEST(Balance, MakesRanksOfADamBreakCostAlike)
{
    expect_like_cost([](int ranks, Balance b) { return corner(ranks, b); }, 1.3);
}
// Grains in the air are as many as those in the pile, and have no pairs.
TEST(Balance, MakesRanksOfAPileCostAlike)
{
    expect_like_cost([](int ranks, Balance b) { return pile(ranks, b); }, 1.3);
}
// A rank that is twice as slow gets half as much to do; of shares alike it would cost 2 n / (n + 1) times the mean.
TEST(Balance, GivesASlowRankLess)
{
    expect_like_cost([](int ranks, Balance b) { return corner(ranks, b, 2); }, 1.5);
}
// A dry wall has no pairs: if particles cost nothing, one rank gets most of it.
TEST(Balance, CountsWhatParticlesCostOutsideOfTheirPairs)
{
    auto most_particles = [](double a_particle) {
        std::size_t most = 0;
        VirtualRanks(8).run([&](auto rank) {
            constexpr double dx = 0.02;
            auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 30}, Continuity<2>{},
                               PressureForce<2>{}, ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -9.81}});
            Bce tank(Box<2>{{}, {{8, 4}}}, dx, Adami{}, open(top));
            Simulation sim(water, RungeKutta2{}, tank, OnRank{rank, Serial{}, 1, Balance{1, 1, true, a_particle}});
            sim.fill(Box<2>{{}, {{0.5, 0.5}}}, dx, hydrostatic);
            auto& p = sim.particles();
            for (std::size_t i = 0; i < p.size(); ++i) p.put(velocity, i, {{4 * p.at(position, i)[0], 0}});
            sim.run({.steps = 60, .cfl = 0.2});
            auto const& s = sim.system();
            const auto here = s.template species<0>().particles.size() + s.template species<1>().particles.size();
            const auto of_all = rank.all(here, agree::Most{});
            if (rank.rank() == 0) most = of_all;
        });
        return most;
    };
    EXPECT_LT(most_particles(10), most_particles(0) / 2);
}
TEST(Balance, LeavesSharesThatCostAlike)
{
    auto lenient = counted;
    lenient.tolerated = 1.5;
    EXPECT_LE(corner(4, lenient).cuts, 1);
}

} // namespace
