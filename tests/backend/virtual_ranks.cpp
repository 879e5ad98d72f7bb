// SPDX-License-Identifier: BSD-3-Clause
#include "spate/backend/virtual_ranks.hpp"

#include "transport_laws.hpp"

namespace {

using namespace spate;

template <class Law>
void on_each(Law law)
{
    for (int count : {1, 2, 3, 8, 100}) VirtualRanks(count).run(law);
}
TEST(VirtualRanks, Agree)
{
    on_each([](auto rank) { transport::expect_agreement(rank); });
}
TEST(VirtualRanks, Scatter)
{
    on_each([](auto rank) { transport::expect_scatter(rank); });
}
TEST(VirtualRanks, Exchange)
{
    on_each([](auto rank) { transport::expect_exchange(rank); });
}
TEST(VirtualRanks, StopTogether)
{
    on_each([](auto rank) { transport::expect_togetherness(rank); });
}
TEST(VirtualRanks, RunInAnOrderThatIsAlwaysTheSame)
{
    auto order = [] {
        std::vector<int> seen;
        VirtualRanks(7).run([&](auto rank) { // one at a time: no lock
            for (int k = 0; k < 3; ++k) {
                seen.push_back(rank.rank());
                (void)rank.all(1, agree::Sum{});
            }
        });
        return seen;
    };
    const auto first = order();
    EXPECT_EQ(first.size(), 21);
    for (int k = 0; k < 5; ++k) EXPECT_EQ(order(), first);
}
TEST(VirtualRanks, EndWhereOneIsGone)
{
    VirtualRanks ranks(5);
    auto one_throws = [](auto rank) {
        if (rank.rank() == 3) throw std::out_of_range("lost");
        for (int k = 0; k < 10; ++k) (void)rank.all(1, agree::Sum{});
    };
    EXPECT_THROW(ranks.run(one_throws), std::out_of_range);
    EXPECT_THROW(ranks.run(one_throws), std::out_of_range); // and can be asked again
}
TEST(VirtualRanks, DoNotWaitForEachOtherForEver)
{
    auto one_waits = [](auto rank) {
        if (rank.rank() != 1) (void)rank.all(1, agree::Sum{});
    };
    EXPECT_THROW(VirtualRanks(4).run(one_waits), std::logic_error);
}

} // namespace
