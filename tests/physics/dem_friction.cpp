// SPDX-License-Identifier: BSD-3-Clause
// Rough grains: what friction conserves, what it remembers, and what comes out of a collision.
#include "extreme/chosen.hpp"
#include "physics/grains.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace {
using namespace grains;

constexpr LinearSpring spring{.k = 1e5};
constexpr Dashpot dashpot{.e = 0.8};
constexpr Friction friction{.mu = 0.5};
const double t_c = std::numbers::pi / spring.contact_frequency(0.1);

/// Discs under the integrator in hand: one type of scene for all tests of the three laws in the plane.
auto discs(LinearSpring s, Dashpot d, Friction f)
{
    return Simulation(dem<2>({.mass = 0.1, .radius = 0.01}, s, d, f), chosen::AnyIntegrator{}, Open{}, Serial{},
                      Double{}, NoWatch{});
}
template <int Dim>
auto rough(Threads threads = {1})
{
    if constexpr (Dim == 2) {
        chosen::integrator = chosen::leapfrog;
        return discs(spring, dashpot, friction);
    }
    else
        return Simulation(dem<Dim>({.mass = 0.1, .radius = 0.01}, spring, dashpot, friction), Leapfrog{}, Open{},
                          threads, Double{}, NoWatch{});
}
auto rough_scalars()
{
    return Simulation(dem<3>({.mass = 0.1, .radius = 0.01}, spring, dashpot, friction), Leapfrog{}, Open{}, Serial{},
                      ScalarOf<Double>{}, NoWatch{});
}
template <int Dim>
auto rough_mixture()
{
    return Simulation(dem<Dim>(Mixture{.largest = 0.01}, spring, dashpot, friction), Leapfrog{}, Open{}, Serial{},
                      Double{}, NoWatch{});
}

/// Rounding: each of the contacts' pushes is opposite to 1 ulp of itself, and there are a few thousand of them a grain.
template <int Dim>
void expect_conserved(auto sim)
{
    scatter<Dim>(sim, {}, 7);
    const auto p0 = momentum<Dim>(sim);
    const auto l0 = angular_momentum<Dim>(sim);
    const auto w0 = sim.particles().at(angular_velocity, 0);
    sim.run({.until = 8 * t_c, .dt = t_c / 50});
    const double n = double(sim.particles().size()), scale = 0.1 * 1 * n;
    EXPECT_GT((sim.particles().at(angular_velocity, 0) - w0).squaredNorm(), 1); // they did touch
    EXPECT_LE(std::sqrt((momentum<Dim>(sim) - p0).squaredNorm()), 1e-14 * scale);
    EXPECT_LE(std::sqrt((angular_momentum<Dim>(sim) - l0).squaredNorm()), 1e-14 * scale * 0.04);
}
TEST(Friction, ConservesMomentumAndAngularMomentum)
{
    expect_conserved<2>(rough<2>());
    expect_conserved<3>(rough<3>());
    expect_conserved<3>(rough_mixture<3>());
}

// Both directed copies of a pair hold the same bits: docs/decisions/0017.
template <int Dim>
void expect_equal_copies(auto sim)
{
    scatter<Dim>(sim, {}, 11);
    std::size_t contacts = 0;
    for (int k = 0; k < 40; ++k) {
        sim.run({.steps = 10, .dt = t_c / 50});
        const auto pairs = sim.system().template kept_of_pairs<0, 0>();
        contacts += pairs.size();
        for (auto const& a : pairs) {
            bool found = false;
            for (auto const& b : pairs)
                if (b.i == a.j && b.j == a.i) found = std::memcmp(a.value.data(), b.value.data(), sizeof(a.value)) == 0;
            ASSERT_TRUE(found) << a.i << " " << a.j;
        }
    }
    EXPECT_GT(contacts, 100u);
}
TEST(Friction, IsRememberedAlikeByBothGrains)
{
    expect_equal_copies<2>(rough<2>());
    expect_equal_copies<3>(rough<3>());
    expect_equal_copies<3>(rough_mixture<3>());
}

TEST(Friction, DoesNotDependOnThreadsCellsOrPacks)
{
    auto hash = [](auto sim) {
        scatter<3>(sim, {.side = 5}, 3);
        sim.run({.until = 3 * t_c, .dt = t_c / 50});
        EXPECT_GT(sim.system().rebuilds(), 3);
        EXPECT_GT((sim.system().template kept_of_pairs<0, 0>().size()), 20u);
        return sim.state_hash();
    };
    const auto serial = hash(rough_scalars());
    for (int threads : {1, 2, 3, 7}) EXPECT_EQ(serial, hash(rough<3>(Threads{.count = threads, .cell = threads})));
}

/// Two discs that overlap and stick, one of them spinning: the spin of the other before they part.
double spin_of_the_other(int integrator, double dt, bool damped)
{
    chosen::integrator = integrator;
    auto sim = discs(spring, damped ? dashpot : Dashpot{.e = 1}, {.mu = 100}); // e = 1: nothing is lost
    sim.add({0, 0}, {0.3, 0.4}), sim.add({0.0195, 0}, {-0.3, -0.2});
    auto& p = sim.particles();
    p.put(angular_velocity, 0, {{30}});
    sim.prepare();
    sim.run({.steps = std::llround(0.6 * t_c / dt), .dt = dt});
    EXPECT_FALSE((sim.system().template kept_of_pairs<0, 0>().empty()));
    return p.at(angular_velocity, p.id()[0] == 1 ? 0 : 1)[0];
}
double order(int integrator, bool damped)
{
    const double dt = 0.6 * t_c / 200;
    const double a = spin_of_the_other(integrator, dt, damped), b = spin_of_the_other(integrator, dt / 2, damped),
                 c = spin_of_the_other(integrator, dt / 4, damped);
    return std::log2((a - b) / (b - c));
}
// The tangential spring is advanced as positions are: no integrator loses its order by it.
TEST(Friction, KeepsTheOrderOfTheIntegrator)
{
    EXPECT_NEAR(order(chosen::forward_euler, true), 1, 0.1);
    EXPECT_NEAR(order(chosen::symplectic_euler, true), 1, 0.1);
    EXPECT_NEAR(order(chosen::runge_kutta2, true), 2, 0.1);
    EXPECT_NEAR(order(chosen::runge_kutta2, false), 2, 0.1);
    // Leapfrog sees the slip in the geometry at the end of the drift: of first order, but only by what the normal turns.
    const double dt = 0.6 * t_c / 200, exact = spin_of_the_other(chosen::runge_kutta2, dt / 8, false);
    EXPECT_LE(std::abs(spin_of_the_other(chosen::leapfrog, dt, false) - exact),
              1e-3 * std::abs(spin_of_the_other(chosen::symplectic_euler, dt, false) - exact));
}

/// The largest |E + losses - E_0|/E_0 over a cloud that collides.
template <int Dim, class I>
double imbalance(double dt, auto... term)
{
    Simulation sim(dem<Dim>({.mass = 0.1, .radius = 0.01}, spring, term..., Dissipation{}), I{}, Open{}, Serial{},
                   Double{}, NoWatch{});
    scatter<Dim>(sim, {.side = 3}, 5);
    sim.make_lists_current();
    const Energy start = sim.energy();
    const double e0 = start.total();
    double most = 0;
    for (int k = 0; k < 60; ++k) {
        sim.run({.steps = std::llround(0.1 * t_c / dt), .dt = dt});
        sim.make_lists_current();
        const Energy e = sim.energy();
        most = std::max(most, std::abs(e.total() + e.dissipated - e0) / e0);
    }
    const Energy end = sim.energy();
    EXPECT_GE(end.dissipated, 0.02 * e0);
    EXPECT_GT(std::abs(end.rotational - start.rotational), 0.01 * start.rotational);
    return most;
}
// Kinetic, rotational, elastic (springs of each kind) and what was lost add up; what is missing is of first order in dt.
TEST(Friction, AccountsForAllEnergy)
{
    const auto all = std::tuple{dashpot, friction, RollingResistance{.mu = 0.1}};
    auto of_space = [&](double dt) {
        return std::apply([&](auto... t) { return imbalance<3, Leapfrog>(dt, t...); }, all);
    };
    auto of_plane = [&](double dt) { return imbalance<2, RungeKutta2>(dt, dashpot, friction); };
    const double space = of_space(t_c / 200), finer = of_space(t_c / 800);
    EXPECT_LE(space, 5e-3);
    EXPECT_LE(finer, 0.3 * space); // a quarter
    EXPECT_LE(of_plane(t_c / 200), 5e-3);
}
TEST(RollingResistance, ConservesAngularMomentum)
{
    Simulation sim(dem<3>(Mixture{.largest = 0.01}, spring, friction, RollingResistance{.mu = 0.2}), Leapfrog{}, Open{},
                   Serial{}, Double{}, NoWatch{});
    expect_conserved<3>(std::move(sim));
}

// Materials by pair: as if each pair were a scene of its own.
TEST(ByMaterial, GivesEachPairItsOwnLaw)
{
    const LinearSpring soft{.k = 2e4}, mixed{.k = 5e4}, hard{.k = 1e5};
    const Friction rough{.mu = 0.6}, between{.mu = 0.3}, smooth{.mu = 0.05};
    chosen::integrator = chosen::leapfrog;
    auto collide = [&](auto sim, double first, double second) {
        sim.add({0, 0}, {0.5, 0}), sim.add({0.0199, 0.004}, {-0.5, 0});
        auto& p = sim.particles();
        if constexpr (std::remove_cvref_t<decltype(p)>::template has<Material>)
            p.put(material, 0, first), p.put(material, 1, second);
        sim.prepare();
        sim.run({.steps = 300, .dt = 1e-5});
        const std::size_t i = p.id()[0] == 0 ? 0 : 1;
        return std::array{p.at(velocity, i)[0], p.at(velocity, i)[1], p.at(angular_velocity, i)[0],
                          sim.energy().total()};
    };
    auto of = [&](double a, double b) {
        return collide(Simulation(dem<2>({.mass = 0.1, .radius = 0.01}, by_material(soft, mixed, hard), dashpot,
                                         by_material(rough, between, smooth)),
                                  Leapfrog{}, Open{}, Serial{}, Double{}, NoWatch{}),
                       a, b);
    };
    EXPECT_EQ(of(0, 0), collide(discs(soft, dashpot, rough), 0, 0));
    EXPECT_EQ(of(1, 0), collide(discs(mixed, dashpot, between), 0, 0));
    EXPECT_EQ(of(0, 1), of(1, 0));
    EXPECT_EQ(of(1, 1), collide(discs(hard, dashpot, smooth), 0, 0));
    EXPECT_EQ((by_material(soft, mixed, hard).contact_frequency(0.1)), hard.contact_frequency(0.1));
}

// The stiffest contact of the lightest grain bounds the step.
TEST(Mixture, TakesItsStepFromTheLightestGrain)
{
    auto step = [](auto term, double lightest) {
        Simulation sim(dem<3>(Mixture{.largest = 0.01}, term), Leapfrog{}, Open{}, Serial{}, Double{}, NoWatch{});
        sim.add({0, 0, 0}), sim.add({0.1, 0, 0});
        auto& p = sim.particles();
        p.put(mass, 0, 0.1), p.put(mass, 1, lightest), p.put(radius, 0, 0.01), p.put(radius, 1, 0.005);
        sim.prepare();
        sim.run({.steps = 1});
        return sim.dt();
    };
    EXPECT_NEAR(step(spring, 0.01), std::numbers::pi / std::sqrt(2 * 1e5 / 0.01) / 25, 1e-12);
    // 0.15 of the Rayleigh time of glass, 5 mm: pi R sqrt(rho/G)/(0.1631 nu + 0.8766)
    const double R = 0.005, rho = 2800, nu = 0.2, G = 48e9 / 2.4;
    const double rayleigh = std::numbers::pi * R * std::sqrt(rho / G) / (0.1631 * nu + 0.8766);
    const double m = rho * 4.0 / 3 * std::numbers::pi * R * R * R;
    EXPECT_NEAR(step(Hertz::of({48e9, nu}), m) / (0.15 * rayleigh), 1, 1e-9);
}
// The tangential spring of a grain of micrometres is as long after it was turned as before, in float too.
TEST(Friction, TurnsSpringsOfSmallGrains)
{
    using F = Scalar<float>;
    const Vec<3, F> n{{0.6f, 0.0f, 0.8f}}, spring{{3e-13f, 4e-13f, 0.0f}};
    const Vec<3, F> now = turned(n, spring);
    EXPECT_NEAR(std::sqrt(double(now.squaredNorm().b)), 5e-13, 1e-18);
    EXPECT_NEAR(double(now.dot(n).b), 0, 1e-19);
}

} // namespace
