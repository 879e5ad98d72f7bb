// SPDX-License-Identifier: BSD-3-Clause
#include <spate/cells/grid.hpp>

#include <gtest/gtest.h>

#include <random>

namespace {
using namespace spate;

Grid<2> half_open_grid(int finer = 4, int cell = 3) // periodic in x: five ranges of 1; open in y
{
    Edges<2> e(Edge::open);
    e.set_axis(x_axis, Edge::periodic);
    return Grid<2>(Box<2>{{-1, 2}, {4, 9}}, e, 1, finer, cell);
}

TEST(Grid, HasBinsThatAreHalfOpenIntervals)
{
    const auto g = half_open_grid();
    EXPECT_EQ(g.bin(0, -1), 0);
    EXPECT_EQ(g.bin(0, std::nextafter(-0.75, -1)), 0);
    EXPECT_EQ(g.bin(0, -0.75), 1);
    EXPECT_EQ(g.bin(1, 2), 0);
    EXPECT_EQ(g.bin(1, std::nextafter(2.0, 0.0)), -1);
    EXPECT_EQ(g.bin(1, 3), 1);
    EXPECT_EQ(g.bin(1, 100), 98) << "an open axis has no last bin";
    EXPECT_EQ(g.bins(0), 20);
    EXPECT_EQ(g.bins(1), 0);
}

TEST(Grid, FillsAPeriodWithWholeRangesNoShorterThanTheRange)
{
    std::mt19937 random(1);
    for (int trial = 0; trial < 500; ++trial) {
        const double range = 0.1 + double(random() % 1000) * 1e-3,
                     length = range * (1 + double(random() % 1000) * 1e-2);
        const int finer = 1 + int(random() % 8);
        const Grid<1> g(Box<1>{{0}, {length}}, Edges<1>(Edge::periodic), range, finer, 2);
        EXPECT_EQ(g.bins(0) % finer, 0);
        EXPECT_GE(length / g.bins(0) * finer, range * (1 - 1e-15));
        EXPECT_LT(length / g.bins(0) * finer, 2 * range * (1 + 1e-15));
        EXPECT_EQ(g.bin(0, 0), 0);
        EXPECT_EQ(g.bin(0, std::nextafter(length, 0.0)), g.bins(0) - 1);
    }
}

TEST(Grid, HasCellsOfWholeBinsOnBothSidesOfTheOrigin)
{
    const auto g = half_open_grid(4, 3);
    EXPECT_EQ(g.bins_of_cell(0), 12);
    EXPECT_EQ(g.bins_of_cell(1), 3);
    EXPECT_EQ(g.bins_of_cell(), 36);
    for (int b = -40; b < 40; ++b)
        for (int c : {0, 1}) {
            const int k = g.cell_of(c, b), m = g.bins_of_cell(c);
            EXPECT_LE(k * m, b);
            EXPECT_LT(b, (k + 1) * m);
        }
}

TEST(Grid, WrapsIntoTheHalfOpenPeriod)
{
    const auto g = half_open_grid();
    EXPECT_EQ(g.wrapped(0, 4), -1) << "the upper face is the lower one";
    EXPECT_EQ(g.wrapped(0, -1), -1);
    EXPECT_NEAR(g.wrapped(0, 4.25), -0.75, 1e-15);
    EXPECT_NEAR(g.wrapped(0, -16.5), 3.5, 1e-14) << "by many periods";
    EXPECT_EQ(g.wrapped(0, 1.125), 1.125) << "what is inside stays as it is";
    EXPECT_EQ(g.wrapped(1, -7), -7) << "an open axis does not wrap";
    std::mt19937 random(2);
    for (int trial = 0; trial < 1000; ++trial) {
        const double x =
            (double(random()) * 0x1p-32 - 0.5) * std::pow(10, double(random() % 20) - 17) + 4 * (trial % 2);
        const double y = g.wrapped(0, x);
        EXPECT_TRUE(y >= -1 && y < 4) << x;
    }
}

TEST(Grid, GivesWhatIsNotACoordinateTheLastIndex)
{
    const auto g = half_open_grid();
    constexpr std::int32_t last = std::numeric_limits<std::int32_t>::max();
    for (double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300, -1e300})
        EXPECT_EQ(g.bin(1, bad), last);
}

TEST(Grid, HasCornersWhereBinsBegin)
{
    const auto g = half_open_grid();
    EXPECT_EQ(g.corner(0, 0), -1);
    EXPECT_EQ(g.corner(0, 4), 0);
    EXPECT_EQ(g.corner(1, -2), 0);
    EXPECT_EQ(g.period(0), 5);
    EXPECT_EQ(g.period(1), 0);
    EXPECT_TRUE(g.periodic(0) && !g.periodic(1) && g.any_periodic());
}

} // namespace
