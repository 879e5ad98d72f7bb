// SPDX-License-Identifier: BSD-3-Clause
// A parameter out of range ends a scene before step 0, in one sentence that names it, its value and what is allowed.
#include "spate/spate.hpp"

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace spate;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Every number of a tank of water; the defaults are a good scene.
struct Tank {
    double h = 0.024, rho0 = 1000, c0 = 20, delta = 0.1, alpha = 0.1, mu = 1e-3, laminar_eps = 0.01;
    Vec<2, double> g{{0, -9.81}};
    double spacing = 0.02;
    Box<2> walls{{}, {{0.4, 0.4}}};
    Box<2> water{{}, {{0.2, 0.2}}};
    double fill_spacing = 0.02;
    Threads backend{1};
    Neighbours neighbours{};
    Watch watch{};
    Vec<2, double> x{{0.3, 0.3}}, v{};
    double density = 1000;
    RunOptions run{.steps = 1};
};
void run(Tank const& t)
{
    auto water =
        wcsph(CubicSpline<2>{t.h}, Tait{t.rho0, t.c0}, Continuity<2>{}, DensityDiffusion{t.delta}, PressureForce<2>{},
              ArtificialViscosity{.alpha = t.alpha}, LaminarViscosity{t.mu, t.laminar_eps}, Gravity<2>{t.g});
    Bce walls(t.walls, t.spacing, Adami{}, open(top));
    Simulation sim(water, SymplecticEuler{}, walls, t.backend, Double{}, t.watch, t.neighbours);
    sim.fill(t.water, t.fill_spacing);
    const std::size_t i = sim.add(t.x, t.v);
    sim.particles().put(density, i, t.density);
    try {
        sim.run(t.run);
    }
    catch (BadInput const&) {
        EXPECT_EQ(sim.steps(), 0);
        throw;
    }
}
/// Grains in a periodic box.
struct Grains {
    double mass = 0.1, radius = 0.01, k = 1e5;
    Box<2> box{{}, {{1, 1}}};
    RunOptions run{.steps = 1};
};
void run(Grains const& s)
{
    Simulation sim(dem<2>({.mass = s.mass, .radius = s.radius}, LinearSpring{s.k}), SymplecticEuler{}, Periodic(s.box),
                   Serial{});
    sim.add({{0.5, 0.5}});
    sim.run(s.run);
}

struct Case {
    std::string parameter, value, allowed; // as the sentence has them; `allowed` is how that part begins
    std::function<void()> scene;
};
Case tank(std::string parameter, std::string value, std::string allowed, std::function<void(Tank&)> const& change)
{
    Tank t;
    change(t);
    return {parameter, value, allowed, [t] { run(t); }};
}
Case grains(std::string parameter, std::string value, std::string allowed, std::function<void(Grains&)> const& change)
{
    Grains s;
    change(s);
    return {parameter, value, allowed, [s] { run(s); }};
}

void expect_sentences(std::vector<Case> const& cases)
{
    for (auto const& c : cases) {
        const std::string sentence = "spate: " + c.parameter + " is " + c.value + "; allowed is " + c.allowed;
        try {
            c.scene();
            ADD_FAILURE() << "ran, but should have said: " << sentence;
        }
        catch (BadInput const& e) {
            EXPECT_THAT(e.what(), testing::StartsWith(sentence));
            EXPECT_THAT(e.what(), testing::Not(testing::HasSubstr("\n")));
        }
        catch (std::exception const& e) {
            ADD_FAILURE() << "said: " << e.what() << "\nshould have said: " << sentence;
        }
    }
}

const std::string positive = "a finite number above 0 [", not_negative = "a finite number, 0 or above [";

TEST(BadInput, TheGoodScenesRun)
{
    EXPECT_NO_THROW(run(Tank{}));
    EXPECT_NO_THROW(run(Grains{}));
}
TEST(BadInput, OfTheKernelAndTheEquationOfState)
{
    std::vector<Case> cases;
    for (auto [x, text] : {std::pair{0.0, "0"}, {-0.02, "-0.02"}, {nan_value, "nan"}, {infinite, "inf"}}) {
        cases.push_back(tank("kernel.h", text, positive + "m]", [x = x](Tank& t) { t.h = x; }));
        cases.push_back(tank("Tait.rho0", text, positive + "kg/m^3]", [x = x](Tank& t) { t.rho0 = x; }));
        cases.push_back(tank("Tait.c0", text, positive + "m/s]", [x = x](Tank& t) { t.c0 = x; }));
    }
    expect_sentences(cases);
}
TEST(BadInput, OfTheTerms)
{
    std::vector<Case> cases;
    for (auto [x, text] : {std::pair{-0.1, "-0.1"}, {nan_value, "nan"}, {infinite, "inf"}}) {
        cases.push_back(tank("DensityDiffusion.delta", text, not_negative, [x = x](Tank& t) { t.delta = x; }));
        cases.push_back(tank("ArtificialViscosity.alpha", text, not_negative, [x = x](Tank& t) { t.alpha = x; }));
        cases.push_back(tank("LaminarViscosity.mu", text, not_negative + "Pa s]", [x = x](Tank& t) { t.mu = x; }));
        cases.push_back(tank("LaminarViscosity.eps", text, not_negative, [x = x](Tank& t) { t.laminar_eps = x; }));
        cases.push_back(grains("LinearSpring.k", text, positive + "N/m]", [x = x](Grains& s) { s.k = x; }));
    }
    cases.push_back(tank("Gravity.g[1]", "nan", "a finite number [m/s^2]", [](Tank& t) { t.g[1] = nan_value; }));
    cases.push_back(tank("Gravity.g[0]", "inf", "a finite number [m/s^2]", [](Tank& t) { t.g[0] = infinite; }));
    for (auto [x, text] : {std::pair{0.0, "0"}, {-0.1, "-0.1"}, {nan_value, "nan"}, {infinite, "inf"}}) {
        cases.push_back(grains("Grain.mass", text, positive + "kg]", [x = x](Grains& s) { s.mass = x; }));
        cases.push_back(grains("Grain.radius", text, positive + "m]", [x = x](Grains& s) { s.radius = x; }));
    }
    expect_sentences(cases);
}
TEST(BadInput, OfTheWalls)
{
    std::vector<Case> cases;
    for (auto [x, text] : {std::pair{0.0, "0"}, {-0.4, "-0.4"}, {nan_value, "nan"}, {infinite, "inf"}}) {
        cases.push_back(
            tank("Bce.box length along axis 1", text, positive + "m]", [x = x](Tank& t) { t.walls.hi[1] = x; }));
        cases.push_back(tank("Bce.spacing", text, positive + "m]", [x = x](Tank& t) { t.spacing = x; }));
    }
    cases.push_back(tank("Bce.spacing", "0.9", "at most the box length 0.4 m", [](Tank& t) { t.spacing = 0.9; }));
    cases.push_back(tank("Bce.spacing", "0.5", "at most the box length 0.4 m", [](Tank& t) { t.spacing = 0.5; }));
    cases.push_back(
        tank("Bce.box length along axis 0", "0.41", "a whole number of spacings; the nearest is 0.42 m", [](Tank& t) {
            t.walls.hi[0] = 0.41000001, t.walls.hi[0] = 0.41;
            t.spacing = 0.021;
        }));
    expect_sentences(cases);
}
TEST(BadInput, OfAFill)
{
    std::vector<Case> cases;
    for (auto [x, text] : {std::pair{0.0, "0"}, {-0.2, "-0.2"}, {nan_value, "nan"}, {infinite, "inf"}}) {
        cases.push_back(
            tank("box length along axis 0", text, positive + "m]", [x = x](Tank& t) { t.water.hi[0] = x; }));
        cases.push_back(tank("spacing", text, positive + "m]", [x = x](Tank& t) { t.fill_spacing = x; }));
    }
    cases.push_back(tank("spacing", "0.5", "at most the box length 0.2 m", [](Tank& t) { t.fill_spacing = 0.5; }));
    cases.push_back(tank("spacing", "0.3", "at most the box length 0.2 m", [](Tank& t) { t.fill_spacing = 0.3; }));
    cases.push_back(tank("spacing", "1e-10", "at least a billionth of", [](Tank& t) { t.fill_spacing = 1e-10; }));
    cases.push_back(tank("spacing", "1e-06", "one that gives at most 2147483647 particles",
                         [](Tank& t) { t.fill_spacing = 1e-6; }));
    cases.push_back(tank("spacing", "0.025", "the spacing of the first fill", [](Tank& t) { t.fill_spacing = 0.025; }));
    expect_sentences(cases);
}
TEST(BadInput, OfAParticle)
{
    expect_sentences({
        tank("position of particle 100", "nan", "a finite number", [](Tank& t) { t.x[1] = nan_value; }),
        tank("position of particle 100", "inf", "a finite number", [](Tank& t) { t.x[0] = infinite; }),
        tank("velocity of particle 100", "nan", "a finite number", [](Tank& t) { t.v[1] = nan_value; }),
        tank("density of particle 100", "nan", "a finite number", [](Tank& t) { t.density = nan_value; }),
        tank("density of particle 100", "0", "above 0", [](Tank& t) { t.density = 0; }),
        tank("density of particle 100", "-1", "above 0", [](Tank& t) { t.density = -1; }),
    });
}
TEST(BadInput, OfARun)
{
    expect_sentences({
        tank("until", "nan", "0 or above [s]", [](Tank& t) { t.run.until = nan_value; }),
        tank("until", "-1", "0 or above [s]", [](Tank& t) { t.run.until = -1; }),
        tank("dt", "-0.001", not_negative + "s]", [](Tank& t) { t.run.dt = -1e-3; }),
        tank("dt", "nan", not_negative + "s]", [](Tank& t) { t.run.dt = nan_value; }),
        tank("cfl", "0", "above 0 and at most 10", [](Tank& t) { t.run.cfl = 0; }),
        tank("cfl", "nan", "above 0 and at most 10", [](Tank& t) { t.run.cfl = nan_value; }),
        tank("cfl", "11", "above 0 and at most 10", [](Tank& t) { t.run.cfl = 11; }),
        tank("steps", "-1", "0 or above", [](Tank& t) { t.run.steps = -1; }),
        Case{"dt", "0", "above 0: the model has no criterion that bounds the step",
             [] {
                 Simulation sim(dem<2>({.mass = 0.1, .radius = 0.01}, Gravity<2>{}), SymplecticEuler{}, Open{});
                 sim.add({{0.5, 0.5}});
                 sim.run({.steps = 1});
             }},
    });
}
TEST(BadInput, OfTheMachinery)
{
    expect_sentences({
        tank("Threads.count", "-1", "0 (all) to 4096", [](Tank& t) { t.backend.count = -1; }),
        tank("cell", "-1", "0 (by dimension), or 1 to 32 ranges", [](Tank& t) { t.backend.cell = -1; }),
        tank("cell", "33", "0 (by dimension), or 1 to 32 ranges", [](Tank& t) { t.backend.cell = 33; }),
        tank("neighbours.skin", "0", "above 0 and at most 2", [](Tank& t) { t.neighbours.skin = 0; }),
        tank("neighbours.skin", "nan", "above 0 and at most 2", [](Tank& t) { t.neighbours.skin = nan_value; }),
        tank("neighbours.bins", "1", "0, or 1 + skin up to 4", [](Tank& t) { t.neighbours.bins = 1; }),
        tank("neighbours.trigger", "3", "0, or above 0 and at most", [](Tank& t) { t.neighbours.trigger = 3; }),
        tank("neighbours.finer", "0", "1 to 16", [](Tank& t) { t.neighbours.finer = 0; }),
        tank("Watch.energy_every", "0", "1 or above [steps]", [](Tank& t) { t.watch.energy_every = 0; }),
        tank("Watch.calm", "0", "1 or above [looks]", [](Tank& t) { t.watch.calm = 0; }),
        tank("the range of interaction", "1e+300", "between 1e-18 and 1e18 [m]", [](Tank& t) { t.h = 5e299; }),
        tank("the range of interaction", "2e-19", "between 1e-18 and 1e18 [m]", [](Tank& t) { t.h = 1e-19; }),
        tank("Bce.spacing", "0.02", "at least 0.0", [](Tank& t) { t.h = 1; }),
        tank("Bce.spacing", "1e-10", "at least a billionth of the box length", [](Tank& t) { t.spacing = 1e-10; }),
        tank("Watch.stop", "nan", "a number above 0 [-]", [](Tank& t) { t.watch.stop = nan_value; }),
        tank("Watch.warn", "-0.01", "a number above 0 [-]", [](Tank& t) { t.watch.warn = -0.01; }),
    });
}
TEST(BadInput, OfAPeriodicSpace)
{
    expect_sentences({
        grains("periodic box length along axis 1", "0.03", "at least twice the reach of the neighbour lists, 0.0",
               [](Grains& s) { s.box.hi[1] = 0.03; }),
        grains("periodic box length along axis 0", "1e+300", "at most 67108864 times the reach of the neighbour lists",
               [](Grains& s) { s.box.hi[0] = 1e300; }),
        grains("box length along axis 0", "0", positive + "m]", [](Grains& s) { s.box.hi[0] = 0; }),
        grains("box length along axis 0", "nan", positive + "m]", [](Grains& s) { s.box.lo[0] = nan_value; }),
        {"face", "axis 2", "an axis of the space",
         [] {
             Periodic(Box<2>{{}, {{1, 1}}}, open(Face{2, true}));
         }},
        {"axis 0", "periodic at one end and open or a wall at the other", "periodic at both ends or at none",
         [] {
             Bce(Box<2>{{}, {{1, 1}}}, 0.1, Adami{}, periodic(x_axis), open(left)).check(0.1);
         }},
    });
}
// A mass that nobody has set would be 0, and a fluid without mass does nothing.
TEST(BadInput, OfAFluidWithoutAFill)
{
    expect_sentences({{"mass", "0", "above 0 [kg]; the spacing of a fill sets it", [] {
                           auto fluid = wcsph(CubicSpline<2>{1}, LinearEos{1, 1}, PressureForce<2>{});
                           Simulation sim(fluid, SymplecticEuler{}, Open{}, Serial{});
                           sim.add({{0, 0}});
                           sim.run({.steps = 1});
                       }}});
}

} // namespace
