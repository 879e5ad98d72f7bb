// SPDX-License-Identifier: BSD-3-Clause
// What makes no sense on many ranks is refused on all of them with the same words, and nobody waits.
#include "spate/backend/virtual_ranks.hpp"
#include "spate/spate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace spate;
using testing::HasSubstr;

/// What each rank says of a little water; `change` may differ by rank.
void expect_refusal(int ranks, std::string const& words, auto const& change)
{
    std::vector<std::string> said(std::size_t(ranks), "nothing");
    VirtualRanks(ranks).run([&](auto rank) {
        struct {
            double c0 = 30, dx = 0.05;
            int cell = 1;
            Balance balance = {};
            RunOptions how{.steps = 3, .dt = 1e-4};
        } o;
        change(o, rank.rank());
        try {
            auto water = wcsph(CubicSpline<2>{.h = 1.2 * o.dx}, Tait{.rho0 = 1000, .c0 = o.c0}, Continuity<2>{},
                               PressureForce<2>{}, Gravity<2>{{0, -9.81}});
            Simulation tank(water, RungeKutta2{}, Bce(Box<2>{{}, {{1, 1}}}, o.dx, Adami{}, open(top)),
                            OnRank{rank, Serial{}, o.cell, o.balance});
            tank.fill(Box<2>{{}, {{0.5, 0.5}}}, o.dx, hydrostatic);
            tank.run(o.how);
        }
        catch (BadInput const& e) {
            said[std::size_t(rank.rank())] = e.what();
        }
    });
    for (auto const& s : said) EXPECT_EQ(s, said[0]);
    EXPECT_THAT(said[0], HasSubstr(words));
}

TEST(BadInputOnRanks, MoreRanksThanCellsIsRefused)
{
    expect_refusal(50, "spate: the number of ranks is 50; allowed is at most that of occupied cells, 6",
                   [](auto& o, int) { o.cell = 8; });
}
TEST(BadInputOnRanks, OptionsThatDifferAreRefused)
{
    expect_refusal(3, "spate: steps is 3 on one rank and 4 on another; allowed is the same on all ranks",
                   [](auto& o, int rank) { o.how.steps += rank == 1; });
    expect_refusal(3, "spate: dt is ", [](auto& o, int rank) { o.how.dt *= 1 + rank; });
    expect_refusal(2, "spate: cell is 1 on one rank and 2 on another", [](auto& o, int rank) { o.cell += rank; });
    expect_refusal(2, "spate: Balance.every is 4 on one rank and 5 on another",
                   [](auto& o, int rank) { o.balance.every += rank; });
    expect_refusal(2, "spate: c0 is 30 on one rank and 31 on another", [](auto& o, int rank) { o.c0 += rank; });
}

} // namespace
