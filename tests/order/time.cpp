// SPDX-License-Identifier: BSD-3-Clause
// The order in time of every integrator on sound, whose density drifts by a rate of its own: against the exact solution
// of the lattice, so that only time is discrete.
#include "wave.hpp"

#include <gtest/gtest.h>

namespace {

using namespace wave;

/// Distance in (v, rho) from cos and sin of omega T, over the amplitude, after n steps.
template <class I>
double error(int n, double T, double omega)
{
    auto sim = standing<1, 2, I>(CubicSpline<2>{1.3});
    const Amplitude<1> amplitude(sim);
    sim.run({.steps = n, .dt = T / n});
    return std::hypot(amplitude.velocity(sim) - std::cos(omega * T), amplitude.density(sim) + std::sin(omega * T));
}

template <class I>
class TimeOrder : public testing::Test {};
using All = testing::Types<ForwardEuler, SymplecticEuler, Leapfrog, RungeKutta2>;
TYPED_TEST_SUITE(TimeOrder, All);

TYPED_TEST(TimeOrder, OfSoundIsThatOfTheIntegrator)
{
    const double omega = lattice::k_eff<2>(lattice::cubic<2>(), 1.3, {k0, 0, 0});
    const double T = 0.3 * N; // omega T = 1.9: neither errors of phase nor of amplitude vanish
    int n = 32;
    double last = error<TypeParam>(n, T, omega);
    for (int k = 1; k <= 5; ++k) {
        n *= 2;
        const double now = error<TypeParam>(n, T, omega), order = std::log2(last / now);
        EXPECT_NEAR(order, TypeParam::order, 0.1) << n << " steps, error " << now;
        this->RecordProperty("order_" + std::to_string(n), testing::PrintToString(order));
        last = now;
    }
}

} // namespace
