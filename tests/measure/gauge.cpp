// SPDX-License-Identifier: BSD-3-Clause
#include "spate/measure/gauge.hpp"

#include "measure/tank.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;
using measured::dx;
using measured::h;
using measured::Point;

TEST(Gauge, IsTheDepthOfStillWater)
{
    auto still = measured::tank(0.4, 30);
    for (double x : {0.0, 0.3, 0.525, 1.0}) {
        EXPECT_NEAR((Gauge{"depth", Point{x, 0}, dx}(still)), 0.4, 1e-15);
        EXPECT_NEAR((Gauge{"above a step", Point{x, 0.1}, dx}(still)), 0.3, 1e-15);
    }
}

TEST(Gauge, SeesASmoothingLengthAside)
{
    auto scene = measured::tank(0, 30);
    scene.add({0.5, 0.125});
    scene.add({0.5 + 1.01 * h, 0.75});
    EXPECT_EQ((Gauge{"depth", Point{0.5, 0}, dx}(scene)), 0.125 + dx / 2);
    scene.add({0.5 - 0.99 * h, 0.625});
    EXPECT_EQ((Gauge{"depth", Point{0.5, 0}, dx}(scene)), 0.625 + dx / 2);
    EXPECT_EQ((Gauge{"depth", Point{0.2, 0}, dx}(scene)), 0); // dry
}

TEST(WettedLength, IsTheDepthOfStillWaterWhereverItsSquareLies)
{
    auto still = measured::tank(0.4, 30);
    for (double x : {0.2, 0.3, 0.525})
        for (double half : {dx / 3, dx, 2.2 * dx})
            EXPECT_NEAR((WettedLength{"depth", Point{x, 0}, half, dx}(still)), 0.4, 1e-12) << x << ' ' << half;
    EXPECT_NEAR((WettedLength{"above a step", Point{0.3, 0.1}, dx, dx}(still)), 0.3, 1e-12);
    EXPECT_NEAR((WettedLength{"at the wall", Point{0, 0}, dx, dx}(still)), 0.2, 1e-12); // half of it is beyond
}
TEST(WettedLength, CountsSprayByItsVolume)
{
    auto scene = measured::tank(0, 30);
    scene.add({0.5, 0.125});
    scene.add({0.5 + dx / 2, 0.75});
    EXPECT_NEAR((WettedLength{"depth", Point{0.5, 0}, dx / 2, dx}(scene)), 1.5 * dx, 1e-15);
    EXPECT_NEAR((WettedLength{"depth", Point{0.5, 0}, dx, dx}(scene)), dx, 1e-15);
    EXPECT_EQ((WettedLength{"depth", Point{0.2, 0}, dx, dx}(scene)), 0);
}
TEST(WettedLength, SeesThroughAPeriodicFace)
{
    auto scene = measured::tank(0, 30, periodic(x_axis));
    scene.add({1 - dx / 4, 0.25});
    scene.prepare();
    EXPECT_NEAR((WettedLength{"depth", Point{0, 0}, dx, dx}(scene)), dx / 2, 1e-15);
}

TEST(Gauge, SeesThroughAPeriodicFace)
{
    auto scene = measured::tank(0, 30, periodic(x_axis));
    scene.add({1 - h / 2, 0.25});
    scene.prepare();
    EXPECT_EQ((Gauge{"depth", Point{0, 0}, dx}(scene)), 0.25 + dx / 2);
}

} // namespace
