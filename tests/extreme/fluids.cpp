// SPDX-License-Identifier: BSD-3-Clause
// Extreme scenes of fluids, in double and float: each ends well, or in a typed stop that says why.
#include "scene.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace extreme;
using testing::Contains;
using testing::HasSubstr;
using Point = Vec<2, double>;

constexpr double dx = 0.02, rho0 = 1000, c0 = 20;

class Fluid : public testing::TestWithParam<Real> {
protected:
    [[nodiscard]] static extreme::Setup setup() { return {.real = GetParam()}; }
    [[nodiscard]] bool in_float() const { return GetParam() == Real::float_; }
    [[nodiscard]] double eps() const { return in_float() ? 0x1p-24 : 0x1p-53; } ///< half a unit in the last place
};
INSTANTIATE_TEST_SUITE_P(In, Fluid, testing::Values(Real::double_, Real::float_), testing::PrintToStringParamName());

/// A block of n by m particles with its lower left corner at a point.
void block(Scene& scene, Point at, int n, int m, Point v)
{
    for (int k = 0; k < n; ++k)
        for (int l = 0; l < m; ++l) scene.add({{at[0] + (k + 0.5) * dx, at[1] + (l + 0.5) * dx}}, v);
}
double momentum_scale(std::vector<State> const& all)
{
    double sum = 0;
    for (auto const& s : all) sum += s.mass * std::sqrt(s.v.squaredNorm());
    return sum;
}
double norm(Point const& x) { return std::sqrt(x.squaredNorm()); }

// X01: sound of the lattice above its limit: seen within 200 steps, and foretold at the first.
TEST_P(Fluid, X01AboveTheLimitIsStoppedWithin200Steps)
{
    constexpr double kappa = 1.070858; // tests/data/kernel_stability_constants.csv: cubic, 2D, h = 1.3 dx
    for (int integrator : {chosen::symplectic_euler, chosen::leapfrog})
        for (double times : {1.05, 2.0, 10.0})
            for (int threads : {1, 2}) {
                extreme::Setup s = setup();
                s.integrator = integrator, s.threads = threads, s.alpha = 0, s.periodic = true;
                s.box = {{{0, 0}}, {{16 * dx, 16 * dx}}};
                auto scene = make(s);
                scene->fill(s.box);
                std::mt19937_64 random(1);
                std::uniform_real_distribution<double> noise(-1, 1);
                auto all = scene->states();
                for (std::size_t k = 0; k < all.size(); ++k) {
                    // In float a density of 1000 does not feel less.
                    const double small = (in_float() ? 1e-4 : 1e-8) * c0;
                    all[k].v = {{small * noise(random), small * noise(random)}};
                    scene->put(k, all[k]);
                }
                const End end =
                    end_of([&] { scene->run({.steps = 200, .dt = times * 2 / kappa * s.smoothing * dx / c0}); });
                EXPECT_THAT(end.name, testing::AnyOf("EnergyRunaway", "SkinOutrun", "EosDomain", "NonFinite"))
                    << times << " of the limit";
                std::printf("  %s, %s, %.4g of the limit, %d threads: %s at step %d\n",
                            testing::PrintToString(GetParam()).c_str(), chosen::integrators[integrator], times, threads,
                            end.name.c_str(), int(end.facts.step));
            }
}
// X04: a block hits another one at ten times the speed of sound.
TEST_P(Fluid, X04AtTenTimesSoundIsBoundedOrStopped)
{
    for (double alpha : {0.1, 1.0})
        for (double mach : {0.5, 2.0, 10.0, 100.0}) {
            extreme::Setup s = setup();
            s.alpha = alpha;
            auto scene = make(s);
            block(*scene, {{0, 0}}, 12, 12, {{mach * c0, 0}});
            block(*scene, {{13 * dx, 0}}, 12, 12, {{0, 0}});
            double most = rho0, least = rho0;
            const Point before = scene->momentum();
            const End end = end_of([&] {
                scene->run({.steps = 300}, [&] {
                    for (auto const& p : scene->states()) most = std::max(most, p.rho), least = std::min(least, p.rho);
                });
            });
            EXPECT_THAT(end.name, testing::AnyOf("ok", "EosDomain", "EnergyRunaway", "SkinOutrun")) << end.message;
            EXPECT_TRUE(finite(scene->states())) << mach;
            EXPECT_NEAR(norm(scene->momentum() - before), 0, 1e3 * eps() * before[0]);
            if (end.name == "ok") {
                EXPECT_GT(least, 0);
                EXPECT_LE(most, 3 * rho0);
            }
            std::printf("  %s, alpha %.1f, %5.1f c0: %s after %d steps, rho/rho0 %.3f to %.3f, energy %+.2f %%\n",
                        testing::PrintToString(GetParam()).c_str(), alpha, mach, end.name.c_str(), int(scene->steps()),
                        least / rho0, most / rho0, 100 * scene->report().energy_rise);
        }
}
// ... and the first step is shorter by the speed.
TEST_P(Fluid, X04TheStepFollowsTheSpeed)
{
    extreme::Setup s = setup();
    auto scene = make(s);
    block(*scene, {{0, 0}}, 3, 3, {{10 * c0, 0}});
    scene->run({.steps = 1, .cfl = 0.25});
    EXPECT_NEAR(scene->dt(), 0.25 * s.smoothing * dx / (c0 + 10 * c0), 1e3 * eps() * scene->dt());
}
// X05: without neighbours a particle falls as a stone, and its density is no one's business.
TEST_P(Fluid, X05WithoutNeighboursAFlightIsBallistic)
{
    for (int integrator : {chosen::symplectic_euler, chosen::leapfrog, chosen::runge_kutta2}) {
        extreme::Setup s = setup();
        s.integrator = integrator;
        s.g = {{0, -9.81}};
        auto scene = make(s);
        const Point x[] = {{{0, 0}}, {{5 * dx, 0}}}, v[] = {{{-1, 3}}, {{2, 0.5}}};
        for (int k = 0; k < 2; ++k) scene->add(x[k], v[k]);
        constexpr int steps = 1000;
        constexpr double dt = 1e-4, t = steps * dt;
        scene->run({.steps = steps, .dt = dt});
        auto const all = scene->states();
        // Each step rounds x and v once or twice; symplectic Euler lags by g dt t / 2.
        const double rounding = 4 * steps * eps() * 3,
                     lag = integrator == chosen::symplectic_euler ? 9.81 * dt * t / 2 : 0;
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_NEAR(all[k].x[0], x[k][0] + v[k][0] * t, rounding);
            EXPECT_NEAR(all[k].x[1], x[k][1] + v[k][1] * t - 9.81 * t * t / 2 - lag, rounding);
            EXPECT_NEAR(all[k].v[1], v[k][1] - 9.81 * t, rounding);
            EXPECT_EQ(all[k].v[0], v[k][0]);
            EXPECT_EQ(all[k].rho, rho0);
        }
    }
}
// X06: at one place, or as near as numbers go: finite, the same for each copy, and told.
TEST_P(Fluid, X06AtOnePlaceForcesAreFiniteAndSymmetric)
{
    for (double apart : {0.0, 1e-300, 5e-324, 1e-40, 1e-20, 1e-9})
        for (int copies : {2, 3, 8}) {
            extreme::Setup s = setup();
            s.periodic = true;
            s.box = {{{0, 0}}, {{12 * dx, 12 * dx}}};
            auto scene = make(s);
            const Point at{{0, 0}}; // where numbers are finest
            scene->fill(s.box);
            const std::size_t first = scene->size();
            for (int k = 0; k < copies; ++k) scene->add({{at[0] + k * apart, at[1]}});
            const End end = end_of([&] { scene->run({.steps = 20}); });
            EXPECT_THAT(end.name, testing::AnyOf("ok", "EosDomain")) << end.message << ' ' << apart << ' ' << copies;
            const auto all = scene->states();
            EXPECT_TRUE(finite(all));
            EXPECT_LE(norm(scene->momentum()), 100 * eps() * momentum_scale(all));
            if (apart > 0) continue;
            for (int k = 1; k < copies; ++k) {
                EXPECT_EQ(all[first + std::size_t(k)].x, all[first].x);
                EXPECT_EQ(all[first + std::size_t(k)].v, all[first].v);
            }
            EXPECT_THAT(scene->report().warnings, Contains(HasSubstr("are at one place")));
        }
}
/// Rates of the state by all pairs, from the formulas.
void all_pairs(std::vector<State>& all, double h, double alpha)
{
    const double sigma = 5 / (14 * M_PI) / (h * h);
    for (auto& i : all) {
        long double ax = 0, ay = 0, rate = 0;
        for (auto const& j : all) {
            const Point x = i.x - j.x, v = i.v - j.v;
            const double r2 = x.squaredNorm(), r = std::sqrt(r2), q = r / h;
            if (q >= 2 || &i == &j) continue;
            const double g = q < 1 ? -12 + 9 * q : -3 * (2 - q) * (2 - q) / q, F = sigma / (h * h) * g;
            const double vx = v.dot(x), mu = std::min(vx, 0.0) * h / (r2 + 0.01 * h * h);
            const double force =
                i.p / (i.rho * i.rho) + j.p / (j.rho * j.rho) - alpha * c0 * mu / (0.5 * (i.rho + j.rho));
            ax -= j.mass * force * F * x[0], ay -= j.mass * force * F * x[1];
            rate += j.mass * vx * F;
        }
        i.a = {{double(ax), double(ay)}}, i.rho_rate = double(rate);
    }
}
void expect_all_pairs(extreme::Setup const& s, int n, double tolerance)
{
    auto scene = make(s);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> u(-1, 1);
    const double h = s.smoothing * dx;
    for (int k = 0; k < n; ++k) scene->add({{0.5 + 0.4 * h * u(random), 0.5 + 0.4 * h * u(random)}});
    scene->current();
    auto all = scene->states();
    for (std::size_t k = 0; k < all.size(); ++k) {
        all[k].v = {{u(random), u(random)}}, all[k].rho = rho0 * (1 + 0.01 * u(random));
        scene->put(k, all[k]);
    }
    scene->rates();
    const auto engine = scene->states();
    auto exact = engine;
    all_pairs(exact, h, s.alpha);
    double largest_a = 0, largest_rate = 0, error_a = 0, error_rate = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        largest_a = std::max(largest_a, norm(exact[k].a)), error_a = std::max(error_a, norm(engine[k].a - exact[k].a));
        largest_rate = std::max(largest_rate, std::abs(exact[k].rho_rate));
        error_rate = std::max(error_rate, std::abs(engine[k].rho_rate - exact[k].rho_rate));
    }
    EXPECT_LT(error_a, tolerance * largest_a);
    EXPECT_LT(error_rate, tolerance * largest_rate);
    std::printf("  %d particles within a range: largest error of a %.2g, of a density rate %.2g\n", n,
                error_a / largest_a, error_rate / largest_rate);
}
// X07: a hundred times the neighbours are all heard: lists have no cap.
TEST_P(Fluid, X07AClumpIsTheSumOverAllPairs)
{
    for (int threads : {1, 2}) {
        extreme::Setup s = setup();
        s.threads = threads;
        expect_all_pairs(s, 2000, in_float() ? 1e-4 : 1e-12);
    }
}
TEST(LongFluid, X07AClumpOf10000InOneCellIsTheSumOverAllPairs) { expect_all_pairs({}, 10000, 1e-12); }

// X09: a thousand lengths of the box in a step, and a thousand lengths by small steps: still in the box, in place.
TEST_P(Fluid, X09JumpsAndLongWaysEndInTheBox)
{
    struct Case {
        double v, dt;
        int steps;
    };
    for (auto [v, dt, steps] : {Case{1e6, 1e-3, 1}, Case{1024, 1.0 / 1024, 1000}, Case{-1024, 1.0 / 1024, 1000}}) {
        extreme::Setup s = setup();
        s.periodic = true;
        auto scene = make(s);
        for (int k = 0; k < 16; ++k) // in float, too, x + v dt is exact as long as x is in the box
            scene->add({{0.25 + (k % 4) * 0x1p-6 + 0x1p-18, 0.5 + k / 4 * 0x1p-6}}, {{v, 0}});
        scene->current();
        const auto before = scene->states();
        scene->run({.steps = steps, .dt = dt});
        scene->current();
        const auto after = scene->states();
        for (std::size_t k = 0; k < after.size(); ++k) {
            double way = after[k].x[0] - before[k].x[0] - v * dt * steps;
            way -= std::round(way);
            EXPECT_GE(after[k].x[0], 0);
            EXPECT_LT(after[k].x[0], 1);
            EXPECT_NEAR(way, 0, std::abs(v * dt) < 2 ? 0 : 4 * std::abs(v * dt) * eps()) << v * dt;
        }
    }
}
// X11: nobody, one, two; each run ends at its time, and sums over nobody are 0.
TEST_P(Fluid, X11FewParticlesRunToTheEnd)
{
    for (int n : {0, 1, 2}) {
        extreme::Setup s = setup();
        auto scene = make(s);
        for (int k = 0; k < n; ++k) scene->add({{0.5 * k, 0.5}});
        const End end = end_of([&] { scene->run({.until = 0.01}); });
        EXPECT_EQ(end.name, "ok") << end.message;
        EXPECT_EQ(scene->time(), 0.01);
        EXPECT_EQ(scene->energy().kinetic, 0);
    }
}
// X14: two jets, each two particles wide, meet: they may break, but nothing pulls, nothing is lost.
TEST_P(Fluid, X14ThinJetsMeetWithoutAGain)
{
    extreme::Setup s = setup();
    auto scene = make(s);
    block(*scene, {{-20 * dx, 0}}, 20, 2, {{1, 0}});
    block(*scene, {{0, 0}}, 20, 2, {{-1, 0}});
    const double before = scene->energy().kinetic;
    double least = rho0;
    const End end = end_of([&] {
        scene->run({.until = 0.4}, [&] {
            for (auto const& p : scene->states()) least = std::min(least, p.rho);
        });
    });
    EXPECT_EQ(end.name, "ok") << end.message;
    EXPECT_LT(norm(scene->momentum()), double(scene->steps()) * 10 * eps() * momentum_scale(scene->states()));
    EXPECT_LT(scene->energy().total(), before * (1 + 1e-3));
    EXPECT_GT(least, 0.5 * rho0);
    std::printf("  %s: energy left %.3f of the start, least density %.3f rho0\n",
                testing::PrintToString(GetParam()).c_str(), scene->energy().total() / before, least / rho0);
}
// X15: coordinates 30 million times h: exact in double to their own rounding; float cannot hold them and says so.
TEST_P(Fluid, X15FarFromTheOriginForcesHoldOrAreRefused)
{
    constexpr double far = 3e4, small = 1e-3; // cells have indices up to 2^20
    auto forces = [&](double at) {
        extreme::Setup s = setup();
        s.dx = small / s.smoothing;
        s.skin = 0.2; // of h: what rounding takes from places is little beside it
        auto scene = make(s);
        std::mt19937_64 random(3);
        std::uniform_real_distribution<double> u(-1, 1);
        for (int k = 0; k < 40; ++k) {
            const Point near{{2 * small * u(random), 2 * small * u(random)}}, v{{u(random), u(random)}};
            scene->add({{(near[0] + far) - far + at, (near[1] + far) - far + at}}, v); // the same differences, exactly
        }
        scene->current();
        scene->rates();
        return scene->states();
    };
    if (in_float()) {
        const End end = end_of([&] { forces(far); });
        EXPECT_EQ(end.name, "BadInput");
        EXPECT_THAT(end.message, HasSubstr("position of particle 0"));
        return;
    }
    const auto near = forces(0), there = forces(far);
    double largest = 0, error = 0;
    for (std::size_t k = 0; k < near.size(); ++k) {
        largest = std::max(largest, norm(near[k].a));
        error = std::max(error, norm(near[k].a - there[k].a));
    }
    EXPECT_GT(largest, 0);
    EXPECT_LT(error, 1e-12 * largest);
}
// X21: at rest without a force the step is bounded by sound; after a shock it grows by a tenth a step at most.
TEST_P(Fluid, X21TheStepIsBoundedAndGrowsSlowly)
{
    extreme::Setup s = setup();
    s.watch = {.warn = 1e9, .stop = 1e10}; // a hand brings energy
    auto scene = make(s);
    block(*scene, {{0, 0}}, 8, 8, {{0, 0}});
    scene->run({.steps = 5, .cfl = 0.25});
    const double rest = 0.25 * s.smoothing * dx / c0;
    EXPECT_NEAR(scene->dt(), rest, 1e-6 * rest);
    auto fast = scene->states()[0];
    fast.v = {{-20 * c0, -20 * c0}};
    scene->put(0, fast);
    scene->run({.steps = 1, .cfl = 0.25});
    double last = scene->dt();
    EXPECT_LT(last, rest / 20);
    fast.v = {{0, 0}};
    fast.x = {{-1, -1}};
    scene->put(0, fast);
    scene->run({.steps = 60, .cfl = 0.25}, [&] {
        EXPECT_LE(scene->dt(), 1.1 * last * (1 + 1e-12));
        last = scene->dt();
    });
    EXPECT_GT(last, 0.9 * rest);
}
// X25: neither threads nor cells change a bit.
TEST_P(Fluid, X25BitsDependOnNobody)
{
    auto hash = [&](int threads, int cell) {
        extreme::Setup s = setup();
        s.threads = threads, s.cell = cell;
        auto scene = make(s);
        block(*scene, {{0, 0}}, 20, 20, {{0.5 * c0, 0}});
        block(*scene, {{21 * dx, 0}}, 20, 20, {{0, 0}});
        scene->run({.steps = 40});
        return scene->hash();
    };
    const auto one = hash(1, 0);
    for (int cell : {1, 2, 4, 8}) EXPECT_EQ(hash(2, cell), one) << cell;
    EXPECT_EQ(hash(4, 0), one);
}
// X26: a column at rest: what float makes of its pressure.
TEST_P(Fluid, X26PressureOfAColumnInFloat)
{
    auto pressures = [&](Real real) {
        extreme::Setup s = setup();
        s.real = real, s.kind = Kind::walled, s.g = {{0, -9.81}};
        s.box = {{{0, 0}}, {{0.4, 0.6}}};
        auto scene = make(s);
        scene->fill({{{0, 0}}, {{0.4, 0.4}}});
        scene->run({.steps = 100, .dt = 2e-4});
        scene->rates();
        std::vector<double> p;
        for (auto const& i : scene->states()) p.push_back(i.p);
        return p;
    };
    if (!in_float()) return;
    const auto a = pressures(Real::double_), b = pressures(Real::float_);
    double error = 0;
    for (std::size_t k = 0; k < a.size(); ++k) error = std::max(error, std::abs(a[k] - b[k]) / (rho0 * 9.81 * 0.4));
    EXPECT_LT(error, 1e-3);
    std::printf("  largest difference of a pressure after 100 steps: %.2g of that at the floor\n", error);
}
// X27: no force, no speed: not a bit moves.
TEST_P(Fluid, X27ALatticeStaysStill)
{
    for (int integrator = 0; integrator < 4; ++integrator) {
        extreme::Setup s = setup();
        s.integrator = integrator, s.periodic = true, s.alpha = 0;
        s.box = {{{0, 0}}, {{0.32, 0.4}}};
        auto scene = make(s);
        scene->fill(s.box);
        scene->run({.steps = 1});
        const auto hash = scene->hash();
        scene->run({.steps = 100});
        EXPECT_EQ(scene->hash(), hash);
        for (auto const& i : scene->states()) {
            ASSERT_EQ(norm(i.a), 0);
            ASSERT_EQ(i.rho, rho0);
        }
    }
}

} // namespace
