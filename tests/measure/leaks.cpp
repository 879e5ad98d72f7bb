// SPDX-License-Identifier: BSD-3-Clause
#include "spate/measure/leaks.hpp"

#include "measure/tank.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;
using measured::dx;

TEST(Leaks, AreNoneInWaterAtRest)
{
    auto still = measured::tank(0.5, 30);
    EXPECT_EQ(Leaks{dx}(still), 0);
}

TEST(Leaks, BeginHalfASpacingBeyondAWall)
{
    auto scene = measured::tank(0, 30);
    scene.add({0.5, 0.5});
    scene.add({0.5, 3});          // over the open top
    scene.add({-0.49 * dx, 0.5}); // in the skin of the wall
    scene.add({0.5, -0.49 * dx});
    EXPECT_EQ(Leaks{dx}(scene), 0);
    scene.add({-0.51 * dx, 0.5});
    scene.add({1 + 0.51 * dx, 0.5});
    scene.add({0.5, -0.51 * dx});
    scene.add({0.5, -2});
    EXPECT_EQ(Leaks{dx}(scene), 4);
}

TEST(Leaks, AreNoneThroughAPeriodicFace)
{
    auto scene = measured::tank(0, 30, periodic(x_axis));
    scene.add({-0.2, 0.5});
    EXPECT_EQ(Leaks{dx}(scene), 0);
    scene.add({-0.2, -0.2});
    EXPECT_EQ(Leaks{dx}(scene), 1);
}

} // namespace
