// SPDX-License-Identifier: BSD-3-Clause
#include <spate/core/box.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace {
using namespace spate;

TEST(Box, IsClosed)
{
    const Box<2> b{{-1, 0}, {1, 3}};
    EXPECT_EQ(b.size(), (Vec<2, double>{{2, 3}}));
    EXPECT_TRUE(b.contains({{-1, 0}}));
    EXPECT_TRUE(b.contains({{1, 3}}));
    EXPECT_FALSE(b.contains({{1, 3.001}}));
    EXPECT_FALSE(b.contains({{-1.001, 1}}));
    EXPECT_FALSE(b.contains({{std::numeric_limits<double>::quiet_NaN(), 1}}));
    EXPECT_TRUE(b.grown(0.5).contains({{1.5, -0.5}}));
    EXPECT_FALSE(b.grown(-0.5).contains({{1, 1}}));
}

TEST(Edges, AreSetByFaceAndByAxis)
{
    Edges<3> e(Edge::wall);
    apply(e, open(top, left));
    EXPECT_EQ(e.at(2, true), Edge::open) << "top is the upper end of the last axis";
    EXPECT_EQ(e.at(2, false), Edge::wall);
    EXPECT_EQ(e.at(0, false), Edge::open);
    EXPECT_EQ(e.at(0, true), Edge::wall);
    apply(e, periodic(y_axis));
    EXPECT_TRUE(e.periodic(1));
    EXPECT_FALSE(e.periodic(0) || e.periodic(2));
}

TEST(Edges, OfAPlaneHaveTheirTopAtTheSecondAxis)
{
    Edges<2> e(Edge::wall);
    apply(e, open(top));
    EXPECT_EQ(e.at(1, true), Edge::open);
    e.set(bottom, Edge::open);
    EXPECT_EQ(e.at(1, false), Edge::open);
    EXPECT_EQ(e.at(0, false), Edge::wall);
}

TEST(Edges, RefuseAnAxisThatSpaceDoesNotHave)
{
    Edges<2> e(Edge::wall);
    EXPECT_THROW(e.set_axis(z_axis, Edge::periodic), BadInput);
    Edges<1> line(Edge::wall);
    EXPECT_THROW(apply(line, open(front)), BadInput);
}

} // namespace
