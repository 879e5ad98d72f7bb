// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

#include <gtest/gtest.h>

namespace {

using namespace spate;
using Point = Vec<2, double>;

constexpr double H = 0.9, dx = H / 30, rho0 = 1000, g = 1;

template <class Eos>
auto settled_water(Eos eos, Point gravity)
{
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, eos, Continuity<2>{}, PressureForce<2>{}, Gravity<2>{gravity});
    Simulation s(water, RungeKutta2{}, Open{}, Serial{});
    s.fill(Box<2>{{0, 0}, {H, H}}, dx, settled);
    s.refresh();
    return s;
}

TEST(EnthalpyOf, UndoesTheHydrostaticDensity)
{
    const Tait tait{.rho0 = rho0, .c0 = 10};
    const LinearEos linear{.rho0 = rho0, .c0 = 10};
    for (double gz : {0.0, 1e-6, 0.1, 1.0, 10.0}) {
        EXPECT_NEAR(tait.enthalpy_of(tait.hydrostatic_density(gz)), gz, 1e-12 + 1e-13 * gz);
        EXPECT_NEAR(linear.enthalpy_of(linear.hydrostatic_density(gz)), gz, 1e-12 + 1e-13 * gz);
    }
}
/// Pressure is the weight of the rows above, and of half the particle's own; rows are dx rho0/rho apart: the midpoint rule over
/// a row, whose error is (g dx/c0^2)^2/24 of it at most. The foot stays; the water stands on the end that gravity points to.
TEST(Settled, BearsTheColumnAboveIt)
{
    for (Point gravity : {Point{0, -g}, Point{0, g}, Point{-g, 0}}) {
        const int c = gravity[0] != 0 ? 0 : 1;
        auto s = settled_water(Tait{.rho0 = rho0, .c0 = 10 * std::sqrt(g * H)}, gravity);
        auto const& p = s.particles();
        std::vector<std::array<double, 3>> column; // height above the foot, pressure, density
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Point x = p.at(position, i);
            if (x[1 - c] > dx) continue;
            column.push_back({gravity[c] < 0 ? x[c] : H - x[c], p.at(pressure, i), p.at(density, i)});
        }
        std::sort(column.begin(), column.end());
        ASSERT_EQ(column.size(), 30u);
        const double error = std::pow(g * dx / (100 * g * H), 2);
        for (std::size_t k = 0; k < column.size(); ++k) {
            const auto [z, weight, rho] = column[k];
            EXPECT_NEAR(weight, rho0 * g * dx * (29.5 - double(k)), 1e-9 * rho0 * g * H);
            const double step = z - (k == 0 ? -dx / 2 * rho0 / rho : column[k - 1][0]); // the foot at 0
            const double between = k == 0 ? rho : 0.5 * (rho + column[k - 1][2]);
            EXPECT_NEAR(step * between / rho0, dx, k == 0 ? 1e-3 * dx : (error + 1e-9) * dx) << k;
        }
    }
}
TEST(Settled, WantsGravityAlongAnAxis)
{
    const Tait eos{.rho0 = rho0, .c0 = 10};
    EXPECT_THROW(settled_water(eos, {0.1, -g}), BadInput);
    auto s = settled_water(eos, {0, 0});
    EXPECT_EQ(s.particles().at(density, 0), rho0);
    EXPECT_NEAR(s.particles().at(position, 0)[1], dx / 2, 1e-15);
}

} // namespace
