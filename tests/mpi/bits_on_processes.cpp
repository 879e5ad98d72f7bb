// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: the same scenes as on virtual ranks, the same bits; nothing but the transport differs.
#include "backend/scenes_of_ranks.hpp"

#include "spate/backend/mpi.hpp"

#include <gtest/gtest.h>

namespace {

using namespace ranked;

template <class Program>
void expect_bits_of_one(Program program)
{
    const auto one = program(Serial{});
    EXPECT_GE(one.rebuilds, 20);
    const auto many = program(Mpi{Serial{}, 2});
    EXPECT_EQ(many.hash, one.hash);
    EXPECT_EQ(many.rebuilds, one.rebuilds);
    const auto moved = program(Mpi{Threads{2}, 1, Balance{.forced = 7}});
    EXPECT_EQ(moved.hash, one.hash) << "cells moved, 2 threads a process";
    EXPECT_EQ(moved.rebuilds, one.rebuilds);
}

TEST(BitsOnProcesses, OfADamBreakAreThoseOfOne)
{
    expect_bits_of_one([](auto backend) { return dam(backend); });
}
TEST(BitsOnProcesses, OfContactsThatRememberAreThoseOfOne)
{
    expect_bits_of_one([](auto backend) { return crowd(backend); });
}

} // namespace
