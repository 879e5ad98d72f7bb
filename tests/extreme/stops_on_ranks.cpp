// SPDX-License-Identifier: BSD-3-Clause
// A stop on three ranks is that of one: its kind, the particle, the step and the facts, on every rank.
#include "extreme/chosen.hpp"
#include "spate/backend/virtual_ranks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace {

using namespace spate;
using Point = Vec<2, double>;

constexpr double m = 0.1, r = 0.01, k = 1e5;
const RunOptions by_criteria{.steps = 100}, short_steps{.steps = 100, .dt = 2e-4};

/// Water at rest in a tank, before its first step.
auto water_in_a_tank(auto backend)
{
    constexpr double dx = 0.02;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 20}, Continuity<2>{}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -9.81}});
    Simulation sim(water, SymplecticEuler{}, Bce(Box<2>{{}, {{0.4, 0.4}}}, dx, ByContinuity{}, open(top)), backend);
    sim.fill(Box<2>{{}, {{0.4, 0.2}}}, dx, hydrostatic);
    return sim;
}
/// f(scene) for the same, which a hand changes after three steps.
void tank(auto backend, auto const& f)
{
    auto sim = water_in_a_tank(backend);
    sim.run({.steps = 3});
    f(sim);
}
/// A grain, of its own size if the scene has such.
void add(auto& sim, Point const& x, double size)
{
    const std::size_t i = sim.add(x);
    auto& p = sim.particles();
    using Grains = std::remove_reference_t<decltype(p)>;
    if constexpr (decltype(Grains::fields)::template contains<Radius>) p.put(mass, i, m), p.put(radius, i, size);
}
/// f(scene) for discs at rest on a wide lattice in a periodic box, before their first step.
void crowd(auto backend, auto const& f)
{
    Simulation sim(dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k}), chosen::AnyIntegrator{},
                   Periodic(Box<2>{{}, {{1, 1}}}), backend);
    for (int i = 0; i < 400; ++i) sim.add({(i % 20 + 0.5) / 20, (i / 20 + 0.5) / 20});
    f(sim);
}
/// hand(sim) and a run, on one rank and on three.
struct End {
    std::string name = "ok", kind = "ok";
    StopFacts facts;
};
template <class F>
End end_of(F const& run)
{
    End end;
    auto caught = [&](Stop const& stop, const char* kind) { end = {stop.name(), kind, stop.facts()}; };
    try {
        run();
    }
    catch (NonFinite const& s) {
        caught(s, "NonFinite");
    }
    catch (OutOfDomain const& s) {
        caught(s, "OutOfDomain");
    }
    catch (EnergyRunaway const& s) {
        caught(s, "EnergyRunaway");
    }
    catch (DtCollapse const& s) {
        caught(s, "DtCollapse");
    }
    catch (SkinOutrun const& s) {
        caught(s, "SkinOutrun");
    }
    catch (IndexOverflow const& s) {
        caught(s, "IndexOverflow");
    }
    catch (EosDomain const& s) {
        caught(s, "EosDomain");
    }
    catch (CoincidentParticles const& s) {
        caught(s, "CoincidentParticles");
    }
    catch (OverlapTooDeep const& s) {
        caught(s, "OverlapTooDeep");
    }
    return end;
}
constexpr auto nothing_more = [](auto&) {};
/// \param after  is called with the scene that has stopped
template <class After = decltype(nothing_more)>
void expect_the_same(std::string const& name, auto const& scene, RunOptions const& o, auto const& hand,
                     After const& after = {})
{
    auto run = [&](auto backend) {
        End end;
        scene(backend, [&](auto& sim) {
            hand(sim);
            end = end_of([&] { sim.run(o); });
            after(sim);
        });
        return end;
    };
    const End one = run(Serial{});
    EXPECT_EQ(one.name, name);
    std::vector<End> all(3);
    VirtualRanks(3).run([&](auto rank) { all[std::size_t(rank.rank())] = run(OnRank{rank, Serial{}, 2, Balance{}}); });
    for (End const& end : all) {
        EXPECT_EQ(end.name, one.name);
        EXPECT_EQ(end.kind, one.kind) << name; // who catches the type catches it on ranks too
        StopFacts const &a = end.facts, &b = one.facts;
        EXPECT_EQ(a.step, b.step) << name;
        EXPECT_EQ(a.time, b.time) << name;
        EXPECT_EQ(a.particle, b.particle) << name;
        EXPECT_EQ(a.species, b.species) << name;
        EXPECT_EQ(a.other, b.other) << name;
        EXPECT_EQ(a.quantity, b.quantity) << name;
        EXPECT_TRUE(a.value == b.value || (std::isnan(a.value) && std::isnan(b.value))) << name;
        EXPECT_EQ(a.limit, b.limit) << name;
        for (int c = 0; c < 2; ++c) {
            EXPECT_EQ(a.position[c], b.position[c]) << name;
            EXPECT_TRUE(a.velocity[c] == b.velocity[c] || (std::isnan(a.velocity[c]) && std::isnan(b.velocity[c])))
                << name;
        }
    }
}
constexpr auto a_tank = [](auto backend, auto const& f) { tank(backend, f); };
constexpr auto a_crowd = [](auto backend, auto const& f) { crowd(backend, f); };

/// Who has the particle changes it.
void of(auto& sim, std::uint32_t id, auto const& change)
{
    auto& p = sim.particles();
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p.id()[i] == id) change(p, i);
}
TEST(StopsOnRanks, OfWaterAreThoseOfOne)
{
    expect_the_same("NonFinite", a_tank, by_criteria, [](auto& sim) {
        for (std::uint32_t id : {150u, 15u, 21u})
            of(sim, id,
               [](auto& p, std::size_t i) { p.column(velocity)[0][i] = std::numeric_limits<double>::quiet_NaN(); });
    });
    for (double rho : {-1.0, 3001.0})
        expect_the_same("EosDomain", a_tank, by_criteria, [rho](auto& sim) {
            for (std::uint32_t id : {190u, 13u}) of(sim, id, [rho](auto& p, std::size_t i) { p.put(density, i, rho); });
        });
    expect_the_same("OutOfDomain", a_tank, short_steps, [](auto& sim) {
        of(sim, 57, [](auto& p, std::size_t i) { p.put(velocity, i, {2000, 0}); });
    });
    expect_the_same("DtCollapse", a_tank, by_criteria, [](auto& sim) {
        of(sim, 10, [](auto& p, std::size_t i) { p.put(velocity, i, {0, 5e4}); });
    });
}
TEST(StopsOnRanks, OfGrainsAreThoseOfOne)
{
    chosen::integrator = chosen::forward_euler;
    expect_the_same("CoincidentParticles", a_crowd, by_criteria, [](auto& sim) {
        sim.add({17.5 / 20, 6.5 / 20});
        sim.add({2.5 / 20, 6.5 / 20});
    });
    expect_the_same("EnergyRunaway", a_crowd, {.steps = 400, .dt = 5e-4}, [](auto& sim) {
        sim.add({0.05, 0.05}, {1, 0});
        sim.add({0.08, 0.05}, {-1, 0});
    });
    expect_the_same("OverlapTooDeep", a_crowd, by_criteria, [](auto& sim) {
        sim.add({0.05, 0.05});
        sim.add({0.05 + 1.5 * r, 0.05});
    });
    chosen::integrator = chosen::leapfrog;
    for (double way : {0.7, 0.9}) // of each, far apart, in a step, over the radius
        expect_the_same("SkinOutrun", a_crowd, {.steps = 3, .dt = 1e-4}, [way](auto& sim) {
            sim.add({0.1, 0.5}, {way * r / 1e-4, 0});
            sim.add({0.9, 0.5}, {-way * r / 1e-4, 0});
        });
}
/// f(scene) for grains of two sizes on a wide lattice.
void sizes(auto backend, auto const& f)
{
    Simulation sim(dem<2>(Mixture{.largest = r}, LinearSpring{.k = k}), ForwardEuler{}, Periodic(Box<2>{{}, {{1, 1}}}),
                   backend);
    for (int i = 0; i < 400; ++i) add(sim, {(i % 20 + 0.5) / 20, (i / 20 + 0.5) / 20}, i % 3 == 0 ? 0.5 * r : r);
    f(sim);
}
/// Two more grains, one in the other by 0.4 of the radius of the smaller, at each of many places along a line through the box;
/// and two that are less deep. The line crosses borders between ranks, and the face where the box goes on.
void expect_the_deepest_pair(auto const& scene, double small)
{
    int across = 0; // pairs of which two ranks have one each
    for (int at = 0; at < 80; ++at) {
        const double x = 0.0125 * at, y = std::fmod(x + r + 0.6 * small, 1.0);
        const bool small_first = at % 2 == 0; // has the lower id
        int owner[2] = {-1, -1};
        auto hand = [&](auto& sim) {
            add(sim, {small_first ? x : y, 0.5}, small_first ? small : r);
            add(sim, {small_first ? y : x, 0.5}, small_first ? r : small);
            add(sim, {std::fmod(x + 0.4, 1.0), 0.5}, r);
            add(sim, {std::fmod(x + 0.4 + 1.7 * r, 1.0), 0.5}, r);
        };
        expect_the_same("OverlapTooDeep", scene, by_criteria, hand, [&](auto& sim) {
            for (std::uint32_t id : {400u, 401u})
                of(sim, id, [&](auto&, std::size_t) { owner[id - 400] = sim.system().ranks().rank(); });
        });
        across += owner[0] != owner[1];
    }
    EXPECT_GE(across, 2); // the line goes through the shares of more than one
}
TEST(StopsOnRanks, OfThePairThatIsDeepestAreThoseOfOne)
{
    chosen::integrator = chosen::forward_euler;
    expect_the_deepest_pair(a_crowd, r);
    expect_the_deepest_pair([](auto backend, auto const& f) { sizes(backend, f); }, 0.5 * r);
}
// Of smoothed particles it is a warning, which all ranks give.
TEST(StopsOnRanks, AreWarningsOfWaterOfWhichTwoAreAtOnePlace)
{
    auto told = [](auto backend) {
        auto sim = water_in_a_tank(backend);
        sim.add({0.05, 0.11});
        sim.run({.steps = 1});
        return sim.report().warnings;
    };
    const auto one = told(Serial{});
    EXPECT_EQ(std::count_if(one.begin(), one.end(), [](auto& w) { return w.find("at one place") != w.npos; }), 1);
    VirtualRanks(3).run([&](auto rank) { EXPECT_EQ(told(OnRank{rank, Serial{}, 2, Balance{}}), one); });
}

} // namespace
