// SPDX-License-Identifier: BSD-3-Clause
// Walls that move by a law: the laws themselves, the pressure before a wall that accelerates, and lists that follow.
#include "spate/boundary/motion.hpp"

#include <spate/spate.hpp>

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace {

using namespace spate;
using At = Vec<2, double>;

double length(auto const& v) { return std::sqrt(v.squaredNorm()); }

/// Central differences at a few times: their error is dt^2/6 of the third derivative, of order 1 here.
template <int Dim>
void expect_derivatives(auto const& law)
{
    constexpr double d = 1e-4;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-1, 1);
    for (double t : {0.0, 0.3, 2.0}) {
        Vec<Dim, double> x0;
        for (int c = 0; c < Dim; ++c) x0[c] = u(random);
        const Rigid<Dim> before = law(t - d), now = law(t), after = law(t + d);
        const auto v = (1 / (2 * d)) * (after.position_of(x0) - before.position_of(x0));
        const auto a = (1 / (2 * d)) * (after.velocity_of(x0) - before.velocity_of(x0));
        EXPECT_LT(length(v - now.velocity_of(x0)), 20 * d * d);
        EXPECT_LT(length(a - now.acceleration_of(x0)), 60 * d * d);
        EXPECT_LT(length(now.rest_of(now.position_of(x0)) - x0), 1e-14);
        EXPECT_LT(length(law(0).position_of(x0) - x0), 1e-15); // at rest where it begins
    }
}
TEST(Motion, VelocityAndAccelerationAreTheDerivatives)
{
    expect_derivatives<1>(Steady<1>{.velocity = {{2}}, .acceleration = {{-1}}});
    expect_derivatives<2>(Oscillation<2>{.amplitude = {0.3, -0.2}, .omega = 3, .phase = 0.7});
    expect_derivatives<2>(Rotation<2>{.centre = {0.2, 0.1}, .omega = 3});
    expect_derivatives<3>(Rotation<3>{.centre = {0.2, 0.1, -1}, .omega = 2, .axis = {1, -2, 0.5}});
}
TEST(Motion, TurnsFromXToYAboutZ)
{
    const double quarter = std::numbers::pi / 2;
    const At y = Rotation<2>{.centre = {1, 1}, .omega = 1}(quarter).position_of({3, 1});
    EXPECT_LT(length(y - At{1, 3}), 1e-14);
    const Vec<3, double> z = Rotation<3>{.centre = {0, 0, 5}, .omega = 1}(quarter).position_of({2, 0, 5});
    EXPECT_LT(length(z - Vec<3, double>{0, 2, 5}), 1e-14);
    EXPECT_LT(length(Rotation<3>{.centre = {0, 0, 0}, .omega = 1, .axis = {0, 3, 0}}(1).position_of({0, 7, 0}) -
                     Vec<3, double>{0, 7, 0}),
              1e-14);
}

// ---- a tank that accelerates (numerics V19)
constexpr double H = 0.9, rho0 = 1000;
const At g{0, -1};
const double c0 = 10 * std::sqrt(2 * H);
const LinearEos eos{.rho0 = rho0, .c0 = c0};

/// The field of a fluid at rest in a tank with acceleration a: rho = rho0 exp((g - a) . (x - corner)/c0^2), and no pressure
/// in the highest corner as a body in the tank feels it.
double density_at(At const& x, At const& a)
{
    const At field = g - a, corner{field[0] > 0 ? 0 : H, field[1] > 0 ? 0 : H};
    return rho0 * std::exp(field.dot(x - corner) / (c0 * c0));
}
/// A closed tank, full, in which the fluid is at rest: lattice positions, densities of equilibrium.
template <class... Options>
auto tank(int n, At const& gravity, At const& acceleration, Options... options)
{
    const double dx = H / n;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, eos, Continuity<2>{}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.1}, Gravity<2>{gravity});
    const Box<2> box{{0, 0}, {H, H}};
    Simulation s(water, RungeKutta2{}, Bce(box, dx, Adami{}, options...));
    s.fill(box, dx, [&](auto& p, std::size_t i) { p.put(density, i, density_at(p.at(position, i), acceleration)); });
    return s;
}
auto accelerated(int n, At const& a) { return tank(n, g, a, moving(Steady<2>{.acceleration = a})); }

// Adami, Hu & Adams (2012, eq. 27) is exact for a linear pressure: what is left is the curvature of p over the range R,
// p'' R^2/2 = rho0 (|g - a| R/c0)^2/2, and the density in the sum, a relative |g - a| R/c0^2 of rho0 |g - a| R.
// Without a_w the error would be of the order of rho0 |a| dx/2 in the first layer.
TEST(AcceleratedTank, WallPressureContinuesThatOfTheFluid)
{
    for (At const& a : {At{0.7, 0}, At{0, 0.5}, At{0, -1}, At{-0.4, 0.3}}) {
        auto s = accelerated(20, a);
        s.refresh();
        auto const& w = s.system().species<1>().particles;
        const double R = s.physics().interaction.range(), G = length(g - a);
        const double bound = 1.5 * rho0 * (G * R / c0) * (G * R / c0) + 1e-9 * rho0 * c0 * c0;
        int seen = 0;
        for (std::size_t i = 0; i < w.size(); ++i) {
            const At x = w.at(position, i);
            if (!(w.at(kernel_sum, i) > 1e-6 * s.physics().interaction.kernel.sigma() * 4)) continue;
            const double p = eos.pressure_of(density_at(x, a));
            EXPECT_NEAR(w.at(pressure, i), p, bound) << x[0] << " " << x[1];
            ++seen;
        }
        EXPECT_GE(seen, 4 * 20);
    }
}
// A tank with acceleration a in the field g is a tank at rest in the field g - a: a law of mechanics, and of the discrete
// equations, since positions follow a constant acceleration exactly. What differs is rounding, which the sloshing of the
// fluid carries on; the steps must be the same for that, since the criteria look at speeds.
TEST(AcceleratedTank, IsATankAtRestInAnotherField)
{
    const At a{0.6, 0.2};
    auto s = accelerated(20, a);
    auto rest = tank(20, g - a, a);
    const double dt = 0.2 * 1.2 * (H / 20) / c0 / 2;
    s.run({.until = 0.5, .dt = dt});
    rest.run({.until = 0.5, .dt = dt});
    s.refresh(), rest.refresh();
    const double t = s.time();
    const At moved = (t * t / 2) * a;
    auto by_id = [](auto const& p) {
        std::vector<std::size_t> at(p.size());
        for (std::size_t i = 0; i < p.size(); ++i) at[p.id()[i]] = i;
        return at;
    };
    auto const &p = s.particles(), &q = rest.particles();
    const auto in_p = by_id(p), in_q = by_id(q);
    double stirred = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
        const std::size_t i = in_p[k], j = in_q[k];
        EXPECT_LT(length(p.at(position, i) - moved - q.at(position, j)), 1e-10 * H);
        EXPECT_LT(length(p.at(velocity, i) - t * a - q.at(velocity, j)), 1e-9);
        EXPECT_NEAR(p.at(pressure, i), q.at(pressure, j), 1e-8 * rho0 * length(g - a) * H);
        stirred = std::max(stirred, length(q.at(velocity, j)));
    }
    EXPECT_GT(stirred, 1e-4); // the fluid gives way: there is something to compare
    auto const& w = s.system().species<1>().particles;
    for (std::size_t i = 0; i < w.size(); ++i) {
        EXPECT_LT(length(w.at(position, i) - w.at(rest_position, i) - moved), 1e-12 * H);
        EXPECT_LT(length(w.at(velocity, i) - t * a), 1e-12);
    }
}

// ---- lists
/// A paddle that turns in a fluid at rest, and a wall of it that comes near.
auto paddle(auto backend, Neighbours neighbours)
{
    constexpr double dx = 0.05;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, eos, Continuity<2>{}, DensityDiffusion{.delta = 0.1},
                       PressureForce<2>{}, LaminarViscosity{.mu = 1}, ArtificialViscosity{.alpha = 0.1});
    const Box<2> box{{0, 0}, {2, 2}};
    Bce tank(box, dx, Adami{}, no_slip, obstacle(Box<2>{{0.4, 0.85}, {1.4, 1.15}}, Rotation<2>{{1, 1}, 1.5}),
             obstacle(Sphere<2>{{0.5, 0.4}, 0.15}, Oscillation<2>{.amplitude = {0.2, 0}, .omega = 4}));
    Simulation s(water, RungeKutta2{}, tank, backend, Double{}, Watch{}, neighbours);
    s.fill(box, dx);
    return s;
}
/// Without lists: the sum of the kernel over the fluid before a marker.
double kernel_sum_of(auto const& s, std::size_t k)
{
    const CubicSpline<2> kernel = s.physics().interaction.kernel;
    auto const& f = s.particles();
    const At x = s.system().template species<1>().particles.at(position, k);
    double sum = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
        const double q = length(x - f.at(position, i)) / kernel.h;
        if (q < 2) sum += kernel.sigma() * kernel.f(q);
    }
    return sum;
}
TEST(MovingWall, IsInTheListsOfItsNeighbours)
{
    auto s = paddle(Threads{1}, {.skin = 0.05});
    for (int k = 0; k < 30; ++k) {
        s.run({.steps = 3});
        s.refresh();
        auto const& w = s.system().species<1>().particles;
        for (std::size_t i = 0; i < w.size(); i += 3)
            ASSERT_NEAR(w.at(kernel_sum, i), kernel_sum_of(s, i), 1e-9 * 400) << "step " << s.steps();
    }
    EXPECT_GT(s.system().rebuilds(), 3);
}
// Nothing but the wall moves until it is there: only its own displacement can tell that the lists are out of date.
TEST(MovingWall, IsSeenWhenItComesNear)
{
    constexpr double dx = 0.05;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, eos, Continuity<2>{}, PressureForce<2>{});
    const Box<2> box{{0, 0}, {2, 0.5}};
    Simulation s(
        water, RungeKutta2{},
        Bce(box, dx, Adami{}, open(left, right), obstacle(Box<2>{{0, 0}, {0.5, 0.5}}, Steady<2>{.velocity = {1, 0}})));
    s.fill(Box<2>{{1, 0}, {1.5, 0.5}}, dx);
    auto const& w = s.system().species<1>().particles;
    auto seen = [&] {
        double most = 0;
        for (std::size_t i = 0; i < w.size(); ++i) {
            if (w.at(part, i) == 0) continue; // the floor sees the fluid from the start
            EXPECT_NEAR(w.at(kernel_sum, i), kernel_sum_of(s, i), 1e-9 * 400) << "step " << s.steps();
            most = std::max(most, w.at(kernel_sum, i));
        }
        return most;
    };
    while (s.time() < 0.48) {
        s.run({.steps = 2});
        s.refresh();
        seen();
    }
    EXPECT_GT(seen(), 10); // of the 1/dx^2 = 400 of a full support: they are neighbours now
}
TEST(MovingWall, LetsNothingThrough) // and drives the fluid
{
    auto s = paddle(Threads{1}, {});
    s.run({.until = 1});
    EXPECT_EQ(Leaks{0.05}(s), 0);
    double speed = 0;
    for (std::size_t i = 0; i < s.particles().size(); ++i)
        speed = std::max(speed, length(s.particles().at(velocity, i)));
    EXPECT_GT(speed, 0.5); // it has been stirred: the tip of the paddle does 0.6 m/s
}
// A belt along a periodic axis goes round more than once, and its markers stay in the box and in the lists.
TEST(MovingWall, GoesRoundAPeriodicAxis)
{
    constexpr double dx = 0.05;
    auto water =
        wcsph(CubicSpline<2>{.h = 1.2 * dx}, eos, Continuity<2>{}, PressureForce<2>{}, LaminarViscosity{.mu = 1});
    const Box<2> box{{0, 0}, {1, 0.6}};
    Simulation s(water, Leapfrog{},
                 Bce(box, dx, Adami{}, periodic(x_axis), no_slip,
                     obstacle(Box<2>{{0, 0}, {1, 0.2}}, Steady<2>{.velocity = {3, 0}})));
    EXPECT_EQ(s.fill(box, dx), 20u * 8);
    s.run({.until = 0.43});
    s.refresh();
    auto const& w = s.system().species<1>().particles;
    auto const& f = s.particles();
    const CubicSpline<2> kernel = s.physics().interaction.kernel;
    for (std::size_t k = 0; k < w.size(); ++k) {
        double sum = 0;
        for (std::size_t i = 0; i < f.size(); ++i) {
            const At x = nearest_image(w.at(position, k) - f.at(position, i), s.system().grid());
            if (length(x) < 2 * kernel.h) sum += kernel.sigma() * kernel.f(length(x) / kernel.h);
        }
        EXPECT_NEAR(w.at(kernel_sum, k), sum, 1e-9 * 400);
        const At off = nearest_image(w.at(position, k) - w.at(rest_position, k) - At{w.at(part, k) * 3 * s.time(), 0},
                                     s.system().grid());
        EXPECT_LT(length(off), 1e-12);
        EXPECT_LT(std::abs(w.at(position, k)[0] - 0.5), 0.5 + 0.3 * kernel.h); // wrapped at the last rebuild
    }
    double dragged = 0;
    for (std::size_t i = 0; i < f.size(); ++i) dragged = std::max(dragged, f.at(velocity, i)[0]);
    EXPECT_GT(dragged, 0.1);
}
// In space, in float, by an integrator that keeps the force of the last step.
TEST(MovingWall, TurnsInSpaceInFloat)
{
    constexpr double dx = 0.1;
    auto water = wcsph(CubicSpline<3>{.h = 1.2 * dx}, eos, Continuity<2>{}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.1});
    const Box<3> box{{0, 0, 0}, {1.6, 1.6, 1}};
    const Rotation<3> law{.centre = {0.8, 0.8, 0}, .omega = 2, .axis = {0, 0, 1}};
    Simulation s(water, Leapfrog{}, Bce(box, dx, Extrapolated{}, obstacle(Box<3>{{0.4, 0.6, 0.2}, {1.2, 1, 0.8}}, law)),
                 Threads{2}, Float{});
    s.fill(box, dx);
    s.run({.until = 0.4});
    EXPECT_EQ(Leaks{dx}(s), 0);
    auto const& w = s.system().species<1>().particles;
    for (std::size_t i = 0; i < w.size(); ++i)
        if (w.at(part, i) == 1) {
            // of the last step: dt^3 omega^3 r/6 by the integrator, and rounding
            const auto off = w.at(position, i) - law(s.time()).position_of(w.at(rest_position, i));
            EXPECT_LT(std::sqrt(off.squaredNorm()), 1e-6);
        }
}
TEST(MovingWall, BitsDependOnNobody)
{
    auto run = [](auto backend, Neighbours n) {
        auto s = paddle(backend, n);
        s.run({.steps = 200});
        return s.state_hash();
    };
    const Neighbours thin{.skin = 0.1, .bins = 1.4, .trigger = 0.08}, thick{.skin = 0.4, .bins = 1.4, .trigger = 0.08};
    const auto one = run(Threads{1}, thin);
    EXPECT_EQ(run(Threads{2, 1}, thin), one);
    EXPECT_EQ(run(Threads{1}, thick), one);
}

// ---- a piston (numerics X17)
// A piston at u = c0/20 into fluid at rest drives a shock: with rho0 (U - 0) = rho (U - u) and p = rho0 U u, and the linear
// equation of state p = c0^2 (rho - rho0), U^2 - u U - c0^2 = 0. The gate of the plan is 3 %.
TEST(Piston, DrivesTheShockOfRankineAndHugoniot)
{
    constexpr double dx = 0.02, length_ = 2, width = 0.2, c = 20, u = c / 20;
    auto fluid = wcsph(CubicSpline<2>{.h = 1.2 * dx}, LinearEos{.rho0 = rho0, .c0 = c}, Continuity<2>{},
                       PressureForce<2>{}, ArtificialViscosity{.alpha = 1}, DensityDiffusion{.delta = 0.1});
    const Box<2> box{{0, 0}, {length_, width}};
    const double start = 0.2;
    Bce tube(box, dx, Adami{}, periodic(y_axis), obstacle(Box<2>{{0, -1}, {start, 1}}, Steady<2>{.velocity = {u, 0}}));
    Simulation s(fluid, RungeKutta2{}, tube);
    EXPECT_EQ(s.fill(box, dx), std::size_t(90 * 10));
    const double U = u / 2 + std::sqrt(u * u / 4 + c * c), behind = rho0 * U * u;
    s.run({.until = 1.2 / U, .cfl = 0.2});
    s.refresh();
    auto const& p = s.particles();
    double sum = 0, front = 0;
    int n = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double x = p.at(position, i)[0] - start;
        if (x > 0.3 && x < 0.9) sum += p.at(pressure, i), ++n;
        if (p.at(pressure, i) > behind / 2) front = std::max(front, x);
    }
    EXPECT_NEAR(sum / n / behind, 1, 0.03);
    EXPECT_NEAR(front / s.time() / U, 1, 0.03);
    EXPECT_EQ(Leaks{dx}(s), 0);
}

} // namespace
