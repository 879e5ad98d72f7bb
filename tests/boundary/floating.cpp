// SPDX-License-Identifier: BSD-3-Clause
// Solids that move by the forces on them: mechanics that needs no fluid, what the fluid gives and takes, Archimedes.
#include "spate/boundary/floating.hpp"

#include "extreme/chosen.hpp"

#include <spate/spate.hpp>

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

namespace {

using namespace spate;
using At = Vec<2, double>;

constexpr double rho0 = 1000, dx = 0.02, gravity = 9.81;

double length(auto const& v) { return std::sqrt(v.squaredNorm()); }

// ---- a body alone
TEST(Body, HasTheMassAndInertiaOfItsCubes)
{
    std::vector<At> square;
    std::vector<Vec<3, double>> cuboid;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 2; ++k) {
            square.push_back({{3 + (i + 0.5) * 0.5, (k + 0.5) * 0.5}});
            for (int l = 0; l < 6; ++l) cuboid.push_back({{(i + 0.5) * 0.5, (k + 0.5) * 0.5, (l + 0.5) * 0.5}});
        }
    const auto flat = detail::body_of(Floating<2>{.density = 3, .spin = 2}, square, 0.5);
    EXPECT_DOUBLE_EQ(flat.mass, 3 * 2 * 1);
    EXPECT_LT(length(flat.centre - At{{4, 0.5}}), 1e-14);
    EXPECT_NEAR(1 / flat.inverse_inertia[0][0], 6.0 / 12 * (2 * 2 + 1 * 1), 1e-13); // m/12 (a^2 + b^2)
    EXPECT_NEAR(flat.spin()[0], 2, 1e-14);
    const auto block = detail::body_of(Floating<3>{.mass = 12, .spin = {{1, 2, 3}}}, cuboid, 0.5);
    const double of_axis[] = {1 * 1 + 3 * 3, 2 * 2 + 3 * 3, 2 * 2 + 1 * 1};
    for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
            EXPECT_NEAR(block.inverse_inertia[std::size_t(k)][l], k == l ? 1.0 / of_axis[k] : 0, 1e-14);
    EXPECT_LT(length(block.spin() - Vec<3, double>{{1, 2, 3}}), 1e-14);
}
// Torque-free: L is kept to the last bit, energy to the order of the scheme (Euler's equations have no closed form here).
TEST(Body, ThatTumblesKeepsEnergyToSecondOrder)
{
    auto lost = [](int steps) {
        Body<3> b;
        b.mass = 1;
        for (int k = 0; k < 3; ++k) b.inverse_inertia[std::size_t(k)][k] = 1.0 / (k + 1);
        b.state.angular_momentum = {{0.3, 2, 0.4}}; // about the middle axis: it turns over
        const double before = b.kinetic_energy();
        for (int k = 0; k < steps; ++k) b.drift(20.0 / steps);
        return std::abs(b.kinetic_energy() / before - 1);
    };
    const double coarse = lost(400), fine = lost(800);
    EXPECT_GT(coarse, 1e-7);
    EXPECT_GT(std::log2(coarse / fine), 1.8);
    EXPECT_LT(coarse, 1e-2);
}
// A symmetric top precesses about L with |L|/I1 (Landau & Lifshitz, Mechanics, 33).
TEST(Body, ThatIsSymmetricPrecessesAsTheoryHasIt)
{
    Body<3> b;
    b.mass = 1;
    const double I1 = 2, I3 = 1;
    b.inverse_inertia = {Vec<3, double>{{1 / I1, 0, 0}}, {{0, 1 / I1, 0}}, {{0, 0, 1 / I3}}};
    const double L = 1.3, tilt = 0.5;
    b.state.angular_momentum = {{L * std::sin(tilt), 0, L * std::cos(tilt)}};
    const double period = 2 * std::numbers::pi * I1 / L;
    const int steps = 1000;
    for (int k = 0; k < steps; ++k) b.drift(period / steps);
    const auto R = b.state.attitude.matrix();
    const Vec<3, double> axis{{R[0][2], R[1][2], R[2][2]}};
    EXPECT_LT(length(axis - Vec<3, double>{{0, 0, 1}}), 1e-4); // it came round; dt^2 is 4e-5
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l) EXPECT_NEAR(R[k].dot(R[l]), k == l ? 1 : 0, 1e-14);
}

// ---- in a tank
struct Tank {
    double c0 = 28;
    Box<2> box{{{0, 0}}, {{1, 0.8}}};
    At g{0, -gravity};
    double alpha = 0.1;
};
/// \param integrator  one of chosen.hpp: all are one type of scene
template <class S = Adami, class... O>
auto tank(Tank const& t, int integrator, S state, O... options)
{
    chosen::integrator = integrator;
    auto water = wcsph(WendlandC2<2>{.h = 1.5 * dx}, Tait{.rho0 = rho0, .c0 = t.c0}, Continuity<2>{},
                       DensityDiffusion{.delta = 0.1}, PressureForce<2>{}, ArtificialViscosity{.alpha = t.alpha},
                       Gravity<2>{t.g});
    return Simulation(water, chosen::AnyIntegrator{}, Bce(t.box, dx, state, open(top), options...));
}
auto const& body_of(auto const& scene, int k = 0) { return scene.system().boundary().bodies()[k]; }
constexpr Box<2> raft(double foot) { return {{{0.34, foot}}, {{0.66, foot + 0.16}}}; }

TEST(Floating, RefusesWhatIsNoBody)
{
    auto tank_with = [](Box<2> const& solid, Floating<2> const& law) {
        return Bce(Box<2>{{0, 0}, {1, 1}}, dx, Adami{}, open(top), obstacle(solid, law));
    };
    const Box<2> block{{0.4, 0.4}, {0.6, 0.6}};
    EXPECT_THROW(tank_with(block, {}), BadInput);
    EXPECT_THROW(tank_with(block, {.density = 500, .mass = 2}), BadInput);
    EXPECT_THROW(tank_with(block, {.density = -1}), BadInput);
    EXPECT_THROW(tank_with(block, {.density = 500, .contact = {.k = -1}}), BadInput);
    EXPECT_THROW(tank_with({{2, 2}, {3, 3}}, {.density = 500}), BadInput);               // outside
    EXPECT_THROW(tank_with({{0.501, 0.501}, {0.505, 0.505}}, {.density = 1}), BadInput); // between the points
    EXPECT_EQ(tank_with(block, {.mass = 2}).bodies()[0].mass, 2);
}
// Free fall: x + v t - g t^2/2 of second-order schemes; the first-order ones lag or lead by g dt t/2. A step rounds x and v
// a few times.
void falls(int integrator, double lead)
{
    auto s =
        tank({.box = {{{0, 0}}, {{1, 3}}}}, integrator, Adami{},
             obstacle(Box<2>{{0.4, 2}, {0.6, 2.2}}, Floating<2>{.density = 500, .velocity = {{0.05, 1}}, .spin = 3}));
    constexpr int steps = 1000;
    constexpr double dt = 5e-4, t = steps * dt, rounding = 4 * steps * 0x1p-53 * 4;
    s.run({.steps = steps, .dt = dt});
    auto const& b = body_of(s);
    EXPECT_NEAR(b.mass, 500 * 0.04, 1e-12);
    EXPECT_NEAR(b.place()[0], 0.5 + 0.05 * t, rounding);
    EXPECT_NEAR(b.place()[1], 2.1 + t - gravity * t * t / 2 + lead * gravity * dt * t / 2, rounding);
    EXPECT_NEAR(b.state.velocity[1], 1 - gravity * t, rounding);
    EXPECT_NEAR(b.state.attitude.angle, 3 * t, rounding);
    auto const& w = s.system().template species<1>().particles; // no NaN of sums over nobody, and each in its place
    for (std::size_t i = 0; i < w.size(); ++i) {
        EXPECT_EQ(w.at(pressure, i), 0);
        if (w.at(part, i) == 1) {
            EXPECT_LT(length(w.at(position, i) - b.rigid().position_of(w.at(rest_position, i))), 1e-14);
        }
    }
}
TEST(Floating, FallsAsTheIntegratorHasIt)
{
    falls(chosen::leapfrog, 0);
    falls(chosen::runge_kutta2, 0);
    falls(chosen::symplectic_euler, -1);
    falls(chosen::forward_euler, 1);
}
// What the fluid does to the markers is the opposite of what they do to it: to rounding of the sums, force and torque.
template <class S, class... O>
void reacts(S state, O... options)
{
    auto s =
        tank({}, chosen::leapfrog, state, options...,
             obstacle(Sphere<2>{{0.5, 0.25}, 0.11}, Floating<2>{.density = 700, .velocity = {{0.4, -0.3}}, .spin = 5}));
    s.fill(Box<2>{{0, 0}, {1, 0.4}}, dx, hydrostatic);
    s.run({.steps = 20});
    s.refresh();
    auto const& w = s.system().template species<1>().particles;
    At force{};
    double size = 0;
    for (std::size_t i = 0; i < w.size(); ++i) force += w.at(push, i), size += length(w.at(push, i));
    const At wall = s.wall_force();
    EXPECT_GT(size, 100);
    EXPECT_LT(length(force - wall), 1e-12 * size);
    EXPECT_GT(std::abs(body_of(s).torque[0]), 1e-3);
}
TEST(Floating, TakesWhatItGives) // Extrapolated: MovesInSpace
{
    reacts(Adami{});
    reacts(ByContinuity{});
    reacts(Adami{}, no_slip);
}
/// The level of the water with a body afloat, and how deep the body's foot should be under it (Archimedes).
struct Draught {
    double level, depth; ///< [m]
};
Draught archimedes(auto const& s, double width, double breadth)
{
    const double m = body_of(s).mass, water = double(s.particles().size()) * dx * dx;
    return {(water + m / rho0) / width, m / rho0 / breadth};
}
struct Afloat {
    double most = 0, sum = 0, turned = 0; ///< of the depth, off by [m]; of the angle [degrees]
    int rows = 0;
    void begin(auto&) {}
    void end(auto&) {}
    void step(auto& s)
    {
        if (s.time() < from) return;
        auto const& b = body_of(s);
        const Draught d = archimedes(s, 1, 0.32);
        const double off = d.level - (b.place()[1] - 0.08) - d.depth;
        most = std::max(most, std::abs(off)), sum += off, ++rows;
        turned = std::max(turned, std::abs(b.state.attitude.angle) * 180 / std::numbers::pi);
    }
    double from; ///< [s]
};
// A raft of a quarter, of half and of three quarters of the density of water, from the place of equilibrium.
TEST(Floating, DrawsAsMuchWaterAsItWeighs)
{
    for (double density : {250.0, 500.0, 750.0}) {
        auto s = tank({}, chosen::leapfrog, Adami{},
                      obstacle(raft(0.4 - 0.16 * density / rho0), Floating<2>{.density = density}));
        s.fill(Box<2>{{0, 0}, {1, 0.4}}, dx, hydrostatic);
        Afloat seen{.from = 0.25};
        s.run({.until = 0.5}, seen);
        EXPECT_LT(seen.most, dx);
        EXPECT_LT(seen.turned, 0.2);
        std::printf("  density %g: draught off by %.3f dx at most, turned by %.2g degrees\n", density, seen.most / dx,
                    seen.turned);
    }
}
TEST(Floating, StaysWhereItIsNeutral) // for long: tests/models/bodies.cpp
{
    auto s = tank({}, chosen::leapfrog, Adami{}, obstacle(raft(0.1), Floating<2>{.density = rho0}));
    s.fill(Box<2>{{0, 0}, {1, 0.4}}, dx, hydrostatic);
    double most = 0;
    for (int k = 0; k < 50; ++k) {
        s.run({.steps = 20});
        most = std::max(most, length(body_of(s).state.velocity));
    }
    EXPECT_LT(most, 1e-3 * std::sqrt(gravity * 0.16)); // numerics V36
}
// In space, in float, round a periodic axis: a cork rises upright, a stone sinks, and the sums of the forces on all markers
// are what the water feels.
TEST(Floating, MovesInSpace)
{
    constexpr double coarse = 0.05;
    auto ball = [&](double density) {
        auto water =
            wcsph(CubicSpline<3>{.h = 1.2 * coarse}, Tait{.rho0 = rho0, .c0 = 30}, Continuity<2>{}, PressureForce<2>{},
                  ArtificialViscosity{.alpha = 0.1}, LaminarViscosity{.mu = 1}, Gravity<3>{{0, 0, -gravity}});
        const Box<3> box{{0, 0, 0}, {0.6, 0.6, 0.8}};
        Simulation s(water, RungeKutta2{},
                     Bce(box, coarse, Extrapolated{}, open(top), periodic(x_axis),
                         obstacle(Sphere<3>{{0.1, 0.3, 0.3}, 0.15},
                                  Floating<3>{.density = density, .velocity = {{2, 0, 0}}, .spin = {{0, 1, 0}}})),
                     Threads{2}, Float{});
        s.fill(Box<3>{{0, 0, 0}, {0.6, 0.6, 0.6}}, coarse, hydrostatic);
        s.run({.until = 0.05});
        s.refresh();
        auto const& w = s.system().template species<1>().particles;
        Vec<3, double> force{};
        double size = 0;
        for (std::size_t i = 0; i < w.size(); ++i) {
            force += w.at(push, i), size += length(w.at(push, i));
            if (w.at(part, i) == 0) continue;
            const auto off = w.at(position, i) - body_of(s).rigid().position_of(w.at(rest_position, i));
            EXPECT_LT(length(nearest_image(off, s.system().grid())), 1e-6);
        }
        EXPECT_LT(length(force - s.wall_force()), 1e-6 * size); // of float
        return body_of(s).state;
    };
    const auto cork = ball(100), stone = ball(3000);
    EXPECT_GT(cork.velocity[2], 0.1);
    EXPECT_LT(stone.velocity[2], -0.1);
    EXPECT_GT(stone.shift[0], 0.05);                // half of the way without water
    EXPECT_LT(cork.velocity[0], stone.velocity[0]); // water brakes what is light
    EXPECT_LT(std::abs(cork.velocity[1]), 1e-3);    // by symmetry
}

} // namespace
