// SPDX-License-Identifier: BSD-3-Clause
#include "spate/measure/probe.hpp"

#include "measure/tank.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;
using measured::h;

/// A particle with a density, a pressure and a velocity.
void put(auto& scene, measured::Point x, double rho, double p, measured::Point v = {})
{
    const auto i = scene.add(x, v);
    scene.particles().put(density, i, rho);
    scene.particles().put(pressure, i, p);
}

// The cubic spline's f is 4 at q = 0 and 1 at q = 1 (both times sigma): the weights are 4 / rho and 1 / rho.
TEST(Probe, IsTheMeanWeightedByVolumeAndKernel)
{
    auto scene = measured::tank(0, 30);
    put(scene, {0.5, 0.5}, 1000, 100, {3, 0});
    put(scene, {0.5 + h, 0.5}, 500, 700, {0, 6});
    put(scene, {0.5, 0.5 - 2.01 * h}, 1000, 1e9, {1e9, 1e9}); // beyond the support
    const measured::Point at{0.5, 0.5};
    EXPECT_NEAR((Probe{"p", pressure, at}(scene)), (4 * 100 + 2 * 700) / 6.0, 1e-10);
    EXPECT_NEAR((Probe{"rho", density, at}(scene)), (4 * 1000 + 2 * 500) / 6.0, 1e-10);
    const auto v = Probe{"v", velocity, at}(scene);
    EXPECT_NEAR(v[0], 4 * 3 / 6.0, 1e-14);
    EXPECT_NEAR(v[1], 2 * 6 / 6.0, 1e-14);
}

TEST(Probe, ReproducesAConstant)
{
    auto still = measured::tank(0.5, 30);
    auto& p = still.particles();
    for (std::size_t i = 0; i < p.size(); ++i) p.put(pressure, i, 123.0);
    for (measured::Point at : {measured::Point{0, 0}, {0.31, 0.22}, {0.999, 0.5}})
        EXPECT_NEAR((Probe{"p", pressure, at}(still)), 123, 123e-15);
}

TEST(Probe, SeesThroughAPeriodicFace)
{
    auto scene = measured::tank(0, 30, periodic(x_axis));
    put(scene, {0.02, 0.5}, 1000, 100);
    put(scene, {0.98, 0.5}, 1000, 300);
    scene.prepare();
    EXPECT_NEAR((Probe{"p", pressure, measured::Point{0, 0.5}}(scene)), 200, 1e-10);
}

TEST(Probe, OfNothingIsNotANumber)
{
    auto still = measured::tank(0.2, 30);
    EXPECT_TRUE(std::isnan(Probe{"p", pressure, measured::Point{0.5, 0.8}}(still)));
}

} // namespace
