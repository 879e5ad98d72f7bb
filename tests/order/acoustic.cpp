// SPDX-License-Identifier: BSD-3-Clause
// Sound on a lattice: density and momentum form the oscillator d rho/dt = -rho0 k_eff v, dv/dt = c0^2 k_eff rho / rho0,
// whose frequency is the lattice sum k_eff and whose dispersion in time is that of the integrator alone.
#include "wave.hpp"

#include <gtest/gtest.h>

namespace {

using namespace wave;

double in_table(std::string const& kernel, int dim, double h)
{
    return k0 * (1 + lattice::table("kernel_lattice_constants.csv", kernel, dim, h, "keff_rel_N32"));
}

constexpr double dt = 0.5; // z = c0 k dt = 0.1: the integrators' phase errors are 4e-4 and -2e-3, well above 1e-5
constexpr double periods = 10;

template <class I>
class Sound : public testing::Test {
protected:
    /// omega of a fit against that of the oscillator under the integrator's own map.
    static void expect(wave::Oscillation const& o, double omega)
    {
        const double z = omega * dt;
        double theta = 2 * std::asin(z / 2), growth = 0; // leapfrog
        if constexpr (std::same_as<I, RungeKutta2>) {
            theta = std::atan2(z, 1 - z * z / 2);
            growth = 0.5 * std::log1p(z * z * z * z / 4);
        }
        EXPECT_NEAR(o.theta / theta, 1, 1e-5);
        EXPECT_NEAR(o.growth, growth, 1e-3 * z * z * z * z / 8);
        RecordProperty("omega_error", testing::PrintToString(o.theta / theta - 1));
        RecordProperty("growth_error", testing::PrintToString(o.growth - growth));
    }
    static void RecordProperty(std::string const& name, std::string const& value)
    {
        testing::Test::RecordProperty(name, value);
    }
};
using Integrators = testing::Types<Leapfrog, RungeKutta2>;
TYPED_TEST_SUITE(Sound, Integrators);

TYPED_TEST(Sound, CubicSplineAt1_3)
{
    this->expect(measured<TypeParam>(1, 2, CubicSpline<2>{1.3}, dt, k0, periods), in_table("cubic", 2, 1.3));
}
TYPED_TEST(Sound, CubicSplineAt1_2)
{
    this->expect(measured<TypeParam>(1, 2, CubicSpline<2>{1.2}, dt, k0, periods), in_table("cubic", 2, 1.2));
}
TYPED_TEST(Sound, WendlandC2At2)
{
    this->expect(measured<TypeParam>(1, 2, WendlandC2<2>{2.0}, dt, k0, periods), in_table("wc2", 2, 2.0));
}
TYPED_TEST(Sound, Diagonal)
{
    const double omega = lattice::k_eff<2>(lattice::cubic<2>(), 1.3, {k0, k0, 0});
    EXPECT_GT(std::abs(omega / (std::sqrt(2.0) * k0) - 1), 1e-3); // neither the continuum's nor that along x
    this->expect(measured<TypeParam>(2, 2, CubicSpline<2>{1.3}, dt, omega, periods), omega);
}
TEST(Sound3d, WendlandC2At1_5)
{
    const double omega = in_table("wc2", 3, 1.5);
    const auto o = measured<Leapfrog>(1, 2, WendlandC2<3>{1.5}, dt, k0, periods);
    EXPECT_NEAR(o.theta / (2 * std::asin(omega * dt / 2)), 1, 1e-5);
    RecordProperty("omega_error", testing::PrintToString(o.theta / (2 * std::asin(omega * dt / 2)) - 1));
}
// On a lattice at rest density the sigma family is one scheme.
TEST(Sound2d, DoesNotDependOnSigma)
{
    const auto one = measured<Leapfrog>(1, 1, CubicSpline<2>{1.3}, dt, k0, periods);
    const auto two = measured<Leapfrog>(1, 2, CubicSpline<2>{1.3}, dt, k0, periods);
    EXPECT_NEAR(one.theta / two.theta, 1, 1e-6);
    RecordProperty("difference", testing::PrintToString(one.theta / two.theta - 1));
}
TEST(Lattice, SumsAreThoseOfTheTable)
{
    for (double h : {1.0, 1.2, 1.3, 1.5, 2.0}) {
        EXPECT_NEAR(lattice::k_eff<2>(lattice::cubic<2>(), h, {k0, 0, 0}), in_table("cubic", 2, h), 1e-11);
        EXPECT_NEAR(lattice::k_eff<2>(lattice::wendland_c2<2>(), h, {k0, 0, 0}), in_table("wc2", 2, h), 1e-11);
        EXPECT_NEAR(lattice::k_eff<3>(lattice::wendland_c2<3>(), h, {k0, 0, 0}), in_table("wc2", 3, h), 1e-11);
        EXPECT_NEAR(lattice::k_eff<3>(lattice::cubic<3>(), h, {k0, 0, 0}), in_table("cubic", 3, h), 1e-11);
    }
}

/// Whether noise of all wavelengths stays small.
bool bounded(double step)
{
    choose(CubicSpline<2>{1.3}), choose(Leapfrog{});
    auto sim = standing<2>(2, 2, 1.3);
    auto& p = sim.particles();
    std::uint64_t state = 1;
    for (std::size_t i = 0; i < p.size(); ++i) {
        Vec<2, double> v{};
        for (int c = 0; c < 2; ++c) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            v[c] = 1e-8 * (double(state >> 11) / double(std::uint64_t(1) << 53) - 0.5);
        }
        p.put(velocity, i, v);
    }
    sim.prepare();
    double fastest = 0;
    for (int k = 0; k < 10 && fastest < 1e-3; ++k) {
        try {
            sim.run({.steps = 40, .dt = step});
        }
        catch (Stop const&) { // grew until a step outran the lists
            return false;
        }
        fastest = 0;
        for (std::size_t i = 0; i < p.size(); ++i)
            fastest = std::max(fastest, std::sqrt(p.at(velocity, i).squaredNorm()));
    }
    return fastest < 1e-6;
}
// The stiffest wave of the lattice has omega = kappa c0 / h; leapfrog stands omega dt = 2.
TEST(Sound2d, LeapfrogIsStableToTwoOverKappa)
{
    const double exact = 2 * 1.3 / lattice::table("kernel_stability_constants.csv", "cubic", 2, 1.3, "kappa");
    double low = 0.8 * exact, high = 1.2 * exact;
    EXPECT_TRUE(bounded(low));
    EXPECT_FALSE(bounded(high));
    for (int k = 0; k < 6; ++k) {
        const double middle = 0.5 * (low + high);
        (bounded(middle) ? low : high) = middle;
    }
    EXPECT_NEAR(0.5 * (low + high), exact, 0.02 * exact);
    RecordProperty("limit", testing::PrintToString(0.5 * (low + high) / exact));
}

} // namespace
