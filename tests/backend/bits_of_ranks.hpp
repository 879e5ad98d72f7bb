// SPDX-License-Identifier: BSD-3-Clause
// A program on virtual ranks, and the bits of one.
#pragma once

#include "scenes_of_ranks.hpp"

#include "spate/backend/virtual_ranks.hpp"

#include <gtest/gtest.h>

namespace ranked {

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

} // namespace ranked
