// SPDX-License-Identifier: BSD-3-Clause
// The state after n steps is the same, bit for bit, however many ranks share the scene, and wherever its cells move to.
#include "scenes_of_ranks.hpp"

#include "spate/backend/virtual_ranks.hpp"

#include <memory>

#include <gtest/gtest.h>

namespace {

using namespace ranked;

/// program(backend) on each of so many ranks; all must see the same outcome.
template <class Program, class Local = Serial>
scenes::Outcome on_ranks(int count, Program program, int cell = 2, Balance balance = {}, Local local = {})
{
    std::vector<scenes::Outcome> outcome(std::size_t(count), scenes::Outcome{});
    VirtualRanks(count).run([&](auto rank) {
        outcome[std::size_t(rank.rank())] = program(OnRank{rank, local, cell, balance});
    });
    for (auto const& o : outcome) EXPECT_EQ(o.hash, outcome[0].hash);
    return outcome[0];
}
constexpr auto the_dam = [](auto backend) { return dam(backend); };
constexpr auto the_smoothed_dam = [](auto backend) { return smoothed_dam(backend); };
constexpr auto the_vortices = [](auto backend) { return scenes::vortices(backend); };
constexpr auto the_discs = [](auto backend) { return scenes::discs(backend); };
constexpr auto the_crowd = [](auto backend) { return crowd(backend); };

constexpr auto the_hopper = [](auto backend) { return hopper(backend); };

template <class Program>
void expect_bits_of_one(Program program)
{
    const auto one = program(Serial{});
    EXPECT_GE(one.rebuilds, 20);
    for (int count : {1, 2, 5}) {
        const auto many = on_ranks(count, program);
        EXPECT_EQ(many.hash, one.hash) << count << " ranks";
        EXPECT_EQ(many.rebuilds, one.rebuilds) << count << " ranks";
    }
    const auto moved = on_ranks(3, program, 1, Balance{.forced = 7});
    EXPECT_EQ(moved.hash, one.hash) << "cells moved";
    EXPECT_EQ(moved.rebuilds, one.rebuilds) << "cells moved";
}

TEST(BitsOnRanks, OfADamBreakAreThoseOfOne) { expect_bits_of_one(the_dam); }
TEST(BitsOnRanks, OfADamBreakWithAPhaseAreThoseOfOne) { expect_bits_of_one(the_smoothed_dam); }
TEST(BitsOnRanks, OfPeriodicVorticesIn3DAreThoseOfOne) { expect_bits_of_one(the_vortices); }
TEST(BitsOnRanks, OfPeriodicDiscsAreThoseOfOne) { expect_bits_of_one(the_discs); }
TEST(BitsOnRanks, OfContactsThatRememberAreThoseOfOne) { expect_bits_of_one(the_crowd); }

TEST(BitsOnRanks, OfGrainsThatEnterAndLeaveAreThoseOfOne) { expect_bits_of_one(the_hopper); }

TEST(BitsOnRanks, DoNotDependOnCells)
{
    const auto one = on_ranks(1, the_dam, 16);
    for (int cell : {1, 3, 8}) EXPECT_EQ(on_ranks(2, the_dam, cell).hash, one.hash) << "cell " << cell;
}
TEST(BitsOnRanks, DoNotDependOnTheNumberOfRanksUpToOneForEachFewCells)
{
    auto shorter = [](auto backend) { return dam(backend, 900); };
    const auto one = dam(Serial{}, 900);
    EXPECT_EQ(on_ranks(64, shorter, 1).hash, one.hash);
    EXPECT_GE(one.rebuilds, 20);
}
// Nothing in it may know where it was.
TEST(BitsOnRanks, StandWhenASceneIsMovedBetweenTwoRuns)
{
    const RunOptions some{.steps = 150, .dt = 2e-4};
    auto moved = [&](auto backend) {
        auto there = std::make_unique<decltype(hopper_box(backend))>(hopper_box(backend));
        there->run(some);
        auto here = std::move(*there);
        there.reset();
        here.run(some);
        return scenes::Outcome{here.state_hash(), here.system().rebuilds()};
    };
    auto stayed = hopper_box(Serial{});
    stayed.run(some);
    stayed.run(some);
    EXPECT_EQ(moved(Serial{}).hash, stayed.state_hash());
    EXPECT_EQ(on_ranks(3, moved).hash, stayed.state_hash());
}
TEST(BitsOnRanks, StandWhenCellsMoveAtEveryStep)
{
    const auto moved = on_ranks(4, the_crowd, 2, Balance{.forced = 1});
    EXPECT_EQ(moved.hash, crowd(Serial{}).hash);
}

} // namespace
