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

TEST(Gauge, SeesThroughAPeriodicFace)
{
    auto scene = measured::tank(0, 30, periodic(x_axis));
    scene.add({1 - h / 2, 0.25});
    scene.prepare();
    EXPECT_EQ((Gauge{"depth", Point{0, 0}, dx}(scene)), 0.25 + dx / 2);
}

} // namespace
