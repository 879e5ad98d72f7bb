// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: a checkpoint of processes is that of one, and goes on there; that of one goes on here.
#include "mpi/going_on.hpp"

#include <gmock/gmock.h>

namespace {

using namespace spate;
using going_on::End, going_on::Processes;

template <class Case>
void expect_checkpoints_of_one(std::int64_t cut)
{
    const MpiRanks ranks;
    const End half = going_on::run<Case>(Serial{}, cut), whole = going_on::run<Case>(Serial{}, Case::steps);
    const End here = going_on::run<Case>(Processes{Threads{1}, 2, Balance{.every = 1}}, cut);
    going_on::expect_the_same(here, half, "before");
    if (ranks.rank() == 0) {
        EXPECT_THAT(going_on::differences(here.state, half.state), testing::IsEmpty());
        going_on::expect_the_same(going_on::run<Case>(Serial{}, Case::steps - cut, &here.state), whole, "on one");
    }
    const End again = going_on::run<Case>(Processes{Threads{1}, 1}, Case::steps - cut, &half.state);
    going_on::expect_the_same(again, whole, "after");
    const End on = going_on::run<Case>(Processes{Threads{1}, 3}, Case::steps - cut, &here.state);
    going_on::expect_the_same(on, whole, "before and after");
}

TEST(CheckpointOfProcesses, OfADamBreakIsThatOfOne) { expect_checkpoints_of_one<going_on::Column>(411); }
TEST(CheckpointOfProcesses, OfGrainsThatEnterAndLeaveIsThatOfOne) { expect_checkpoints_of_one<going_on::Hopper>(1236); }

} // namespace
