// SPDX-License-Identifier: BSD-3-Clause
// Bodies that move by the forces on them.
#include "spate/boundary/floating.hpp"

#include <spate/spate.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace spate;
using At = Vec<2, double>;

constexpr double rho0 = 1000, dx = 0.02, gravity = 9.81;

double length(auto const& v) { return std::sqrt(v.squaredNorm()); }

auto water(double c0, At const& g, double alpha = 0.1)
{
    return wcsph(CubicSpline<2>{.h = 1.3 * dx}, Tait{.rho0 = rho0, .c0 = c0}, Continuity<2>{},
                 DensityDiffusion{.delta = 0.1}, PressureForce<2>{}, ArtificialViscosity{.alpha = alpha},
                 Gravity<2>{g});
}
auto const& body_of(auto const& scene, int k = 0) { return scene.system().boundary().bodies()[k]; }

TEST(Floating, FallsAsTheIntegratorHasIt)
{
    const At g{0, -gravity};
    const Box<2> box{{0, 0}, {1, 20}};
    Simulation s(
        water(10, g), Leapfrog{},
        Bce(box, dx, Adami{}, open(top),
            obstacle(Box<2>{{0.4, 10}, {0.6, 10.2}}, Floating<2>{.density = 500, .velocity = {0.5, 1}, .spin = 3})));
    s.run({.steps = 1000, .dt = 1e-3});
    const auto& b = body_of(s);
    EXPECT_NEAR(b.mass, 500 * 0.04, 1e-9);
    EXPECT_NEAR(b.place()[0], 0.5 + 0.5, 1e-12);
    EXPECT_NEAR(b.place()[1], 10.1 + 1 - gravity / 2, 1e-11);
    EXPECT_NEAR(b.state.velocity[1], 1 - gravity, 1e-11);
    EXPECT_NEAR(b.state.attitude.angle, 3, 1e-12);
}

} // namespace
