// SPDX-License-Identifier: BSD-3-Clause
// Bits on as many ranks as no machine here has, while cells move between them at every step.
#include "scenes_of_ranks.hpp"

#include "spate/backend/virtual_ranks.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;

struct Seen {
    std::uint64_t hash = 0;
    std::int64_t rebuilds = 0, moved_cells = 0;
    std::size_t particles = 0;
};
/// A column that falls apart already, with lists so short-lived that they are built anew every few steps.
template <class Backend>
Seen falling(Backend backend, double dx, double skin, std::int64_t steps)
{
    auto sim = ranked::column(backend, dx, {.skin = skin, .local = true});
    auto& p = sim.particles();
    for (std::size_t i = 0; i < p.size(); ++i) p.put(velocity, i, {{4 * p.at(position, i)[0], 0}});
    sim.run({.steps = steps, .cfl = 0.2});
    Seen seen{sim.state_hash(), sim.system().rebuilds(), 0, sim.system().total()};
    if constexpr (requires { sim.system().parts().report(); })
        seen.moved_cells = sim.system().ranks().all(sim.system().parts().report().moved_cells, agree::Sum{});
    return seen;
}
void expect_bits_of_one(int ranks, double dx, double skin, std::int64_t steps)
{
    const Seen one = falling(Threads{.count = 2}, dx, skin, steps);
    Seen many;
    VirtualRanks(ranks).run([&](auto rank) {
        const Seen mine = falling(OnRank{rank, Serial{}, 1, Balance{.forced = 1}}, dx, skin, steps);
        if (rank.rank() == 0) many = mine;
    });
    EXPECT_EQ(many.hash, one.hash);
    EXPECT_EQ(many.rebuilds, one.rebuilds);
    EXPECT_EQ(many.particles, one.particles);
    EXPECT_GE(one.rebuilds, 20);
    EXPECT_GE(many.moved_cells, 100);
    std::printf("%zu particles, %lld rebuilds, %lld cells moved\n", many.particles,
                static_cast<long long>(many.rebuilds), static_cast<long long>(many.moved_cells));
}

TEST(BitsOnManyRanks, OfSixtyFourWhoseCellsMoveAtEveryStepAreThoseOfOne) { expect_bits_of_one(64, 0.02, 0.02, 110); }
TEST(LongBitsOnManyRanks, OfAThousandAndAHundredThousandParticlesAreThoseOfOne)
{
    expect_bits_of_one(1000, 0.1 / 90, 0.012, 30);
}

} // namespace
