// SPDX-License-Identifier: BSD-3-Clause
// The boxes of the example are those on which other codes have been timed: the same numbers of particles.
#include "../../examples/dam_break/column.hpp"

#include <spate/boundary/adami.hpp>
#include <spate/boundary/bce.hpp>

#include <gtest/gtest.h>

namespace {

using namespace spate;

/// Fluid and wall for the cubic spline at h = 1.2 dx: a support of 2.4 dx needs three layers.
template <int Dim>
std::pair<long, long> counts(std::string const& name, double spacing = 0)
{
    const Column<Dim> c = column<Dim>(name, spacing);
    long fluid = 1, wall = 0;
    for (int k = 0; k < Dim; ++k) fluid *= std::lround(c.water.size()[k] / c.spacing);
    Bce tank(c.tank, c.spacing, Adami{}, layers(3), open(c.open), obstacle(c.box));
    tank.place(c.smoothing.value_or(1.2) * 2 * c.spacing, [&](auto const&) { ++wall; });
    return {fluid, wall};
}
using Counts = std::pair<long, long>;

TEST(DamBreak, HasTheMarkersOfThePeers)
{
    EXPECT_EQ(counts<3>("big"), Counts(80000, 58428)); // 138,428
    EXPECT_EQ(counts<3>("small"), Counts(5120, 10476));
    EXPECT_EQ(counts<2>("2d"), Counts(31250, 3018));
    EXPECT_EQ(counts<3>("default"), Counts(4096, 60156));
}

// A support of two spacings needs two layers; the seed has three. Its figure 3 says 139,332.
TEST(DamBreak, HasTheMarkersOfTheSeed)
{
    EXPECT_EQ(counts<3>("seed"), Counts(17556, 121776));
    const auto c = column<3>("seed", 0);
    EXPECT_EQ(std::lround((c.tank.size()[2] + 6 * c.spacing) / c.spacing), 120);
    EXPECT_EQ(10 * c.fastest, 25);
}

// Kleefsman et al. (2005): the box is 8 by 20 by 8 points of the lattice, but for those that are deeper than 3 dx.
TEST(DamBreak, HasTheBoxesOfTheExperiments)
{
    const long lining = 167L * 56 * 56 - 161L * 50 * 50;
    EXPECT_EQ(counts<3>("obstacle"), Counts(62 * 50 * 27, lining + 8 * 20 * 8 - 2 * 14 * 2));
    EXPECT_EQ(counts<2>("lobovsky").first, 240 * 120);
    EXPECT_EQ(counts<3>("lobovsky").first, 60 * 15 * 30);
    EXPECT_EQ(column<3>("obstacle", 0).sensors.size() + column<3>("obstacle", 0).gauges.size(), 12u);
    EXPECT_NEAR(column<3>("obstacle", 0.01).water.lo[0], 1.99, 1e-12);
    EXPECT_THROW(column<2>("obstacle", 0), BadInput);
    EXPECT_THROW(column<2>("seed", 0), BadInput);
}

TEST(DamBreak, TakesASpacingThatDividesItsBoxes)
{
    EXPECT_EQ(counts<3>("default", 0.15 / 4).first, 8 * 4 * 16);
    EXPECT_EQ(column<3>("default", 0.01875 * (1 + 1e-9)).spacing, 0.01875); // to rounding
    EXPECT_EQ(column<2>("2d", 0.01).spacing, 0.01);
}

TEST(DamBreak, NamesTheNearestSpacingThatDivides)
{
    try {
        column<3>("default", 0.019);
        FAIL();
    }
    catch (BadInput const& e) {
        EXPECT_STREQ(e.what(),
                     "spate: spacing is 0.019; allowed is 0.15 m over a whole number, so that it divides the boxes; "
                     "the nearest is 0.01875 m");
    }
    for (double wrong : {-0.01, std::nan(""), 1.0, 1e300, 1e-9, 1e-300})
        EXPECT_THROW(column<3>("default", wrong), BadInput) << wrong;
    EXPECT_THROW(column<3>("2d", 0), BadInput);
    EXPECT_THROW(column<2>("big", 0), BadInput);
}

} // namespace
