// SPDX-License-Identifier: BSD-3-Clause
// Corrected terms are exact for linear fields on any particles, at the rim of a cluster too; the viscosity also for quadratic
// ones on a lattice; shifting that takes fields along leaves a linear field what it is.
#include "oracle/dice.hpp"

#include <spate/spate.hpp>

#include <gtest/gtest.h>

namespace {
using namespace spate;

constexpr double dx = 0.02, rho0 = 1000, c0 = 10, mu = 3, slope = 40;

/// v = A x and rho = rho0 + slope (x + 2 y [+ 3 z]).
template <int Dim>
struct Linear {
    std::array<Vec<Dim, double>, std::size_t(Dim)> A;
    Vec<Dim, double> G{};
    Linear()
    {
        for (int r = 0; r < Dim; ++r)
            for (int c = 0; c < Dim; ++c) A[std::size_t(r)][c] = 1 + r + 0.3 * c * c;
        for (int c = 0; c < Dim; ++c) G[c] = slope * (c + 1);
    }
    [[nodiscard]] Vec<Dim, double> velocity(Vec<Dim, double> const& x) const
    {
        Vec<Dim, double> v{};
        for (int r = 0; r < Dim; ++r) v[r] = A[std::size_t(r)].dot(x);
        return v;
    }
    [[nodiscard]] double divergence() const
    {
        double sum = 0;
        for (int c = 0; c < Dim; ++c) sum += A[std::size_t(c)][c];
        return sum;
    }
};

/// A jittered cluster. \param set  gives a particle its velocity and density
template <int Dim, class... T>
auto cluster_of(double jitter, auto const& set, T... term)
{
    Box<Dim> box{};
    for (int c = 0; c < Dim; ++c) box.hi[c] = (Dim == 2 ? 16 : 8) * dx;
    Simulation s(wcsph(WendlandC2<Dim>{.h = 1.6 * dx}, LinearEos{.rho0 = rho0, .c0 = c0}, GradientCorrection{},
                       CorrectedContinuity{}, term...),
                 SymplecticEuler{}, Open{});
    oracle::Dice dice(5);
    s.fill(box, dx, [&](auto& p, std::size_t i) {
        auto x = p.at(position, i);
        for (int c = 0; c < Dim; ++c) x[c] += jitter * dx * dice.real(-1, 1);
        p.put(position, i, x);
        set(p, i, x);
    });
    return s;
}
/// With the linear fields, jittered by a fifth.
template <int Dim, class... T>
auto cluster(T... term)
{
    auto linear = [of = Linear<Dim>{}](auto& p, std::size_t i, auto const& x) {
        p.put(velocity, i, of.velocity(x));
        p.put(density, i, rho0 + of.G.dot(x));
    };
    return cluster_of<Dim>(0.2, linear, term...);
}
template <class Scene>
auto const& rates_of(Scene& s)
{
    s.system().rebuild();
    s.system().rates(s.system().all);
    return s.particles();
}
// Rounding: p = c0^2 (rho - rho0) loses rho0 / (slope dx), a factor of 1e3, and sums of 20 to 60 terms.
constexpr double tolerance = 1e-10;

template <int Dim>
void expect_exact()
{
    const Linear<Dim> linear;
    auto s = cluster<Dim>(CorrectedPressureForce{});
    auto const& p = rates_of(s);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto a = -c0 * c0 / p.at(density, i) * linear.G;
        ASSERT_LT(std::sqrt((p.at(acceleration, i) - a).squaredNorm()), tolerance * std::sqrt(a.squaredNorm())) << i;
        const double rate = -p.at(density, i) * linear.divergence();
        ASSERT_NEAR(p.at(density_rate, i), rate, tolerance * std::abs(rate)) << i;
    }
}
TEST(GradientCorrection, IsExactForLinearFieldsInThePlane) { expect_exact<2>(); }
TEST(GradientCorrection, IsExactForLinearFieldsInSpace) { expect_exact<3>(); }

double largest_acceleration(auto const& p)
{
    double most = 0;
    for (std::size_t i = 0; i < p.size(); ++i) most = std::max(most, std::sqrt(p.at(acceleration, i).squaredNorm()));
    return most;
}
TEST(CorrectedViscosity, IsNothingWhereVelocityIsLinear)
{
    auto plain = cluster<2>(LaminarViscosity{.mu = mu, .eps = 0});
    auto corrected = cluster<2>(CorrectedViscosity{.mu = mu});
    const double without = largest_acceleration(rates_of(plain));
    EXPECT_GT(without, 1e-3);
    EXPECT_LT(largest_acceleration(rates_of(corrected)), tolerance * without);
}
TEST(CorrectedViscosity, IsExactForQuadraticVelocityOnALattice)
{
    auto quadratic = [](auto& p, std::size_t i, auto const& x) {
        p.put(velocity, i, {x[1] * x[1], 3 * x[0] * x[0]});
        p.put(density, i, rho0);
    };
    auto s = cluster_of<2>(0, quadratic, CorrectedViscosity{.mu = mu});
    auto const& p = rates_of(s);
    int inside = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto x = p.at(position, i);
        if (std::max(std::abs(x[0] - 8 * dx), std::abs(x[1] - 8 * dx)) > 4 * dx) continue; // sees the rim
        ++inside;
        ASSERT_NEAR(p.at(acceleration, i)[0], 2 * mu / rho0, tolerance * 2 * mu / rho0);
        ASSERT_NEAR(p.at(acceleration, i)[1], 6 * mu / rho0, tolerance * 6 * mu / rho0);
    }
    EXPECT_GT(inside, 30);
}
// In a step so short that nothing else moves.
template <class S>
double off_after_a_step(S shifting)
{
    const Linear<2> linear;
    auto s = cluster<2>(shifting);
    std::vector<Vec<2, double>> before(s.particles().size());
    for (std::size_t i = 0; i < before.size(); ++i) before[s.particles().id()[i]] = s.particles().at(position, i);
    s.run({.steps = 1, .dt = 1e-14});
    double moved = 0, off = 0;
    auto const& p = s.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto x = p.at(position, i);
        moved = std::max(moved, std::sqrt((x - before[p.id()[i]]).squaredNorm()));
        off = std::max(off, std::sqrt((p.at(velocity, i) - linear.velocity(x)).squaredNorm()));
        off = std::max(off, std::abs(p.at(density, i) - rho0 - linear.G.dot(x)) / slope);
    }
    EXPECT_GT(moved, 1e-3 * dx);
    return off / moved;
}
TEST(ConsistentShifting, LeavesLinearFieldsWhatTheyAre)
{
    EXPECT_GT(off_after_a_step(Shifting{.mach = 0.1, .cfl = 0.25}), 0.1);
    EXPECT_LT(off_after_a_step(ConsistentShifting{.mach = 0.1, .cfl = 0.25}), 1e-9); // 1e3 dx / moved of rounding
}
} // namespace
