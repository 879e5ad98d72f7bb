// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: scenes as on virtual ranks, the bits of one; nothing but the transport differs.
#include "mpi/going_on.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;
using going_on::Processes;

template <class Case>
void expect_bits_of_one()
{
    const auto one = going_on::run<Case>(Serial{}, Case::steps);
    EXPECT_GE(one.rebuilds, Case::rebuilds);
    going_on::expect_the_same(going_on::run<Case>(Processes{Threads{1}, 2}, Case::steps), one, "");
    const auto moved = going_on::run<Case>(Processes{Threads{2}, 1, Balance{.forced = 7}}, Case::steps);
    going_on::expect_the_same(moved, one, "cells moved, 2 threads a process");
    if (MpiRanks().count() > 1) {
        EXPECT_GT(moved.moved_cells, 0);
    }
}

TEST(BitsOnProcesses, OfADamBreakAreThoseOfOne) { expect_bits_of_one<going_on::Column>(); }
TEST(BitsOnProcesses, OfContactsThatRememberAreThoseOfOne) { expect_bits_of_one<going_on::Hopper>(); }

} // namespace
