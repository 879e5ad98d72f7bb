// SPDX-License-Identifier: BSD-3-Clause
// The state after n steps is the same, bit for bit, whoever computes it and however it is cut into cells.
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace {

using namespace scenes;

auto dam(auto backend, Neighbours n = usual) { return dam_break(RungeKutta2{}, Adami{}, backend, n); }
Outcome const& reference()
{
    static const Outcome r = dam(Serial{});
    return r;
}

TEST(Bits, OfADamBreakStandThroughManyRebuilds)
{
    EXPECT_GE(reference().rebuilds, 20);
    EXPECT_EQ(dam(Serial{}).hash, reference().hash);
}
TEST(Bits, OfADamBreakDoNotDependOnThreads)
{
    for (int threads : {1, 2, 3, 7}) EXPECT_EQ(dam(Threads{threads}).hash, reference().hash) << threads << " threads";
}
TEST(Bits, OfADamBreakDoNotDependOnCells)
{
    for (int cell : {1, 2, 4, 8, 16}) EXPECT_EQ(dam(Serial{cell}).hash, reference().hash) << "cell " << cell;
    for (int cell : {1, 3, 16}) EXPECT_EQ(dam(Threads{2, cell}).hash, reference().hash) << "2 threads, cell " << cell;
}
TEST(Bits, OfPacksThatAreWatchedAreThoseOfScalarsThatAreNot)
{
    EXPECT_EQ((dam_break<ScalarOf<Double>, NoWatch>(RungeKutta2{}, Adami{}, Serial{}).hash), reference().hash);
}
TEST(Bits, OfFloatPacksAreThoseOfFloatScalars)
{
    const auto packs = dam_break<Float>(RungeKutta2{}, Adami{}, Serial{});
    const auto scalars = dam_break<ScalarOf<Float>>(RungeKutta2{}, Adami{}, Serial{});
    EXPECT_EQ(packs.hash, scalars.hash);
    EXPECT_GE(packs.rebuilds, 20);
    EXPECT_NE(packs.hash, reference().hash);
}
TEST(Bits, DoNotDependOnTheSkinNorOnHowListsAreBlocked)
{
    const auto thin = dam(Serial{}, {.skin = 0.1, .bins = 1.4, .trigger = 0.08});
    const auto thick = dam(Serial{}, {.skin = 0.4, .bins = 1.4, .trigger = 0.08});
    EXPECT_EQ(thin.hash, thick.hash);
    EXPECT_EQ(thin.rebuilds, thick.rebuilds);
    for (int window : {1, 16, 4096}) {
        Neighbours n = usual;
        n.window = window;
        EXPECT_EQ(dam(Threads{2}, n).hash, reference().hash) << "window " << window;
    }
}

// What the hash can see: the order of neighbours in a sum, when lists are rebuilt, one unit in the last place.
TEST(Bits, ChangeWithTheOrderOfNeighbours)
{
    Neighbours n = usual;
    n.trigger = n.closed_in();
    EXPECT_EQ(dam(Serial{}, n).hash, reference().hash); // the same, spelled out
    n.bins = 1.3 * n.bin_edge();
    EXPECT_NE(dam(Serial{}, n).hash, reference().hash);
    n.bins = usual.bins;
    n.finer = usual.finer + 1;
    EXPECT_NE(dam(Serial{}, n).hash, reference().hash);
}
TEST(Bits, ChangeWithTheLastBitOfOneParticle)
{
    Simulation sim(dem<2>({.mass = 1, .radius = 1}, LinearSpring{.k = 1}), SymplecticEuler{}, Open{}, Serial{},
                   Double{}, NoWatch{});
    for (int k = 0; k < 10; ++k) sim.add({{3.0 * k, 1}}, {{0, 1}});
    const auto before = sim.state_hash();
    auto& y = sim.particles().column(position)[1][7];
    y = std::nextafter(y, 2.0);
    const auto after = sim.state_hash();
    EXPECT_NE(before, after);
    y = 1;
    EXPECT_EQ(sim.state_hash(), before);
    std::swap(sim.particles().column(position)[0][2], sim.particles().column(position)[0][3]);
    EXPECT_NE(sim.state_hash(), before); // which particle is where
}

} // namespace
