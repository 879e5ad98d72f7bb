// SPDX-License-Identifier: BSD-3-Clause
// Linear theory at the start of a run: symbols of the lattice, and what a scene is warned of.
#include <spate/spate.hpp>

#include <gtest/gtest.h>

namespace {
using namespace spate;

template <template <int> class K, int Dim>
WorstWave wave(double h, double mu)
{
    const auto water = wcsph(K<Dim>{.h = h}, LinearEos{.rho0 = 1000, .c0 = 1}, Continuity<2>{}, PressureForce<2>{},
                             LaminarViscosity{.mu = mu});
    return worst_wave(water, 1, 1, &RungeKutta2::growth);
}
// data/kernel_stability_constants.csv, rows of h/dx: kappa = h max |k_eff|, Lambda = h^2 max decay / nu. The csv searches all
// directions, worst_wave the axis and the diagonals at 96 wavelengths: it may miss the maximum by 1e-3.
TEST(WorstWave, HasTheSymbolsOfTheLattice)
{
    const auto w2 = wave<CubicSpline, 2>(1.3, 1000);
    EXPECT_NEAR(w2.frequency * 1.3, 1.0709, 1.1e-3);
    EXPECT_NEAR(w2.decay * 1.3 * 1.3, 5.667, 6e-3);
    const auto w3 = wave<CubicSpline, 3>(1.3, 1000);
    EXPECT_NEAR(w3.frequency * 1.3, 1.0895, 1.1e-3);
    EXPECT_NEAR(w3.decay * 1.3 * 1.3, 5.971, 6e-3);
    const auto c2 = wave<WendlandC2, 2>(2.0, 1000);
    EXPECT_NEAR(c2.frequency * 2, 1.1355, 1.2e-3);
    EXPECT_NEAR(c2.decay * 4, 6.610, 7e-3);
}
// Without damping RK2 lets amplitudes grow by (kappa C)^4 / 8 a step (Courant number C = c0 dt / h).
TEST(WorstWave, GrowsAsTheIntegratorSays)
{
    const double C = 0.25, h = 1.3, dt = C * h;
    const auto water =
        wcsph(CubicSpline<2>{.h = h}, LinearEos{.rho0 = 1000, .c0 = 1}, Continuity<2>{}, PressureForce<2>{});
    const auto w = worst_wave(water, 1, dt, &RungeKutta2::growth);
    const double expected = std::pow(1.0709 * C, 4) / 8;
    EXPECT_NEAR(w.net_growth * dt, expected, 0.01 * expected);
    EXPECT_EQ(worst_wave(water, 1, dt, &Leapfrog::growth).net_growth, 0);
}

template <class I>
std::vector<std::string> warnings(I integrator, double alpha, double cfl)
{
    const double dx = 0.05;
    Simulation s(wcsph(CubicSpline<2>{.h = 1.3 * dx}, LinearEos{.rho0 = 1000, .c0 = 10}, Continuity<2>{},
                       PressureForce<2>{}, ArtificialViscosity{.alpha = alpha}),
                 integrator, Periodic(Box<2>{{0, 0}, {1, 1}}));
    s.fill(Box<2>{{0, 0}, {1, 1}}, dx);
    s.run({.steps = 1, .cfl = cfl});
    return s.report().warnings;
}
TEST(Advice, WarnsOfSoundThatOutgrowsItsDamping)
{
    ASSERT_EQ(warnings(RungeKutta2{}, 0.0, 0.25).size(), 1u);
    EXPECT_NE(warnings(RungeKutta2{}, 0.0, 0.25)[0].find("grow e-fold"), std::string::npos);
    EXPECT_TRUE(warnings(RungeKutta2{}, 0.03, 0.25).empty()); // twice the critical alpha
    EXPECT_TRUE(warnings(Leapfrog{}, 0.0, 0.25).empty());
    EXPECT_EQ(warnings(ForwardEuler{}, 0.0, 0.25).size(), 1u);
}
TEST(Advice, WarnsAboveTheAcousticLimit)
{
    const auto w = warnings(Leapfrog{}, 0.0, 1.9); // the limit is 2 / kappa = 1.868
    ASSERT_EQ(w.size(), 1u);
    EXPECT_NE(w[0].find("acoustic limit"), std::string::npos);
    EXPECT_TRUE(warnings(Leapfrog{}, 0.0, 1.8).empty());
}
// 2 h / (kappa c0) of leapfrog, 2 / omega of a contact; a scheme that grows at any step has none.
TEST(Advice, KnowsTheMarginOfTheFirstStep)
{
    auto stable = [](auto integrator) {
        const double dx = 0.05;
        Simulation s(wcsph(CubicSpline<2>{.h = 1.3 * dx}, LinearEos{.rho0 = 1000, .c0 = 10}, Continuity<2>{},
                           PressureForce<2>{}, ArtificialViscosity{.alpha = 0}),
                     integrator, Periodic(Box<2>{{0, 0}, {1, 1}}));
        s.fill(Box<2>{{0, 0}, {1, 1}}, dx);
        s.run({.steps = 1});
        return s.report().stable;
    };
    const double exact = 2 / 1.070858 * 1.3 * 0.05 / 10; // kernel_stability_constants.csv
    EXPECT_NEAR(stable(Leapfrog{}).dt, exact, 1.1e-3 * exact);
    EXPECT_EQ(stable(Leapfrog{}).criterion, "acoustic");
    EXPECT_TRUE(std::isinf(stable(RungeKutta2{}).dt));
    Simulation grains(dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}), SymplecticEuler{}, Open{});
    grains.add({0, 0});
    grains.run({.steps = 1});
    EXPECT_NEAR(grains.report().stable.dt / grains.dt(), 50 / std::numbers::pi, 1e-9); // 2 / omega over pi / (25 omega)
}
// Forward Euler and the midpoint rule leave no stretch of the imaginary axis stable, so what oscillates has to be damped.
TEST(Advice, KnowsWithoutRunningWhatNoStepMakesStable)
{
    auto unstable = [](auto integrator, auto const&... term) {
        using P =
            decltype(wcsph(CubicSpline<2>{.h = 0.1}, LinearEos{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, term...));
        return unstable_at_every_step<P, decltype(integrator)>;
    };
    EXPECT_TRUE(unstable(RungeKutta2{}, PressureForce<2>{}));
    EXPECT_TRUE(unstable(ForwardEuler{}, PressureForce<2>{}, Gravity<2>{{0, -9.81}}));
    EXPECT_FALSE(unstable(RungeKutta2{}, Gravity<2>{{0, -9.81}})); // no pressure pushes: there is no sound
    EXPECT_TRUE(unstable(RungeKutta2{}, GradientCorrection{}, CorrectedPressureForce{}));
    EXPECT_FALSE(unstable(RungeKutta2{}, PressureForce<2>{}, ArtificialViscosity{}));
    EXPECT_FALSE(unstable(RungeKutta2{}, PressureForce<2>{}, DensityDiffusion{}));
    EXPECT_FALSE(unstable(ForwardEuler{}, PressureForce<2>{}, LaminarViscosity{}));
    EXPECT_FALSE(unstable(Leapfrog{}, PressureForce<2>{}));
    EXPECT_FALSE(unstable(SymplecticEuler{}, PressureForce<2>{}));

    const Grain grain{.mass = 0.1, .radius = 0.01};
    using Elastic = decltype(dem<2>(grain, LinearSpring{.k = 1e5}));
    using Damped = decltype(dem<2>(grain, LinearSpring{.k = 1e5}, Dashpot{.e = 0.9}));
    EXPECT_TRUE((unstable_at_every_step<Elastic, ForwardEuler>));
    EXPECT_FALSE((unstable_at_every_step<Damped, ForwardEuler>));
    EXPECT_FALSE((unstable_at_every_step<Elastic, SymplecticEuler>));

    EXPECT_NE(warnings(RungeKutta2{}, 0.0, 0.25)[0].find("take a smaller cfl"), std::string::npos);
}
template <class I>
std::vector<std::string> contact_warnings(I integrator, double dt)
{
    Simulation s(dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}), integrator, Open{});
    s.add({0, 0});
    s.add({0.1, 0});
    s.run({.steps = 1, .dt = dt});
    return s.report().warnings;
}
TEST(Advice, WarnsOfContactsThatGrowOrAreUnderResolved)
{
    const double contact_time = 2.2214415e-3; // pi sqrt(m / 2k)
    const auto grows = contact_warnings(ForwardEuler{}, contact_time / 100);
    ASSERT_EQ(grows.size(), 1u);
    EXPECT_NE(grows[0].find("no dt is stable"), std::string::npos);
    EXPECT_TRUE(contact_warnings(SymplecticEuler{}, contact_time / 11).empty());
    const auto w = contact_warnings(SymplecticEuler{}, contact_time / 9);
    ASSERT_EQ(w.size(), 1u);
    EXPECT_NE(w[0].find("under-resolved"), std::string::npos);
}
} // namespace
