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
    choose(CubicSpline<2>{1.3}), choose(I{});
    auto sim = standing<2>(1, 2, 1.3);
    const Amplitude amplitude(1, sim);
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

/// Positions, velocities and densities (over rho0) by id, after n steps of a wave of finite amplitude.
template <class I>
std::vector<double> state(int n, double T)
{
    choose(CubicSpline<2>{1.3}), choose(I{});
    auto sim = standing<2>(1, 2, 1.3, 0.1);
    sim.run({.steps = n, .dt = T / n});
    auto const& p = sim.particles();
    std::vector<double> y(5 * p.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
        double* const mine = &y[5 * p.id()[i]];
        for (int c = 0; c < 2; ++c) mine[c] = p.at(position, i)[c], mine[2 + c] = p.at(velocity, i)[c];
        mine[4] = p.at(density, i) / rho0;
    }
    return y;
}
double distance(std::vector<double> const& a, std::vector<double> const& b)
{
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        const double d = k % 5 < 2 ? std::remainder(a[k] - b[k], k % 5 == 0 ? N : rows(1.3)) : a[k] - b[k]; // of images
        sum += d * d;
    }
    return std::sqrt(sum);
}
// Particles move by half a spacing here: where a rate is taken matters, not only when.
TYPED_TEST(TimeOrder, OfAWaveOfFiniteAmplitudeIsThatOfTheIntegrator)
{
    const double T = 0.3 * N;
    std::vector<std::vector<double>> y;
    for (int n = 64; n <= 1024; n *= 2) y.push_back(state<TypeParam>(n, T));
    for (std::size_t k = 0; k + 2 < y.size(); ++k) {
        const double order = std::log2(distance(y[k], y[k + 1]) / distance(y[k + 1], y[k + 2]));
        EXPECT_NEAR(order, TypeParam::order, 0.1) << "level " << k;
        this->RecordProperty("order_" + std::to_string(k), testing::PrintToString(order));
    }
}

} // namespace
