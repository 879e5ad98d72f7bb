// SPDX-License-Identifier: BSD-3-Clause
// The distance that a solid states: its sign says who is in it, and it never changes faster than the way to a point.
#include <spate/spate.hpp>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace spate;
using At = Vec<3, double>;

double length(At const& v) { return std::sqrt(v.squaredNorm()); }

/// At random points: the sign is that of `holds`, and |d(x) - d(y)| <= |x - y|.
void expect_solid(auto const& solid, auto const& holds)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> u(-2, 2);
    auto point = [&] { return At{u(random), u(random), u(random)}; };
    int within = 0;
    for (int k = 0; k < 4000; ++k) {
        const At x = point(), y = x + 0.1 * point();
        const double d = solid.distance(x);
        EXPECT_EQ(d < 0, holds(x)) << x[0] << " " << x[1] << " " << x[2];
        EXPECT_LE(std::abs(d - solid.distance(y)), length(x - y) + 1e-12);
        within += d < 0;
    }
    EXPECT_GT(within, 20);
    EXPECT_LT(within, 3980);
}
const Box<3> cube{{-1, -0.5, -1}, {1, 1.5, 0.5}};
const Sphere<3> ball{{0.2, 0.1, -0.3}, 1};
const Cylinder post{{0.1, 0.3, -1}, 0.8, 1.7};
const HalfSpace<3> hill{{0, 0.2, 0}, {1, 2, -2}};
const Wedge<3> ramp{{-1, 0, -0.5}, 2, 1};
bool in_cube(At const& x) { return cube.contains(x); }
bool in_ball(At const& x) { return length(x - ball.centre) < 1; }
bool in_post(At const& x) { return std::hypot(x[0] - 0.1, x[1] - 0.3) < 0.8 && x[2] > -1 && x[2] < 0.7; }

TEST(Solid, HoldsWhatItsDistanceSays)
{
    expect_solid(cube, in_cube);
    expect_solid(ball, in_ball);
    expect_solid(post, in_post);
    expect_solid(hill, [](At const& x) { return x[0] + 2 * (x[1] - 0.2) - 2 * x[2] < 0; });
    expect_solid(ramp, [](At const& x) { return x[0] < 1 && x[2] > -0.5 && x[2] + 0.5 < 0.5 * (x[0] + 1); });
    expect_solid(Wedge<3>{{1, 0, -0.5}, -2, 1},
                 [](At const& x) { return x[0] > -1 && x[2] > -0.5 && x[2] + 0.5 < 0.5 * (1 - x[0]); });
    expect_solid(unite(cube, ball), [](At const& x) { return in_cube(x) || in_ball(x); });
    expect_solid(intersect(post, ball), [](At const& x) { return in_post(x) && in_ball(x); });
    expect_solid(subtract(cube, ball), [](At const& x) { return in_cube(x) && !in_ball(x); });
    expect_solid(inside_out(post), [](At const& x) { return !in_post(x); });
}
TEST(Solid, IsAsFarAsItsSurface)
{
    EXPECT_NEAR(cube.distance({2, 0, 0}), 1, 1e-15);
    EXPECT_NEAR(cube.distance({2, 2.5, 0}), std::sqrt(2), 1e-15); // from an edge
    EXPECT_NEAR(cube.distance({0, 0.5, 0.2}), -0.3, 1e-14);
    EXPECT_NEAR(ball.distance({0.2, 0.1, 2.7}), 2, 1e-14);
    EXPECT_NEAR(post.distance({0.1 + 0.8 + 3, 0.3, 0.7 + 4}), 5, 1e-14); // from the rim
    EXPECT_NEAR(post.distance({0.1, 0.3, 0.6}), -0.1, 1e-14);
    EXPECT_NEAR((Cylinder{{0, 0, 0}, 1, 4, 0}).distance({2, 0, 3}), 2, 1e-14); // along x
    EXPECT_NEAR(hill.distance({1, 2.2, -2}), 3, 1e-14);
    EXPECT_NEAR(ramp.distance({0, 7, std::sqrt(5) / 2}), 1, 1e-14); // straight above the slope of 1 in 2
}

} // namespace
