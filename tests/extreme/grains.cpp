// SPDX-License-Identifier: BSD-3-Clause
// Extreme scenes of grains, in double and float: each ends well, or in a typed stop that says why.
#include "scene.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace extreme;
using testing::Contains;
using testing::HasSubstr;
using Point = Vec<2, double>;

constexpr double m = 0.1, r = 0.01, k = 1e5;

class Grains : public testing::TestWithParam<Real> {
protected:
    [[nodiscard]] static extreme::Setup setup() { return {.kind = Kind::grains, .real = GetParam()}; }
    [[nodiscard]] static bool in_float() { return GetParam() == Real::float_; }
    [[nodiscard]] static double eps() { return in_float() ? 0x1p-24 : 0x1p-53; }
};
INSTANTIATE_TEST_SUITE_P(In, Grains, testing::Values(Real::double_, Real::float_), testing::PrintToStringParamName());

/// A closed chain of discs, each pressed into the next by a tenth of a radius, all of it at rest but for a wave of the
/// shortest length: omega = 2 sqrt(k/m).
class Chain {
public:
    Chain(extreme::Setup s, double amplitude) : amplitude_(amplitude)
    {
        s.periodic = true;
        s.box = {{{0, 0}}, {{n * gap, 1}}};
        scene_ = make(s);
        for (int i = 0; i < n; ++i)
            scene_->add({{(i + 0.25) * gap, 0.5}}, {{i % 2 == 0 ? amplitude : -amplitude, 0}}, m, r);
        scene_->current();
        start_ = scene_->states();
    }
    /// (speed, omega displacement) of the wave, over its start.
    [[nodiscard]] double size() const
    {
        const auto now = scene_->states();
        double v = 0, x = 0;
        for (std::size_t i = 0; i < now.size(); ++i) {
            const double sign = i % 2 == 0 ? 1 : -1;
            double way = now[i].x[0] - start_[i].x[0];
            way -= n * gap * std::round(way / (n * gap));
            v += sign * now[i].v[0] / n, x += sign * way / n;
        }
        return std::hypot(v, omega() * x) / amplitude_;
    }
    static double omega() { return 2 * std::sqrt(k / m); }
    [[nodiscard]] Scene& scene() const { return *scene_; }

private:
    static constexpr int n = 8;
    static constexpr double gap = 1.9 * r;
    double amplitude_;
    std::unique_ptr<Scene> scene_;
    std::vector<State> start_;
};

// X01: the chain stands omega dt = 2, and grows beyond as the map has it.
TEST_P(Grains, X01AChainGrowsAndIsBoundedAsTheoryHasIt)
{
    const double amplitude = in_float() ? 1e-3 : 1e-7; // [m/s]; omega r / 10 is 2 m/s
    for (int threads : {1, 2})
        for (int integrator = 0; integrator < 4; ++integrator) {
            auto s = setup();
            s.integrator = integrator, s.threads = threads, s.watch = {.warn = 1e9, .stop = 1e10};
            auto growth = [&](double z, int from, int to) {
                const Chain chain(s, amplitude);
                chain.scene().run({.steps = from, .dt = z / Chain::omega()});
                const double before = chain.size();
                chain.scene().run({.steps = to - from, .dt = z / Chain::omega()});
                return std::pow(chain.size() / before, 1.0 / (to - from)) - 1;
            };
            auto bounded = [&](double z) {
                const Chain chain(s, amplitude);
                for (int part = 0; part < 12; ++part) {
                    if (end_of([&] { chain.scene().run({.steps = 10, .dt = z / Chain::omega()}); }).name != "ok")
                        return false;
                    if (!(chain.size() < 100)) return false;
                }
                return true;
            };
            if (integrator == chosen::forward_euler || integrator == chosen::runge_kutta2)
                for (double z : in_float() ? std::vector{0.8} : std::vector{0.3, 0.8}) {
                    const std::complex<double> R(1 - (integrator == chosen::runge_kutta2 ? z * z / 2 : 0), z);
                    EXPECT_NEAR(growth(z, 4, 14), std::abs(R) - 1, 0.05 * (std::abs(R) - 1))
                        << chosen::integrators[integrator] << z;
                }
            else {
                const double z = 2.1, half = z * z / 2 - 1, exact = half + std::sqrt(half * half - 1) - 1;
                EXPECT_NEAR(growth(z, 4, 8), exact, 0.05 * exact);
                double low = 1.94, high = 2.06;
                EXPECT_TRUE(bounded(low));
                EXPECT_FALSE(bounded(high));
                while (high - low > 0.01) (bounded(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
                EXPECT_NEAR(low, 2, 0.04);
                std::printf("  %s, %s: bounded to omega dt = %.3f\n", testing::PrintToString(GetParam()).c_str(),
                            chosen::integrators[integrator], low);
            }
        }
}
TEST_P(Grains, X01AboveTheLimitIsStoppedWithin200Steps)
{
    for (int integrator : {chosen::symplectic_euler, chosen::leapfrog, chosen::forward_euler})
        for (double times : {1.05, 2.0, 10.0}) {
            auto s = setup();
            s.integrator = integrator;
            const Chain chain(s, 0.1);
            const End end = end_of([&] { chain.scene().run({.steps = 200, .dt = times * 2 / Chain::omega()}); });
            EXPECT_THAT(end.name, testing::AnyOf("EnergyRunaway", "OverlapTooDeep", "SkinOutrun")) << times;
            EXPECT_FALSE(chain.scene().report().warnings.empty()); // said at the first step
            std::printf("  %s, %s, %.4g of the limit: %s at step %d\n", testing::PrintToString(GetParam()).c_str(),
                        chosen::integrators[integrator], times, end.name.c_str(), int(end.facts.step));
        }
}
// X02: one grain of 1e-8 of the others' mass sets the step; what they store and move stays.
TEST_P(Grains, X02TheStiffestContactSetsTheStep)
{
    for (double ratio : {1.0, 1e-4, 1e-8}) {
        auto s = setup();
        s.box = {{{0, 0}}, {{0.2, 0.2}}};
        s.periodic = true;
        auto scene = make(s);
        std::mt19937_64 random(5);
        std::uniform_real_distribution<double> u(-1, 1);
        for (int i = 0; i < 36; ++i) // 0.4 mm apart
            scene->add({{(i % 6 + 1) * 0.0204, (i / 6 + 1) * 0.0204}}, {{0.5 * u(random), 0.5 * u(random)}},
                       i == 14 ? ratio * m : m, r);
        scene->run({.steps = ratio < 1 ? 20000 : 5000});
        EXPECT_NEAR(scene->dt(), std::numbers::pi / 25 / std::sqrt(2 * k / (ratio * m)), 1e-12);
        const double start = scene->report().start.total();
        EXPECT_NEAR(scene->energy().total(), start, 0.01 * start) << ratio;
        std::printf("  %s, mass ratio %.0e: dt %.3g s, energy %+.2g\n", testing::PrintToString(GetParam()).c_str(),
                    ratio, scene->dt(), scene->energy().total() / start - 1);
    }
}
TEST_P(Grains, X02AStiffnessOf1e13IsBounded)
{
    auto s = setup();
    s.k = 1e13;
    auto scene = make(s);
    const double gap = in_float() ? 2e-7 : 1e-9; // contact lasts 0.2 us
    scene->add({{0.5 - r - gap, 0.5}}, {{0.5, 0}}, m, r);
    scene->add({{0.5 + r + gap, 0.5}}, {{-0.5, 0}}, m, r);
    const End end = end_of([&] { scene->run({.steps = 300}); });
    // The overlap is v/omega = 35 nm, which float rounds by 30 nm at x = 0.5 m: there energy is noise, and the watch says so.
    if (in_float()) {
        EXPECT_THAT(end.name, testing::AnyOf("ok", "EnergyRunaway"));
        EXPECT_TRUE(finite(scene->states()));
        return;
    }
    EXPECT_EQ(end.name, "ok") << end.message;
    EXPECT_NEAR(scene->states()[0].v[0], -0.5, 0.005);
    EXPECT_NEAR(scene->dt(), std::numbers::pi / 25 / std::sqrt(2 * s.k / m), 1e-9);
}
// X03: a disc of 1e-6 of the mass bounces off a heavy one.
TEST_P(Grains, X03ALightDiscBouncesOffAHeavyOne)
{
    constexpr double heavy = 1e6 * m, speed = 0.1;
    auto s = setup();
    auto scene = make(s);
    // Places where float is fine; the overlap is v/omega = 0.1 mm.
    scene->add({{0.1, 0.1}}, {{0, 0}}, heavy, r);
    scene->add({{0.1 + 2 * r + 1e-4, 0.1}}, {{-speed, 0}}, m, r);
    const double dt = std::numbers::pi / std::sqrt(k / m) / 111;
    scene->run({.until = 1e-2, .dt = dt});
    const auto all = scene->states();
    const double e = (all[1].v[0] - all[0].v[0]) / speed;
    EXPECT_NEAR(e, 1, 1e-3);
    const double exact = -2 * m * speed / (m + heavy); // of the heavy one, by momentum
    EXPECT_NEAR(heavy * (all[0].v[0] - exact), 0, 1e-3 * m * speed);
    const double p = scene->momentum()[0] + m * speed;
    EXPECT_NEAR(p, 0, (in_float() ? 1e3 : 450) * eps() * 2 * m * speed); // 1e-13 in double: a rounding a step
    std::printf("  %s: e = 1 %+.1e, momentum lost %.1e of the light one's\n",
                testing::PrintToString(GetParam()).c_str(), e - 1, std::abs(p) / (m * speed));
}
// X06: a contact of two at one place has no normal.
TEST_P(Grains, X06TwoAtOnePlaceAreAStop)
{
    for (double apart : {0.0, 1e-300, 5e-324}) {
        auto scene = make(setup());
        scene->add({{0.25, 0.5}}, {{1, 0}}, m, r);
        scene->add({{0.5, 0.5}}, {{0, 0}}, m, r);
        scene->add({{0.5 + apart, 0.5}}, {{0, 0}}, m, r);
        const End end = end_of([&] { scene->run({.steps = 10}); });
        EXPECT_EQ(end.name, "CoincidentParticles");
        EXPECT_EQ(end.facts.particle, 1);
        EXPECT_EQ(end.facts.other, 2);
        EXPECT_EQ(end.facts.step, 0);
    }
}
// ... also when a hand puts them there later: then the term that met them is named.
TEST_P(Grains, X06TwoThatComeToOnePlaceAreAStop)
{
    for (int integrator = 0; integrator < 4; ++integrator) {
        auto s = setup();
        s.integrator = integrator;
        auto scene = make(s);
        scene->add({{0.25, 0.5}}, {{0, 0}}, m, r);
        scene->add({{0.5, 0.5}}, {{0, 0}}, m, r);
        scene->run({.steps = 3});
        auto one = scene->states()[0];
        one.x = scene->states()[1].x;
        scene->put(0, one);
        const End end = end_of([&] { scene->run({.steps = 10}); });
        EXPECT_EQ(end.name, "CoincidentParticles") << end.message;
        EXPECT_EQ(end.facts.particle, 0);
        EXPECT_EQ(end.facts.other, 1);
        EXPECT_EQ(end.facts.term, "LinearSpring");
        EXPECT_EQ(end.facts.position[0], one.x[0]);
    }
}
// X11: nobody, one, two.
TEST_P(Grains, X11FewGrainsRunToTheEnd)
{
    for (int n : {0, 1, 2}) {
        auto scene = make(setup());
        for (int i = 0; i < n; ++i) scene->add({{0.3 * (i + 1), 0.5}}, {{0.1, 0}}, m, r);
        const End end = end_of([&] { scene->run({.until = 0.01, .dt = 1e-3}); });
        EXPECT_EQ(end.name, "ok") << end.message;
        EXPECT_EQ(scene->time(), 0.01);
        EXPECT_NEAR(scene->energy().kinetic, n * 0.5 * m * 0.01, 1e-6 * m);
    }
}
// X18: how deep two discs may be in each other at the start.
TEST_P(Grains, X18ADeepOverlapAtTheStartIsAStop)
{
    for (double depth : {0.05, 0.1, 0.15, 0.25, 0.5, 0.9, 1.0, 1.9}) { // over the radius
        auto scene = make(setup());
        scene->add({{0.5, 0.5}}, {{0, 0}}, m, r);
        scene->add({{0.5 + (2 - depth) * r, 0.5}}, {{0, 0}}, m, r);
        const End end = end_of([&] { scene->run({.steps = 20}); });
        if (depth < 0.2) {
            EXPECT_EQ(end.name, "ok") << end.message;
            continue;
        }
        EXPECT_EQ(end.name, "OverlapTooDeep") << depth;
        EXPECT_NEAR(end.facts.value, depth, 1e-4);
        EXPECT_EQ(end.facts.limit, 0.2);
        EXPECT_EQ(end.facts.particle, 0);
        EXPECT_EQ(end.facts.other, 1);
        EXPECT_EQ(end.facts.step, 0);
        auto s = setup();
        s.watch.overlap = 2;
        auto let = make(s); // asked for: energy of the spring becomes that of motion
        let->add({{0.5, 0.5}}, {{0, 0}}, m, r);
        let->add({{0.5 + (2 - depth) * r, 0.5}}, {{0, 0}}, m, r);
        EXPECT_EQ(end_of([&] { let->run({.until = 2e-3}); }).name, "ok");
        EXPECT_NEAR(let->energy().kinetic, 0.5 * k * depth * depth * r * r, 0.02 * 0.5 * k * depth * depth * r * r)
            << depth;
    }
}
// X19: what moves by a radius in a step meets nobody in time: told at a tenth, stopped at one.
TEST_P(Grains, X19WhatOutrunsItsContactsIsToldAndStopped)
{
    for (double way : {0.04, 0.2, 0.9, 1.2, 5.0}) { // over the radius, in a step
        auto s = setup();
        auto scene = make(s);
        const double dt = 1e-4, v = way * r / dt;
        scene->add({{0.2, 0.5}}, {{v, 0}}, m, r);
        scene->add({{0.8, 0.5}}, {{-v, 0}}, m, r);
        const End end = end_of([&] { scene->run({.steps = 3, .dt = dt}); });
        if (way > 1) {
            EXPECT_EQ(end.name, "OverlapTooDeep") << way;
            EXPECT_EQ(end.facts.step, 0);
            EXPECT_EQ(end.facts.particle, 0);
            EXPECT_NEAR(end.facts.value, way * r, 1e-6 * r);
        }
        // Both close in: SkinOutrun, since lists reach 0.6 radii, may come before.
        else EXPECT_THAT(end.name, testing::AnyOf("ok", way > 0.25 ? "SkinOutrun" : "ok")) << end.message;
        if (way > 0.1) EXPECT_THAT(scene->report().warnings, Contains(HasSubstr("radii in a step")));
        else EXPECT_THAT(scene->report().warnings, testing::Each(testing::Not(HasSubstr("radii in a step"))));
    }
}
// X20: elastic walls: in corners, with many bounces a step, energy is kept to the last bit.
TEST_P(Grains, X20CornersKeepEnergyAndLetGo)
{
    auto s = setup();
    s.box = {{{0, 0}}, {{0.1, 0.1}}};
    s.integrator = chosen::symplectic_euler;
    auto scene = make(s);
    scene->add({{0.0101, 0.0101}}, {{-1, -1}}, m, r);
    scene->add({{0.0899, 0.0101}}, {{1, -0.5}}, m, r);
    const double before = scene->energy().kinetic;
    for (int n = 0; n < 300; ++n) {
        scene->run({.steps = 1, .dt = 1e-4});
        for (auto const& i : scene->states())
            for (int c = 0; c < 2; ++c) {
                ASSERT_GE(i.x[c], r * (1 - 2 * eps()));
                ASSERT_LE(i.x[c], (0.1 - r) * (1 + 2 * eps()));
            }
    }
    EXPECT_EQ(scene->energy().kinetic, before);
    EXPECT_GT(scene->states()[0].v[0], 0);
}

} // namespace
