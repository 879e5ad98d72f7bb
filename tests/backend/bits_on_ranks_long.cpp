// SPDX-License-Identifier: BSD-3-Clause
#include "bits_of_ranks.hpp"

namespace {

using namespace ranked;

TEST(LongBitsOnRanks, OfADamBreakAreThoseOfOne)
{
    expect_bits_of_one([](auto backend) { return dam(backend); });
}
TEST(LongBitsOnRanks, DoNotDependOnTheNumberOfRanksUpToOneForEachFewCells)
{
    auto shorter = [](auto backend) { return dam(backend, 900); };
    const auto one = dam(Serial{}, 900);
    EXPECT_EQ(on_ranks(64, shorter, 1).hash, one.hash);
    EXPECT_GE(one.rebuilds, 20);
}
TEST(LongBitsOnRanks, OfPeriodicDiscsAreThoseOfOne)
{
    expect_bits_of_one([](auto backend) { return scenes::discs(backend); });
}

} // namespace
