// SPDX-License-Identifier: BSD-3-Clause
// What a stop tells: the particle, the limit, and the term that made a value which is not finite.
#include "scene.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace extreme;
using namespace spate;
using testing::HasSubstr;
using Point = Vec<2, double>;

constexpr double dx = 0.02, rho0 = 1000, c0 = 20, never = -1e9;

/// A pull of sqrt(x - at): not a number to the left of `at`.
struct Root {
    static constexpr Fields reads{position};
    static constexpr Fields adds{acceleration};
    double at;
    void operator()(auto& i) const
    {
        auto pull = 0 * i[position];
        pull[0] = 1e-3 * sqrt(i[position][0] - at);
        i[acceleration] += pull;
    }
};
/// A force that no two particles nearer than `reach` survive.
struct Sting {
    static constexpr Fields adds{acceleration};
    double reach;
    void operator()(auto& i, auto const&, auto const& ij) const
    {
        i[acceleration] += (0 * sqrt(ij.r2 - reach * std::abs(reach))) * ij.x;
    }
};
/// A fluid of three lone particles and a pair, with both.
auto scene(int integrator, double root, double sting)
{
    chosen::integrator = integrator;
    auto fluid =
        wcsph(CubicSpline<2>{1.3 * dx}, Tait{rho0, c0}, Continuity<2>{}, PressureForce<2>{}, Root{root}, Sting{sting});
    Simulation sim(fluid, chosen::AnyIntegrator{}, Periodic(Box<2>{{{0, 0}}, {{1, 1}}}), Threads{2}, Double{},
                   TracingWatch{});
    sim.fill(Box<2>{{{0.4, 0.4}}, {{0.6, 0.6}}}, dx);
    sim.add({{0.3, 0.1}}, {{-1, 0}});   // id 100: on its way to the left
    sim.add({{0.8, 0.8}}, {{0, 0}});    // 101
    sim.add({{0.85, 0.8}}, {{-20, 0}}); // 102: on its way to 101, which it hears from 0.052 on
    return sim;
}
/// Runs in pieces, as a user might, so that the last state kept is not always of this run.
template <class S>
End run(S& sim, int steps, double dt = 1e-4)
{
    return end_of([&] {
        while (sim.steps() < steps) sim.run({.steps = 7, .dt = dt});
    });
}
TEST(Stop, NamesTheParticleTermThatMadeWhatIsNotFinite)
{
    for (int integrator = 0; integrator < 4; ++integrator) {
        auto sim = scene(integrator, 0.29, never); // reached after 0.01 s
        const End end = run(sim, 400);
        EXPECT_EQ(end.name, "NonFinite") << chosen::integrators[integrator];
        EXPECT_EQ(end.facts.term, "Root") << chosen::integrators[integrator];
        EXPECT_EQ(end.facts.particle, 100);
        EXPECT_EQ(end.facts.other, -1);
        EXPECT_NEAR(double(end.facts.step), 101, 2);
        EXPECT_THAT(end.message, HasSubstr("made by Root; "));
        // The state is left as it was found.
        EXPECT_TRUE(sim.stopped());
        EXPECT_EQ(sim.steps(), end.facts.step);
        EXPECT_EQ(sim.time(), end.facts.time);
        auto const& p = sim.particles();
        int bad = 0; // symplectic Euler takes density rates with the new velocities: others follow
        for (std::size_t i = 0; i < p.size(); ++i)
            if (!std::isfinite(p.at(velocity, i)[0])) {
                ++bad;
                EXPECT_EQ(p.id()[i], 100u);
            }
        EXPECT_EQ(bad, 1);
        EXPECT_NEAR(end.facts.position[0], 0.29, 3e-4); // where it was when the term failed
        EXPECT_NEAR(end.facts.velocity[0], -1, 1e-3);
    }
}
TEST(Stop, NamesThePairTermAndTheNeighbour)
{
    for (int integrator = 0; integrator < 4; ++integrator) {
        auto sim = scene(integrator, never, 0.015);
        for (std::size_t i = 0; i < sim.particles().size(); ++i) // only these two are as near
            if (sim.particles().id()[i] < 100) sim.particles().put(velocity, i, {{0, 0}});
        const End end = run(sim, 1000);
        EXPECT_EQ(end.name, "NonFinite") << chosen::integrators[integrator];
        EXPECT_EQ(end.facts.term, "Sting") << chosen::integrators[integrator];
        EXPECT_EQ(end.facts.particle, 101);
        EXPECT_EQ(end.facts.other, 102);
        EXPECT_THAT(end.message, HasSubstr("made by Sting with particle 102; "));
    }
}
TEST(Stop, NamesNoTermWhereAHandDidIt)
{
    auto sim = scene(chosen::leapfrog, never, never);
    sim.run({.steps = 3});
    sim.particles().column(velocity)[0][7] = std::numeric_limits<double>::infinity();
    const End end = run(sim, 10);
    EXPECT_EQ(end.name, "NonFinite");
    EXPECT_EQ(end.facts.term, "");
}
TEST(Stop, OfADensityThatTheEquationOfStateDoesNotKnow)
{
    for (auto real : {extreme::Real::double_, extreme::Real::float_})
        for (double rho : {-1.0, 0.0, 3.001 * rho0, 1e30}) {
            extreme::Setup s{.real = real};
            auto scene = make(s);
            for (int k = 0; k < 20; ++k) scene->add({{k * dx, 0.5}});
            scene->run({.steps = 2});
            State one = scene->states()[13];
            one.rho = rho;
            scene->put(13, one);
            const End end = end_of([&] { scene->run({.steps = 2}); });
            EXPECT_EQ(end.name, "EosDomain") << rho;
            EXPECT_EQ(end.facts.particle, 13);
            EXPECT_EQ(end.facts.step, 2);
            EXPECT_EQ(end.facts.limit, rho > 0 ? 3 * rho0 : 0);
            EXPECT_NEAR(end.facts.value, rho, 1e-6 * std::abs(rho));
            EXPECT_THAT(end.message, HasSubstr("density [kg/m^3]"));
        }
}

} // namespace
