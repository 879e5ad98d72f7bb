// SPDX-License-Identifier: BSD-3-Clause
#include "spate/measure/front.hpp"

#include "measure/tank.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;
using measured::dx;

TEST(Front, IsTheFaceOfAFullBox)
{
    auto still = measured::tank(0.5, 30);
    EXPECT_NEAR(Front{dx}(still), 1, 1e-15);
    EXPECT_NEAR((Front{.spacing = dx, .axis = 1}(still)), 0.5, 1e-15);
}

TEST(Front, LeavesOutOneInTwoHundred)
{
    auto scene = measured::tank(0, 30);
    for (int k = 200; k >= 1; --k) scene.add({k / 256.0, 0.5});
    EXPECT_EQ(Front{dx}(scene), 199 / 256.0 + dx / 2); // the 200th flies ahead
    scene.add({0.999, 0.5});                           // 0.995 of 201 is 199.995: the nearest rank is 200
    EXPECT_EQ(Front{dx}(scene), 200 / 256.0 + dx / 2);
    EXPECT_EQ((Front{.spacing = dx, .share = 1}(scene)), 0.999 + dx / 2);
}

TEST(Front, OfNothingIsNotANumber)
{
    auto empty = measured::tank(0, 30);
    EXPECT_TRUE(std::isnan(Front{dx}(empty)));
}

} // namespace
