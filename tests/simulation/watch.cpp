// SPDX-License-Identifier: BSD-3-Clause
// A run that goes wrong ends in a typed stop that names the particle, the step, the time and the quantity.
#include "spate/spate.hpp"

#include <functional>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace spate;
using testing::Contains;
using testing::HasSubstr;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Water at rest, 0.2 m deep, in a tank of 0.4 m.
auto tank()
{
    constexpr double dx = 0.02, g = 9.81;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 20}, Continuity<2>{}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -g}});
    Bce walls(Box<2>{{}, {{0.4, 0.4}}}, dx, ByContinuity{}, open(top));
    Simulation sim(water, SymplecticEuler{}, walls, Serial{});
    sim.fill(Box<2>{{}, {{0.4, 0.2}}}, dx, hydrostatic);
    return sim;
}
/// Two discs about to meet at 2 m/s in a box of 1 m.
template <class I, class W = Watch>
auto collision(I integrator, W watch = {})
{
    Simulation sim(dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}), integrator,
                   Periodic(Box<2>{{}, {{1, 1}}}), Serial{}, Double{}, watch);
    sim.add({{0.48, 0.5}}, {{1, 0}});
    sim.add({{0.51, 0.5}}, {{-1, 0}});
    return sim;
}
/// The place of the particle with this id.
std::size_t place_of(auto const& sim, std::uint32_t id)
{
    auto const& all = sim.particles().id();
    return std::size_t(std::find(all.begin(), all.end(), id) - all.begin());
}
template <class S>
void expect_stop(std::string const& name, auto const& run, std::function<void(Stop const&)> const& then)
{
    try {
        run();
    }
    catch (S const& stop) {
        EXPECT_EQ(stop.name(), name);
        EXPECT_THAT(stop.what(), HasSubstr("spate: stopped, " + name + " at step "));
        then(stop);
        return;
    }
    ADD_FAILURE() << "no " << name;
}
/// Hears how a run went.
struct Ear {
    int begun = 0, steps = 0, ended = 0;
    void begin(auto&) { ++begun; }
    void step(auto&) { ++steps; }
    void end(auto&) { ++ended; }
};

/// Puts NaN into a particle after a step.
struct Poison {
    void begin(auto&) {}
    void step(auto& s)
    {
        if (s.steps() == 4) s.particles().column(velocity)[0][1] = nan_value;
    }
    void end(auto&) {}
};

TEST(Watch, NamesTheParticleThatIsNotFinite)
{
    for (double bad : {nan_value, infinite, -infinite})
        for (std::string field : {"position", "velocity", "density"}) {
            auto sim = tank();
            sim.run({.steps = 3});
            auto& p = sim.particles();
            ASSERT_LT(place_of(sim, 21), place_of(sim, 15));
            for (std::uint32_t id : {21u, 15u}) {
                const std::size_t i = place_of(sim, id);
                if (field == "position") p.column(position)[1][i] = bad;
                if (field == "velocity") p.column(velocity)[0][i] = bad;
                if (field == "density") p.column(density)[0][i] = bad;
            }
            Ear ear;
            expect_stop<NonFinite>(
                "NonFinite", [&] { sim.run({.steps = 5}, ear); },
                [&](Stop const& stop) {
                    EXPECT_EQ(stop.facts().particle, 15); // the least id, whichever is stored first
                    EXPECT_EQ(stop.facts().species, 0);
                    EXPECT_EQ(stop.facts().step, 3);
                    EXPECT_EQ(stop.facts().time, sim.time());
                    EXPECT_EQ(stop.facts().quantity, field) << bad;
                    EXPECT_THAT(stop.what(), HasSubstr("particle 15 of species 0 at ("));
                    EXPECT_THAT(stop.what(), HasSubstr(field + " is "));
                });
            EXPECT_EQ(ear.begun, 1);
            EXPECT_EQ(ear.steps, 0);
            EXPECT_EQ(ear.ended, 1); // the state found is still written
        }
}
TEST(Watch, SeesTheLastParticleOfAPack)
{
    for (std::uint32_t id : {0u, 199u}) {
        auto sim = tank();
        ASSERT_EQ(sim.particles().size(), 200u);
        sim.run({.steps = 1});
        sim.particles().column(velocity)[1][place_of(sim, id)] = nan_value;
        expect_stop<NonFinite>(
            "NonFinite", [&] { sim.run({.steps = 1}); },
            [&](Stop const& stop) { EXPECT_EQ(stop.facts().particle, id); });
    }
}
// NaN made in the last step of a run is seen too.
TEST(Watch, LooksOnceMoreAtTheEnd)
{
    auto sim = collision(SymplecticEuler{});
    expect_stop<NonFinite>(
        "NonFinite", [&] { sim.run({.steps = 4, .dt = 1e-4}, Poison{}); },
        [&](Stop const& stop) { EXPECT_EQ(stop.facts().step, 4); });
}
TEST(Watch, NamesTheParticleThatWentThroughAWall)
{
    auto sim = tank();
    sim.run({.steps = 3});
    const std::size_t i = place_of(sim, 57);
    sim.particles().put(velocity, i, {{2000, 0}});
    expect_stop<OutOfDomain>(
        "OutOfDomain", [&] { sim.run({.steps = 100, .dt = 2e-4}); },
        [](Stop const& stop) {
            EXPECT_EQ(stop.facts().particle, 57);
            EXPECT_GE(stop.facts().step, 4);
            EXPECT_LE(stop.facts().step, 5);
            EXPECT_GT(stop.facts().position[0], 0.4 + 0.06);
            EXPECT_EQ(stop.facts().limit, 0.06); // three layers of markers
            EXPECT_NEAR(stop.facts().value, stop.facts().position[0] - 0.4, 1e-15);
        });
}
// Forward Euler triples the energy of a spring contact in each step of the seed's 1 ms (numbers: contact.cpp).
TEST(Watch, StopsASchemeThatCreatesEnergy)
{
    auto sim = collision(ForwardEuler{});
    expect_stop<EnergyRunaway>(
        "EnergyRunaway", [&] { sim.run({.steps = 30, .dt = 1e-3}); },
        [](Stop const& stop) {
            EXPECT_LE(stop.facts().step, 30);
            EXPECT_GT(stop.facts().value, 0.05);
            EXPECT_EQ(stop.facts().limit, 0.05);
            EXPECT_EQ(stop.facts().particle, -1);
        });
    EXPECT_GT(sim.report().energy_rise, 0.05);
    EXPECT_THAT(sim.report().warnings, Contains(HasSubstr("total energy has risen by ")));
}
TEST(Watch, LetsASchemeThatKeepsEnergyRun)
{
    auto sim = collision(Leapfrog{}, Watch{.energy_every = 1, .calm = 1});
    sim.run({.steps = 1000, .dt = 1e-4}); // energy swings by (omega dt)^2 / 4 = 0.5 % in a contact
    EXPECT_LT(sim.particles().at(velocity, place_of(sim, 0))[0], -0.9); // they did collide
    EXPECT_LT(sim.report().energy_rise, 0.01);
    EXPECT_TRUE(sim.report().warnings.empty());
}
TEST(Watch, ItsLimitsAreTheUsers)
{
    auto sim = collision(ForwardEuler{}, Watch{.energy_every = 1, .warn = 10, .stop = 1e9});
    sim.run({.steps = 30, .dt = 1e-3});
    EXPECT_GT(sim.report().energy_rise, 10);
    EXPECT_THAT(sim.report().warnings, Contains(HasSubstr("total energy has risen by ")).Times(1)); // told once
}
/// The steps at which the energy of two discs, one of which a hand makes faster at every step from one on, is seen to have
/// risen.
std::vector<std::int64_t> rises_seen(double faster, Watch watch, std::int64_t from = 100)
{
    auto sim = collision(Leapfrog{}, watch);
    for (std::uint32_t id : {0u, 1u}) sim.particles().put(velocity, place_of(sim, id), {{0, 1}}); // they never meet
    std::vector<std::int64_t> steps;
    double seen = 0;
    while (sim.steps() < 400) {
        sim.step({.dt = 1e-5});
        if (sim.report().energy_rise > seen) seen = sim.report().energy_rise, steps.push_back(sim.steps() - 1);
        if (sim.steps() < from) continue;
        const std::size_t i = place_of(sim, 0);
        sim.particles().put(velocity, i, faster * sim.particles().at(velocity, i));
    }
    return steps;
}
TEST(Watch, LooksSeldomAtACalmEnergyAndOftenAtARisingOne)
{
    auto each = [](std::int64_t from, std::int64_t every, std::int64_t to) {
        std::vector<std::int64_t> steps;
        for (; from <= to; from += every) steps.push_back(from);
        return steps;
    };
    // 0.03 % in 300 steps, 0.04 % in 400: half of `warn` is not reached. Until it looks as seldom as it ever does, times double.
    using testing::ElementsAre;
    EXPECT_THAT(rises_seen(1 + 1e-6, {.energy_every = 5, .calm = 32}), ElementsAre(160, 320));
    EXPECT_THAT(rises_seen(1 + 1e-6, {.energy_every = 5, .calm = 32}, 0), ElementsAre(5, 10, 20, 40, 80, 160, 320));
    EXPECT_THAT(rises_seen(1 + 1e-6, {.energy_every = 5, .calm = 12}, 0),
                ElementsAre(5, 10, 20, 40, 60, 120, 180, 240, 300, 360));
    // 0.6 % in the 60 steps until 160, the next look after 80: from there on it is looked at every ten steps.
    EXPECT_EQ(rises_seen(1 + 1e-4, {.energy_every = 10, .calm = 8}), each(160, 10, 390));
    EXPECT_EQ(rises_seen(1 + 1e-4, {.energy_every = 10, .calm = 1}), each(100, 10, 390));
}
TEST(Watch, AForceAlongAPeriodicAxisIsASource)
{
    const Box<2> box{{}, {{1, 1}}};
    Simulation sim(dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}, Gravity<2>{{9.81, 0}}),
                   SymplecticEuler{}, Periodic(box), Serial{});
    sim.add({{0.5, 0.5}}, {{1, 0}});
    sim.run({.steps = 1000, .dt = 1e-3});
    EXPECT_NEAR(sim.particles().at(velocity, 0)[0], 1 + 9.81, 1e-9);
}
TEST(Watch, StopsWhenTheStepCollapses)
{
    auto sim = tank();
    sim.run({.steps = 3});
    sim.particles().put(velocity, place_of(sim, 10), {{0, 5e4}}); // c0 + |v| is 2500 c0
    expect_stop<DtCollapse>(
        "DtCollapse", [&] { sim.run({.steps = 3}); },
        [](Stop const& stop) {
            EXPECT_EQ(stop.facts().step, 3);
            EXPECT_LT(stop.facts().value, stop.facts().limit);
            EXPECT_THAT(stop.what(), HasSubstr("dt [s] is "));
        });
}
TEST(Watch, StopsBeforeATimeThatIsNoNumber)
{
    auto sim = collision(SymplecticEuler{});
    for (std::uint32_t id : {0u, 1u}) sim.particles().put(velocity, place_of(sim, id), {{0, 0}});
    expect_stop<NonFinite>(
        "NonFinite", [&] { sim.run({.steps = 3, .dt = 1.7e308}); },
        [](Stop const& stop) {
            EXPECT_EQ(stop.facts().step, 1);
            EXPECT_EQ(stop.facts().particle, -1);
            EXPECT_THAT(stop.what(), HasSubstr("the time of the next step [s] is inf"));
        });
}
/// A contact that has no stiffness, so that none begins too deep.
struct Faint {
    static constexpr Fields adds{acceleration};
    void operator()(auto& i, auto const&, auto const& ij) const { i[acceleration] += ij.overlap * ij.n; }
};
TEST(Watch, StopsAParticleThatIsBeyondAllCells)
{
    Simulation sim(dem<2>({.mass = 0.1, .radius = 0.01}, Faint{}), SymplecticEuler{}, Open{}, Serial{});
    sim.add({{0, 0}}, {{1, 0}});
    sim.add({{1, 0}}, {{1e9, 0}});
    expect_stop<IndexOverflow>(
        "IndexOverflow", [&] { sim.run({.steps = 100, .dt = 1e-3}); },
        [](Stop const& stop) {
            EXPECT_EQ(stop.facts().particle, 1);
            EXPECT_EQ(stop.facts().species, 0);
            EXPECT_EQ(stop.facts().step, 1);
            EXPECT_NEAR(stop.facts().position[0], 1e6, 10);
            EXPECT_EQ(stop.facts().velocity[0], 1e9);
        });
}
TEST(NoWatch, LooksAtNothing)
{
    auto sim = collision(ForwardEuler{}, NoWatch{});
    sim.run({.steps = 30, .dt = 1e-3});
    EXPECT_EQ(sim.report().energy_rise, 0);
    EXPECT_GT(std::abs(sim.particles().at(velocity, place_of(sim, 0))[0]), 3);
}

} // namespace
