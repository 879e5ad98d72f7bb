// SPDX-License-Identifier: BSD-3-Clause
// Still water on walls of every state, in 2D: V19 of the validation plan.
#include "models/still_water.hpp"

namespace {

using namespace still_water;

TEST(StillWater, ProfileIsThatOfTheCompressibleFluid)
{
    // dp/dz = rho g by the midpoint rule, and the excess over rho0 g H that the validation plan states at g H/c0^2 = 0.01
    double p = 0;
    constexpr int steps = 10000;
    for (int k = 0; k < steps; ++k) {
        const double half = p + eos.density_of(p) * g * H / steps / 2;
        p += eos.density_of(half) * g * H / steps;
    }
    EXPECT_NEAR(pressure_at(H) / p, 1, 1e-9);
    EXPECT_NEAR(pressure_at(H) / (rho0 * g * H) - 1, 0.004919, 1e-6);
    EXPECT_NEAR(depth_of(pressure_at(H)), H, 1e-12);
}

/// Adami's markers carry the pressure of their own depth, up to the second order of Taylor's series over their range:
/// p'' = rho g^2/c^2. Those above the surface pull as the line through the fluid says.
TEST(StillWater, WallsBearThePressureOfTheirDepth)
{
    constexpr int n = 25;
    auto s = still<CubicSpline<2>>(n, 1.2);
    s.refresh();
    auto const& wall = s.system().template species<1>().particles;
    const double reach = s.physics().interaction.range();
    const double most = 0.5 * eos.density_of(pressure_at(H + reach)) * std::pow(g * reach / c0, 2);
    int seen = 0;
    for (std::size_t i = 0; i < wall.size(); ++i) {
        if (wall.at(kernel_sum, i) < 1e-3 / std::pow(reach, 2)) continue;
        const double depth = surface - wall.at(position, i)[1];
        EXPECT_NEAR(wall.at(pressure, i), depth > 0 ? pressure_at(depth) : rho0 * g * depth, most) << i;
        ++seen;
    }
    EXPECT_GT(seen, 3 * n);
}

TYPED_TEST_SUITE(StillWaterOn, States);
/// Right after the calm, for two periods of sound.
TYPED_TEST(StillWaterOn, HasTheExactPressure)
{
    constexpr int n = 50;
    const auto c = this->named("2D, two periods of sound", n);
    auto s = still<CubicSpline<2>>(n, 1.2, DensityDiffusion{.delta = 0.1}, TypeParam{});
    calm(s);
    const Worst w = watch(s, H / n, 2);
    tell(this->name("2D, H/dx 50, short"), w);
    this->expect(c, w, this->gate);
    if (std::same_as<TypeParam, ByContinuity>) c.at_most(of_floor, w.floor, 0.01);
    else c.known_gap(of_floor, w.floor, std::string("V19 floor ") + TypeParam::name);
}

} // namespace
