// SPDX-License-Identifier: BSD-3-Clause
// Laws of every integrator, on bodies in a harmonic trap: a particle term of this file alone, without pairs.
#include "spate/spate.hpp"

#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace spate;

/// dv/dt = -omega^2 x - lambda v.
struct Trap {
    static constexpr Fields reads{position, velocity};
    static constexpr Fields adds{acceleration};
    double omega;  ///< [1/s]
    double lambda; ///< drag [1/s]
    void operator()(auto& i) const
    {
        i[acceleration] -= (omega * omega) * i[position];
        i[acceleration] -= lambda * i[velocity];
    }
};

constexpr double roomy = 1e6; // a range of which no body covers the skin: no list is rebuilt

template <class I>
auto trapped(Trap trap)
{
    return Simulation(physics(Round<2>{roomy}, trap), I{}, Open{}, Serial{}, Double{}, NoWatch{});
}

struct Body {
    Vec<2, double> x, v;
};
std::vector<Body> bodies(int count)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<Body> all;
    for (int k = 0; k < count; ++k) all.push_back({{{u(random), u(random)}}, {{u(random), u(random)}}});
    return all;
}

/// Root mean square distance in (x, v/omega) from the exact solution at time T after n steps.
template <class I>
double error(int n, double T)
{
    const double omega = 3;
    auto sim = trapped<I>({omega, 0});
    const auto start = bodies(20);
    for (auto const& b : start) sim.add(b.x, b.v);
    sim.run({.steps = n, .dt = T / n});
    const double c = std::cos(omega * T), s = std::sin(omega * T);
    double sum = 0;
    auto const& p = sim.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        auto const& b = start[p.id()[i]];
        const auto x = c * b.x + (s / omega) * b.v, v = c * b.v - (omega * s) * b.x;
        sum += (p.at(position, i) - x).squaredNorm() + (p.at(velocity, i) - v).squaredNorm() / (omega * omega);
    }
    return std::sqrt(sum / double(p.size()));
}

/// One body, started at (x, v), after n steps of dt.
template <class I>
Body after(Trap trap, Body start, double dt, std::int64_t n)
{
    auto sim = trapped<I>(trap);
    sim.add(start.x, start.v);
    sim.run({.steps = n, .dt = dt});
    return {sim.particles().at(position, 0), sim.particles().at(velocity, 0)};
}
/// Whether a body from (1, 0) at unit speed stays near.
template <class I>
bool bounded(Trap trap, double dt)
{
    try {
        const Body b = after<I>(trap, {{{1, 0}}, {{1, 0}}}, dt, 4000);
        return b.x.squaredNorm() + b.v.squaredNorm() < 1e12; // and not NaN
    }
    catch (IndexOverflow const&) { // so far away that it has no cell
        return false;
    }
}
/// The largest stable step by bisection, in units of 1/rate; an unstable one grows 1e6-fold within the steps of a trial.
double limit(auto const& stable)
{
    double low = 0.5, high = 4;
    for (int k = 0; k < 14; ++k) {
        const double middle = 0.5 * (low + high);
        (stable(middle) ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

template <class I>
class IntegratorLaw : public testing::Test {};
using All = testing::Types<ForwardEuler, SymplecticEuler, Leapfrog, RungeKutta2>;
TYPED_TEST_SUITE(IntegratorLaw, All);

template <class I>
class SymplecticLaw : public testing::Test {};
using Symplectic = testing::Types<SymplecticEuler, Leapfrog>;
TYPED_TEST_SUITE(SymplecticLaw, Symplectic);

template <class I>
class GrowingLaw : public testing::Test {};
using Growing = testing::Types<ForwardEuler, RungeKutta2>;
TYPED_TEST_SUITE(GrowingLaw, Growing);

TYPED_TEST(IntegratorLaw, ErrorFallsWithItsOrder)
{
    const double T = 0.7; // no whole or half period, where errors of phase or of amplitude vanish
    int n = 64;
    double last = error<TypeParam>(n, T);
    for (int k = 1; k <= 5; ++k) {
        n *= 2;
        const double now = error<TypeParam>(n, T);
        EXPECT_NEAR(std::log2(last / now), TypeParam::order, 0.1) << n << " steps, error " << now;
        last = now;
    }
    this->RecordProperty("finest_error", std::to_string(last));
}

TYPED_TEST(IntegratorLaw, DecayIsStableToItsRealLimit)
{
    const double lambda = 5;
    const double reached = limit([&](double z) { return bounded<TypeParam>({0, lambda}, z / lambda); });
    EXPECT_NEAR(reached, TypeParam::real_limit, 0.02 * TypeParam::real_limit);
    this->RecordProperty("limit", std::to_string(reached));
}

TYPED_TEST(IntegratorLaw, ABodyWithoutForceMovesInAStraightLine)
{
    const Body b = after<TypeParam>({0, 0}, {{{1, -2}}, {{0.5, 0.25}}}, 0.125, 1000); // dyadic: no rounding at all
    EXPECT_EQ(b.x, (Vec<2, double>{{1 + 0.5 * 125, -2 + 0.25 * 125}}));
    EXPECT_EQ(b.v, (Vec<2, double>{{0.5, 0.25}}));
}

TYPED_TEST(SymplecticLaw, OscillationIsStableToItsImaginaryLimit)
{
    const double omega = 3;
    const double reached = limit([&](double z) { return bounded<TypeParam>({omega, 0}, z / omega); });
    EXPECT_NEAR(reached, TypeParam::imaginary_limit, 0.02 * TypeParam::imaginary_limit);
    this->RecordProperty("limit", std::to_string(reached));
}

// With z = omega dt, the maps conserve v^2 + (omega x)^2 - z v omega x (symplectic Euler, from its matrix) and
// v^2 + (1 - z^2/4) (omega x)^2 (velocity Verlet): energy is bounded up to z = 2, not just close to it for small z.
TYPED_TEST(SymplecticLaw, ModifiedEnergyIsConserved)
{
    const double omega = 3;
    for (double z : {0.1, 1.0, 1.9}) {
        auto modified = [&](Body const& b) {
            const auto wx = omega * b.x;
            if constexpr (std::same_as<TypeParam, SymplecticEuler>)
                return b.v.squaredNorm() + wx.squaredNorm() - z * b.v.dot(wx);
            else return b.v.squaredNorm() + (1 - z * z / 4) * wx.squaredNorm();
        };
        const Body start{{{1, 0.5}}, {{-1, 2}}};
        for (int n : {1, 10, 1000, 100'000}) {
            const double now = modified(after<TypeParam>({omega, 0}, start, z / omega, n));
            EXPECT_NEAR(now / modified(start), 1, 1e-14 * n + 1e-13) << "z " << z << ", " << n << " steps";
        }
        EXPECT_EQ(TypeParam::growth(z), 0);
    }
}

// |R|^2 = 1 + z^2 and 1 + z^4/4 on the imaginary axis.
TYPED_TEST(GrowingLaw, AmplitudeGrowsAsStated)
{
    const double omega = 3;
    const int n = 1000;
    EXPECT_EQ(TypeParam::imaginary_limit, 0);
    for (double z : {0.05, 0.1, 0.2}) {
        const Body b = after<TypeParam>({omega, 0}, {{{1, 0}}, {}}, z / omega, n);
        const double grown = 0.5 * std::log(b.x.squaredNorm() + b.v.squaredNorm() / (omega * omega)) / n;
        const double r2 = std::same_as<TypeParam, ForwardEuler> ? 1 + z * z : 1 + z * z * z * z / 4;
        EXPECT_NEAR(grown, 0.5 * std::log(r2), 1e-15) << "z " << z;
        EXPECT_NEAR(grown / TypeParam::growth(z), 1, z * z) << "z " << z; // growth() is the leading term
    }
}

// The phase of a step: R = 1 + i z and (1 - z^2/2) + i z; cos theta = 1 - z^2/2 for the symplectic ones.
TYPED_TEST(IntegratorLaw, PhaseIsThatOfItsMatrix)
{
    const double omega = 3, z = 0.4;
    const int n = 100;
    const Body b = after<TypeParam>({omega, 0}, {{{1, 0}}, {}}, z / omega, n);
    double x = 0;
    if constexpr (std::same_as<TypeParam, ForwardEuler>) x = std::pow(std::complex(1.0, z), n).real();
    else if constexpr (std::same_as<TypeParam, RungeKutta2>) x = std::pow(std::complex(1 - z * z / 2, z), n).real();
    else {
        const double theta = std::acos(1 - z * z / 2);
        x = std::cos(n * theta);
        if constexpr (std::same_as<TypeParam, SymplecticEuler>) // trace 2 - z^2, first step x1 = 1 - z^2
            x -= std::tan(theta / 2) * std::sin(n * theta);
    }
    EXPECT_NEAR(b.x[0], x, 1e-12 * std::max(1.0, std::abs(x)));
}

} // namespace
