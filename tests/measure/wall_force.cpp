// SPDX-License-Identifier: BSD-3-Clause
#include "spate/measure/wall_force.hpp"

#include "measure/tank.hpp"

#include <random>

#include <gtest/gtest.h>

namespace {

using namespace spate;
using measured::dx;
using measured::g;
using measured::h;
using measured::Point;

/// -sum V x dW/dx over the lattice: what SPH makes of a unit gradient there.
double gradient_sum()
{
    const CubicSpline<2> kernel{.h = h};
    double sum = 0;
    for (int i = -3; i <= 3; ++i)
        for (int k = -3; k <= 3; ++k)
            sum -= dx * dx * (i * dx) * (i * dx) * kernel.sigma() / (h * h) *
                   CubicSpline<2>::g(std::sqrt(double(i * i + k * k)) * dx / h);
    return sum;
}

// With a linear pressure, which Adami's markers continue exactly, each particle with a full support feels S g upwards, S the
// lattice's gradient sum; what the surface lacks sums to zero by pairs mirrored at it: the walls carry S times the weight.
// Compressibility moves this by less than 3 gH/c0^2: floor pressure (1 + gH/(2 c0^2)), volumes (rho0/rho)^2 >= 1 - 2 gH/c0^2.
TEST(WallForce, OfWaterAtRestIsItsWeight)
{
    for (double depth : {0.4, 0.8}) {
        const double epsilon = 1e-5, c0 = std::sqrt(g * depth / epsilon);
        auto still = measured::tank(depth, c0);
        still.refresh();
        const Point force = WallForce{}(still);
        const double weight = 1000 * depth * 1 * g;
        EXPECT_NEAR(force[1] / -weight, gradient_sum(), 3 * epsilon);
        EXPECT_NEAR(force[0] / weight, 0, 1e-12); // the thrusts on left and right balance
    }
    EXPECT_NEAR(gradient_sum(), 1, 0.02); // the discretisation: numerics of the cubic spline near h = 1.2 dx
}

/// Water that has been stirred: jitter of a tenth of a spacing, random velocities.
auto stirred()
{
    auto scene = measured::tank(0.4, 30);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(-1, 1);
    auto& p = scene.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        p.put(position, i, p.at(position, i) + Point{0.1 * dx * u(random), 0.1 * dx * u(random)});
        p.put(velocity, i, Point{u(random), u(random)});
    }
    scene.prepare();
    scene.refresh();
    return scene;
}

// Each pair by hand and from the side of the marker: the fluid's force on it.
TEST(WallForce, IsTheSumOfTheForcesOnTheMarkers)
{
    auto scene = stirred();
    auto const& fluid = scene.particles();
    auto const& wall = scene.system().template species<1>().particles;
    const CubicSpline<2> kernel{.h = h};
    const double alpha = 0.1, c0 = 30, m = 1000 * dx * dx;
    Point sum{};
    double size = 0;
    for (std::size_t w = 0; w < wall.size(); ++w)
        for (std::size_t f = 0; f < fluid.size(); ++f) {
            const Point x = wall.at(position, w) - fluid.at(position, f), v = Point{} - fluid.at(velocity, f);
            const double r2 = x.squaredNorm(), rho_w = wall.at(density, w), rho_f = fluid.at(density, f);
            if (r2 >= 4 * h * h) continue;
            const Point grad_w = kernel.sigma() / (h * h) * CubicSpline<2>::g(std::sqrt(r2) / h) * x;
            const double mu = h * std::min(v.dot(x), 0.0) / (r2 + 0.01 * h * h),
                         Pi = -2 * alpha * c0 * mu / (rho_w + rho_f);
            const double a = wall.at(pressure, w) / (rho_w * rho_w) + fluid.at(pressure, f) / (rho_f * rho_f) + Pi;
            sum -= (m * m * a) * grad_w;
            size += m * m * std::abs(a) * std::sqrt(grad_w.squaredNorm());
        }
    const Point force = WallForce{}(scene);
    for (int c = 0; c < 2; ++c) EXPECT_NEAR(force[c], sum[c], 1e-12 * size);
    EXPECT_GT(size, 1000 * 0.4 * g); // there was something to sum
}

// The rate of change of momentum is the weight and the force of the walls: pairs within the fluid cancel.
TEST(WallForce, AndWeightChangeTheMomentum)
{
    auto scene = stirred();
    const Point force = WallForce{}(scene);
    scene.system().rates(Fields{velocity});
    auto const& p = scene.particles();
    Point sum{};
    double size = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        sum += p.at(mass, i) * p.at(acceleration, i);
        size += p.at(mass, i) * std::sqrt(p.at(acceleration, i).squaredNorm());
    }
    const double weight = double(p.size()) * p.at(mass, 0) * g;
    EXPECT_NEAR(sum[0], -force[0], 1e-12 * size);
    EXPECT_NEAR(sum[1], -force[1] - weight, 1e-12 * size);
}

TEST(WallForce, ChangesNothing)
{
    auto scene = stirred();
    scene.system().rates(Fields{velocity, density});
    auto const& p = scene.particles();
    const auto before = p.column(acceleration)[1];
    const auto rate = p.column(density_rate)[0];
    const auto hash = scene.state_hash();
    (void)WallForce{}(scene);
    EXPECT_EQ(scene.state_hash(), hash);
    for (std::size_t i = 0; i < p.size(); ++i) {
        EXPECT_EQ(p.column(acceleration)[1][i], before[i]);
        EXPECT_EQ(p.column(density_rate)[0][i], rate[i]);
    }
}

} // namespace
