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
    Bce(c.tank, c.spacing, Adami{}, open(top)).place(2.4 * c.spacing, [&](auto const&) { ++wall; });
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
