// SPDX-License-Identifier: BSD-3-Clause
#include "spate/boundary/outlet.hpp"

#include "spate/spate.hpp"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace spate;
using testing::HasSubstr;

constexpr double r = 0.01, k = 1e5, m = 0.1, g = 9.81;

/// Grains under gravity in a box that is open all around.
auto grains()
{
    return Simulation(dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k}, Gravity<2>{{0, -g}}), Leapfrog{}, Open{},
                      Serial{}, Double{}, Watch{.overlap = 2});
}
double close_to(double value) { return 1e-14 * std::abs(value); }

TEST(Outlet, TakesThoseWhoseCentreIsInItsRegion)
{
    auto sim = grains();
    for (double x : {0.0, 0.5, 0.999, 1.0, 1.001, 2.0}) sim.add({x, 0});
    Outlet out(beyond(Box<2>{{0, 0}, {1, 1}}, right), {.every = 1});
    sim.run({.steps = 1, .dt = 1e-5}, out);
    EXPECT_EQ(out.particles(), 2);
    EXPECT_NEAR(out.mass(), 2 * m, close_to(2 * m));
    std::set<std::uint32_t> left(sim.particles().id().begin(), sim.particles().id().end());
    EXPECT_EQ(left, (std::set<std::uint32_t>{0, 1, 2, 3}));
}
TEST(Outlet, FacesAreWhereTheirNamesSay)
{
    const Box<3> box{{1, 2, 3}, {4, 5, 6}};
    const Vec<3, double> inside{2, 3, 4};
    auto out = [&](Face f, int axis, double x) {
        auto at = inside;
        at[axis] = x;
        EXPECT_GT(beyond(box, f).distance(inside), 0);
        return -beyond(box, f).distance(at);
    };
    EXPECT_DOUBLE_EQ(out(left, 0, 0.75), 0.25);
    EXPECT_DOUBLE_EQ(out(right, 0, 4.25), 0.25);
    EXPECT_DOUBLE_EQ(out(front, 1, 1.75), 0.25);
    EXPECT_DOUBLE_EQ(out(back, 1, 5.25), 0.25);
    EXPECT_DOUBLE_EQ(out(bottom, 2, 2.75), 0.25);
    EXPECT_DOUBLE_EQ(out(top, 2, 6.25), 0.25);
}
TEST(Outlet, LooksAtEachSoManiethStep)
{
    auto sim = grains();
    sim.add({0, 0});
    sim.add({0.9, 0}, {1, 0});
    Outlet out(beyond(Box<2>{{0, 0}, {1, 1}}, right), {.every = 7});
    for (int n = 1; n <= 200; ++n) {
        const double x = n > 1 ? sim.particles().at(position, sim.particles().size() - 1)[0] : 0;
        const bool goes = (n - 1) % 7 == 0 && x > 1;
        const auto before = sim.particles().size();
        sim.run({.steps = 1, .dt = 1e-3}, out);
        ASSERT_EQ(sim.particles().size(), before - goes) << n;
    }
    EXPECT_EQ(out.particles(), 1);
}
TEST(Outlet, TheSceneCountsWhatIsTakenAlong)
{
    auto sim = grains();
    const double x[] = {0, 0.4, 1.2, 1.5}, y[] = {0, 1, 2, -3};
    for (int n = 0; n < 4; ++n) sim.add({x[n], y[n]}, {n - 1.0, 0.5 * n});
    const double gone = sim.remove([](auto const& p, std::size_t i) { return p.at(position, i)[0] > 1; }).mass;
    EXPECT_NEAR(gone, 2 * m, close_to(2 * m));
    auto const& left = sim.exchanged().left;
    EXPECT_EQ(left.particles, 2);
    EXPECT_NEAR(left.momentum[0], m * (1 + 2), close_to(m));
    EXPECT_NEAR(left.momentum[1], m * (1 + 1.5), close_to(m));
    const double kinetic = 0.5 * m * (1 + 1 + 4 + 2.25), potential = m * g * (2 - 3);
    EXPECT_NEAR(left.energy, kinetic + potential, 4 * close_to(kinetic));
    EXPECT_FALSE(sim.exchanged().entered.particles);
}
// A contact is lost with either of its grains, and once.
TEST(Outlet, AContactGoesWithItsGrain)
{
    const double overlap = 0.1 * r, elastic = 0.5 * k * overlap * overlap, pitch = 2 * r - overlap;
    for (int leaving : {1, 2, 3, 4}) {
        Simulation sim(dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k}), Leapfrog{},
                       Periodic(Box<2>{{0, 0}, {8 * pitch, 1}}), Threads{2});
        for (int n = 0; n < 4; ++n) sim.add({(n + 0.1) * pitch, 0.5}); // three contacts in a row
        sim.make_lists_current();
        EXPECT_NEAR(sim.energy().internal, 3 * elastic, 1e-9 * elastic);
        sim.remove([&](auto const& p, std::size_t i) { return p.id()[i] < std::uint32_t(leaving); });
        EXPECT_NEAR(sim.exchanged().left.energy, std::min(leaving, 3) * elastic, 1e-9 * elastic) << leaving;
        sim.make_lists_current();
        EXPECT_NEAR(sim.energy().internal + sim.exchanged().left.energy, 3 * elastic, 1e-9 * elastic) << leaving;
    }
}
TEST(Outlet, AContactAcrossAPeriodicFaceGoesToo)
{
    const double overlap = 0.1 * r, elastic = 0.5 * k * overlap * overlap, pitch = 2 * r - overlap;
    Simulation sim(dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k}), Leapfrog{},
                   Periodic(Box<2>{{0, 0}, {8 * pitch, 1}}), Threads{2});
    sim.add({0.1 * pitch, 0.5});
    sim.add({7.1 * pitch, 0.5});
    sim.remove([](auto const& p, std::size_t i) { return p.id()[i] == 1; });
    EXPECT_NEAR(sim.exchanged().left.energy, elastic, 1e-9 * elastic);
}
// Three grains on a line, the middle one at rest: what their contacts lost stays lost when they go, to rounding.
TEST(Outlet, WhatWasLostInContactsStaysCounted)
{
    Simulation sim(dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k}, Dashpot{.e = 0.5}, Dissipation{}), Leapfrog{},
                   Open{}, Serial{});
    for (int n : {-1, 0, 1}) sim.add({2.1 * r * n, 0}, {-1.0 * n, 0});
    sim.run({.steps = 1000, .dt = 1e-5});
    const double lost = sim.energy().dissipated;
    EXPECT_GT(lost, 0.1 * m);
    for (std::uint32_t id : {0u, 1u, 2u}) {
        sim.remove([&](auto const& p, std::size_t i) { return p.id()[i] == id; });
        EXPECT_THROW((void)sim.energy(), std::logic_error); // lists are of those that were there before
        sim.make_lists_current();
        EXPECT_NEAR(sim.energy().dissipated, lost, 1e-15) << id;
    }
    EXPECT_TRUE(sim.particles().empty());
}
TEST(Outlet, IdsAreNeverGivenAgain)
{
    auto sim = grains();
    for (int n = 0; n < 3; ++n) sim.add({0.1 * n, 0});
    sim.remove([](auto const& p, std::size_t i) { return p.id()[i] == 2; }); // the largest
    auto more = sim.newcomers();
    sim.append(more, {0.7, 0});
    sim.append(more, {0.8, 0});
    sim.enter(more);
    EXPECT_EQ(sim.particles().id(), (std::vector<std::uint32_t>{0, 1, 3, 4}));
    sim.remove([](auto const&, std::size_t) { return true; });
    EXPECT_TRUE(sim.particles().empty());
    EXPECT_EQ(sim.particles().id().size(), 0u);
    sim.run({.steps = 3, .dt = 1e-4}); // an empty scene runs
    sim.add({0, 0});
    EXPECT_EQ(sim.particles().id(), std::vector<std::uint32_t>{5});
}
TEST(Outlet, APeriodicFaceIsNoWayOut)
{
    Simulation sim(dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k}), Leapfrog{}, Periodic(Box<2>{{0, 0}, {1, 1}}),
                   Threads{2});
    sim.add({0.5, 0.5}, {1, 0}); // alone: no step builds lists, nobody wraps it
    Outlet beyond_all(beyond(Box<2>{{0, 0}, {1, 1}}, right), {.every = 1});
    sim.run({.steps = 1000, .dt = 1e-3}, beyond_all);
    EXPECT_GT(sim.particles().at(position, 0)[0], 1);
    EXPECT_EQ(beyond_all.particles(), 0);
    Outlet strip(Box<2>{{0.4, 0}, {0.6, 1}}, {.every = 1});
    sim.run({.steps = 1, .dt = 1e-3}, strip);
    EXPECT_EQ(strip.particles(), 1);
}
TEST(Outlet, RefusesWhatItCannotDo)
{
    auto sim = grains();
    sim.add({0, 0});
    auto refusal = [&](auto out) -> std::string {
        try {
            sim.run({.steps = 1, .dt = 1e-4}, out);
        }
        catch (BadInput const& e) {
            return e.what();
        }
        return "";
    };
    const HalfSpace<2> half{{1, 0}, {-1, 0}};
    EXPECT_THAT(refusal(Outlet(half, {.every = 0})), HasSubstr("OutletOptions.every is 0; allowed is 1 or above"));
    EXPECT_THAT(refusal(Outlet(HalfSpace<2>{{1, 0}, {0, 0}})), HasSubstr("HalfSpace.normal length is 0"));
}
// Water runs out of a tank without its right wall: what was there is there, or has left. Far below the level of no potential
// energy the rest would seem to gain a lot.
TEST(Outlet, WaterThatRunsOutIsCounted)
{
    constexpr double dx = 0.02, height = 0.2, floor = -10;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 10 * std::sqrt(2 * g * height)},
                       Continuity<2>{}, PressureForce<2>{}, ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -g}});
    Simulation tank(water, RungeKutta2{}, Bce(Box<2>{{0, floor}, {0.3, floor + 0.4}}, dx, Adami{}, open(top, right)),
                    Serial{});
    tank.fill(Box<2>{{0, floor}, {0.3, floor + height}}, dx, hydrostatic);
    const double mass = tank.total_mass();
    const auto start = tank.particles().size();
    Outlet out(beyond(Box<2>{{0, floor}, {0.3, floor + 0.4}}, right));
    tank.run({.until = 0.4, .cfl = 0.2}, out);
    EXPECT_GT(out.particles(), std::int64_t(start / 2)); // most of it has run out
    EXPECT_GT(tank.particles().size(), 0u);
    EXPECT_EQ(tank.particles().size() + std::size_t(out.particles()), start);
    EXPECT_NEAR(tank.total_mass() + out.mass(), mass, 1e-12 * mass);
    EXPECT_GT(tank.exchanged().left.momentum[0], 0);
    EXPECT_LT(tank.exchanged().left.energy, 0);
    EXPECT_LT(tank.report().energy_rise, 0.01);
}

} // namespace
