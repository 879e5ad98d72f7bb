// SPDX-License-Identifier: BSD-3-Clause
// The same bits for walls by continuity, a periodic space and grains: threads with packs and a watch against one scalar
// after the other without a watch.
#include "scenes.hpp"

#include <functional>

#include <gtest/gtest.h>

namespace {

using namespace scenes;

/// \param threaded  of (threads, neighbours), in packs, watched    \param plain  of (neighbours): scalars, not watched
void same_bits(Neighbours const& usual_here, std::function<Outcome(Threads, Neighbours)> const& threaded,
               std::function<Outcome(Neighbours)> const& plain)
{
    const Outcome reference = plain(usual_here);
    EXPECT_GE(reference.rebuilds, 20);
    for (int threads : {1, 2, 3, 7})
        EXPECT_EQ(threaded({threads, 0}, usual_here).hash, reference.hash) << threads << " threads";
    for (int cell : {1, 2, 4, 8, 16})
        EXPECT_EQ(threaded({2, cell}, usual_here).hash, reference.hash) << "cell " << cell;
    const auto thin = plain({.skin = 0.1, .bins = 1.4, .trigger = 0.08});
    const auto thick = threaded({2, 0}, {.skin = 0.4, .bins = 1.4, .trigger = 0.08});
    EXPECT_EQ(thin.hash, thick.hash);
    EXPECT_NE(thin.hash, reference.hash);
}

TEST(Bits, OfWallsByContinuity)
{
    same_bits(
        usual, [](Threads t, Neighbours n) { return dam_break(Leapfrog{}, ByContinuity{}, t, n); },
        [](Neighbours n) { return dam_break<ScalarOf<Double>, NoWatch>(Leapfrog{}, ByContinuity{}, Serial{}, n); });
}
TEST(Bits, OfAPeriodicSpace)
{
    same_bits(
        usual, [](Threads t, Neighbours n) { return vortices(t, n); },
        [](Neighbours n) { return vortices<NoWatch, ScalarOf<Double>>(Serial{}, n); });
}
TEST(Bits, DoNotDependOnHowARunIsCut)
{
    const auto whole = vortices(Threads{1, 0});
    for (int piece : {1, 7, 60})
        EXPECT_EQ(vortices(Threads{1, 0}, usual, piece).hash, whole.hash) << "pieces of " << piece;
}
TEST(Bits, OfGrains)
{
    same_bits(
        Discs::neighbours, [](Threads t, Neighbours n) { return discs(t, n); },
        [](Neighbours n) { return discs<NoWatch, ScalarOf<Double>>(Serial{}, n); });
}

} // namespace
