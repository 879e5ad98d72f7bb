// SPDX-License-Identifier: BSD-3-Clause
#include "spate/spate.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;

auto grains()
{
    return Simulation(dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}), Leapfrog{}, Open{}, Serial{},
                      Double{}, Watch{.overlap = 2});
}

TEST(Open, HasNoEnd)
{
    const Open space;
    EXPECT_FALSE(space.box<3>());
    for (int axis : {0, 1, 2})
        for (bool upper : {false, true}) EXPECT_EQ(space.edges<3>().at(axis, upper), Edge::open);
    EXPECT_EQ((space.beyond<2>({{1e300, -1e300}})), 0);
    EXPECT_EQ(space.thickness(1), 0);
    EXPECT_FALSE(Open::markers);
}
// An isolated particle flies straight, to the rounding of its sum of steps.
TEST(Open, LetsALoneParticleFly)
{
    auto sim = grains();
    sim.add({{0.3, -7}}, {{3, -0.5}});
    const int n = 1000;
    const double dt = 1e-3;
    sim.run({.steps = n, .dt = dt});
    EXPECT_NEAR(sim.particles().at(position, 0)[0], 0.3 + 3 * n * dt, 1e-14 * n);
    EXPECT_NEAR(sim.particles().at(position, 0)[1], -7 - 0.5 * n * dt, 1e-14 * n);
    EXPECT_EQ(sim.particles().at(velocity, 0), (Vec<2, double>{{3, -0.5}}));
}
// Memory follows the cells that are occupied, not the box around them: here 1e6 by 3e6 ranges.
TEST(Open, KeepsNothingForEmptySpace)
{
    auto sim = grains();
    for (double x : {0.0, 1e4, 2e4}) sim.add({{x, -3 * x}});
    sim.run({.steps = 2, .dt = 1e-3});
    EXPECT_EQ(sim.system().species<0>().bins.cells(), 3u);
    EXPECT_LT(sim.system().bytes(), 1u << 20);
}
TEST(Open, APairActsAlikeFarFromTheOrigin)
{
    double depth[2];
    for (int k : {0, 1}) {
        auto sim = grains();
        const double x = k == 0 ? 0 : 65536;
        sim.add({{x, x}}, {{0, 0}});
        sim.add({{x + 0.015625, x}}, {{0, 0}});
        sim.run({.steps = 1, .dt = 1e-4});
        const auto& p = sim.particles();
        depth[k] = (p.at(velocity, 0) - p.at(velocity, 1)).squaredNorm();
    }
    EXPECT_GT(depth[0], 0);
    EXPECT_NEAR(depth[1] / depth[0], 1,
                7e-9); // a drift rounds each of two positions by 7e-12, of an overlap of 4.4e-3; squared
}
TEST(Open, RunsWithNobodyInIt)
{
    auto sim = grains();
    sim.run({.steps = 3, .dt = 1e-3});
    EXPECT_EQ(sim.steps(), 3);
    EXPECT_EQ(sim.energy().total(), 0);
}

} // namespace
