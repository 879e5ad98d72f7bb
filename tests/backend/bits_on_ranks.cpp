// SPDX-License-Identifier: BSD-3-Clause
// The state after n steps is the same, bit for bit, however many ranks share the scene, and wherever its cells move to.
// A dam break with Runge and Kutta's scheme: bits_on_many_ranks.cpp, of 64; more scenes: bits_on_ranks_long.cpp.
#include "bits_of_ranks.hpp"

#include <memory>

namespace {

using namespace ranked;

constexpr auto the_smoothed_dam = [](auto backend) { return smoothed_dam(backend); };
constexpr auto the_vortices = [](auto backend) { return scenes::vortices(backend); };
constexpr auto the_crowd = [](auto backend) { return crowd(backend); };
constexpr auto the_hopper = [](auto backend) { return hopper(backend); };

TEST(BitsOnRanks, OfADamBreakWithAPhaseAreThoseOfOne) { expect_bits_of_one(the_smoothed_dam); }
TEST(BitsOnRanks, OfPeriodicVorticesIn3DAreThoseOfOne) { expect_bits_of_one(the_vortices); }
TEST(BitsOnRanks, OfContactsThatRememberAreThoseOfOne) { expect_bits_of_one(the_crowd); }
TEST(BitsOnRanks, OfGrainsThatEnterAndLeaveAreThoseOfOne) { expect_bits_of_one(the_hopper); }

TEST(BitsOnRanks, DoNotDependOnCells)
{
    const auto one = on_ranks(1, the_smoothed_dam, 16);
    for (int cell : {1, 3, 8}) EXPECT_EQ(on_ranks(2, the_smoothed_dam, cell).hash, one.hash) << "cell " << cell;
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
