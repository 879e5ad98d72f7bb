// SPDX-License-Identifier: BSD-3-Clause
// Undamped spring contacts under each integrator: how long, how deep, and what energy comes out of a collision.
#include "spate/spate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace spate;

// The granular deck of the seed: k = 1e5 N/m, m = 0.1 kg, r = 0.01 m; a contact of two has omega = sqrt(2 k/m).
constexpr double k = 1e5, m = 0.1, r = 0.01, speed = 1;
const double omega = std::sqrt(2 * k / m);

/// Pairs of discs far from each other that meet head on, each at `speed`/2, the gap of pair number n of N such that
/// the overlap at the first step in contact is u speed dt, u = (n + 1/2)/N.
template <class I>
auto collisions(int pairs, double dt)
{
    const double height = 4 * r * (pairs + 2);
    const Box<2> box{{{-0.5, 0}}, {{0.5, height}}};
    auto discs = dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k});
    Simulation sim(discs, I{}, Periodic(box), Serial{}, Double{}, NoWatch{});
    for (int n = 0; n < pairs; ++n) {
        const double gap = (1 - (n + 0.5) / pairs) * speed * dt, y = 4 * r * (n + 1);
        sim.add({{-r - gap / 2, y}}, {{speed / 2, 0}});
        sim.add({{r + gap / 2, y}}, {{-speed / 2, 0}});
    }
    return sim;
}
/// Overlap and speed of approach of each pair.
struct Pair {
    double overlap = 0, approach = 0;
};
std::vector<Pair> pairs_of(auto const& sim)
{
    auto const& p = sim.particles();
    std::vector<double> x(p.size()), v(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) x[p.id()[i]] = p.at(position, i)[0], v[p.id()[i]] = p.at(velocity, i)[0];
    std::vector<Pair> all;
    for (std::size_t n = 0; n < x.size(); n += 2) all.push_back({2 * r - (x[n + 1] - x[n]), v[n] - v[n + 1]});
    return all;
}
/// E1/E0 of each of many collisions, by the phase u of its entry.
template <class I>
std::vector<double> energy_ratios(double dt, int pairs)
{
    auto sim = collisions<I>(pairs, dt);
    sim.run({.steps = std::int64_t(2 * std::numbers::pi / (omega * dt)) + 6, .dt = dt}); // twice a contact
    std::vector<double> ratio;
    for (auto const& p : pairs_of(sim)) {
        EXPECT_LT(p.overlap, 0);
        EXPECT_LT(p.approach, 0);
        ratio.push_back(p.approach * p.approach / (speed * speed));
    }
    return ratio;
}
double mean(std::vector<double> const& x)
{
    double sum = 0;
    for (double y : x) sum += y;
    return sum / double(x.size());
}
constexpr int phases = 1000;

TEST(Contact, LastsAndReachesAsTheoryHasIt)
{
    const double t_c = std::numbers::pi / omega, dt = t_c / 50, gap = 0.5 * speed * dt;
    auto sim = collisions<Leapfrog>(1, dt);
    std::vector<double> overlap{-gap};
    while (overlap.size() < 100) {
        sim.run({.steps = 1, .dt = dt});
        overlap.push_back(pairs_of(sim)[0].overlap);
    }
    const auto deepest = std::max_element(overlap.begin(), overlap.end());
    const double a = deepest[-1], b = deepest[0], c = deepest[1];
    const double reached = b + (c - a) * (c - a) / (8 * (2 * b - a - c)); // of the parabola through three samples
    const double end = sim.time() + overlap.back() / -pairs_of(sim)[0].approach; // free flight on both sides of it
    const double duration = end - gap / speed;
    EXPECT_NEAR(reached / (speed / omega), 1, 1e-3);
    EXPECT_NEAR(duration / t_c, 1, 1e-3);
    RecordProperty("depth_error", testing::PrintToString(reached * omega / speed - 1));
    RecordProperty("duration_error", testing::PrintToString(duration / t_c - 1));
}

// omega dt = sqrt 2, the seed's own step: exit speed 5 + 2u for u >= 0.2, else 7 - 8u, under forward Euler.
TEST(Contact, ForwardEulerExplodesAsCalculated)
{
    const auto e = energy_ratios<ForwardEuler>(1e-3, phases);
    for (int n = 0; n < phases; ++n) {
        const double u = (n + 0.5) / phases, v = u >= 0.2 ? 5 + 2 * u : 7 - 8 * u;
        ASSERT_NEAR(e[std::size_t(n)] / (v * v), 1, 1e-9) << "entry phase " << u;
    }
    EXPECT_NEAR(mean(e), 38.65, 0.005);
    RecordProperty("mean", testing::PrintToString(mean(e)));
}
TEST(Contact, ForwardEulerGainsAtEveryStep)
{
    EXPECT_NEAR(mean(energy_ratios<ForwardEuler>(5e-4, phases)), 7.943, 0.0005);
    EXPECT_NEAR(mean(energy_ratios<ForwardEuler>(2e-4, phases)), 2.404, 0.0005);
    EXPECT_NEAR(mean(energy_ratios<ForwardEuler>(5e-5, phases)), 1.2485, 0.00005);
}
TEST(Contact, RungeKutta2GainsLess)
{
    EXPECT_NEAR(mean(energy_ratios<RungeKutta2>(1e-3, phases)), 3.407, 0.0005);
    EXPECT_NEAR(mean(energy_ratios<RungeKutta2>(5e-4, phases)), 1.261, 0.0005);
    EXPECT_NEAR(mean(energy_ratios<RungeKutta2>(2e-4, phases)), 1.0169, 0.00005);
}

template <class I>
class SymplecticContact : public testing::Test {};
using Symplectic = testing::Types<SymplecticEuler, Leapfrog>;
TYPED_TEST_SUITE(SymplecticContact, Symplectic);

// The rest of the table of numerics C.2, to its last digit. Leapfrog and symplectic Euler see a collision alike.
TEST(Contact, GainsWhatTheTableSays)
{
    struct Row {
        double dt, euler, euler_digit, midpoint, midpoint_digit, furthest, rms, rms_digit;
    };
    const Row rows[] = {{1e-4, 1.557, 5e-4, 1.0022, 5e-5, 3.25e-3, 1.8e-3, 5e-5},
                        {5e-5, 1.2485, 5e-5, 1.0003, 5e-5, 1.25e-3, 7.0e-4, 5e-6},
                        {2e-5, 1.0929, 5e-5, 1.00002, 5e-6, 5.5e-5, 2.9e-5, 5e-7},
                        {1e-5, 1.0454, 5e-5, 1.0000, 5e-5, 2.45e-5, 1.4e-5, 5e-7}};
    for (auto const& row : rows) {
        EXPECT_NEAR(mean(energy_ratios<ForwardEuler>(row.dt, phases)), row.euler, row.euler_digit) << row.dt;
        EXPECT_NEAR(mean(energy_ratios<RungeKutta2>(row.dt, phases)), row.midpoint, row.midpoint_digit) << row.dt;
        for (auto const& e :
             {energy_ratios<SymplecticEuler>(row.dt, phases), energy_ratios<Leapfrog>(row.dt, phases)}) {
            double rms = 0, furthest = 0;
            for (double x : e) rms += (x - 1) * (x - 1) / phases, furthest = std::max(furthest, std::abs(x - 1));
            EXPECT_NEAR(mean(e), 1, 5e-5) << row.dt;
            EXPECT_LE(furthest, row.furthest) << row.dt;
            EXPECT_NEAR(std::sqrt(rms), row.rms, row.rms_digit) << row.dt;
        }
    }
}

/// The same collision by the recurrence of each scheme, written out: overlap d and its rate w.
template <class I>
double by_hand(double u, double dt)
{
    auto push = [](double d) { return d > 0 ? -omega * omega * d : 0.0; };
    double d = (u - 1) * speed * dt, w = speed;
    for (int n = 0; n < 10 || w > 0 || d > 0; ++n) {
        if constexpr (std::same_as<I, ForwardEuler>) {
            const double a = push(d);
            d += dt * w, w += dt * a;
        }
        else if constexpr (std::same_as<I, SymplecticEuler>) w += dt * push(d), d += dt * w;
        else if constexpr (std::same_as<I, Leapfrog>) w += dt / 2 * push(d), d += dt * w, w += dt / 2 * push(d);
        else {
            const double half_d = d + dt / 2 * w, half_w = w + dt / 2 * push(d);
            d += dt * half_w, w += dt * push(half_d);
        }
    }
    return w * w / (speed * speed);
}
template <class I>
void expect_as_by_hand(double dt)
{
    const int few = 50;
    const auto e = energy_ratios<I>(dt, few);
    for (int n = 0; n < few; ++n)
        EXPECT_NEAR(e[std::size_t(n)] / by_hand<I>((n + 0.5) / few, dt), 1, 1e-9) << I::name << " at " << dt;
}
// At steps that no multiple of the contact time meets.
TEST(Contact, FollowsTheRecurrenceAtIncommensurateSteps)
{
    for (double dt : {7.31e-4, 3.7e-4, 1.234e-4}) {
        expect_as_by_hand<ForwardEuler>(dt);
        expect_as_by_hand<SymplecticEuler>(dt);
        expect_as_by_hand<Leapfrog>(dt);
        expect_as_by_hand<RungeKutta2>(dt);
    }
}

// A resonance: at omega dt = sqrt 2 a step turns the phase by 90 degrees, and every collision gives back its energy.
TYPED_TEST(SymplecticContact, IsElasticAtTheSeedsStep)
{
    for (double e : energy_ratios<TypeParam>(1e-3, phases)) ASSERT_NEAR(e, 1, 1e-11);
}
TYPED_TEST(SymplecticContact, IsElasticOnAverageAtOthers)
{
    auto e = energy_ratios<TypeParam>(5e-4, phases);
    double rms = 0;
    for (double x : e) rms += (x - 1) * (x - 1) / phases;
    EXPECT_NEAR(mean(e), 1.0049, 0.00005);
    EXPECT_NEAR(*std::min_element(e.begin(), e.end()), 0.886, 0.0005);
    EXPECT_NEAR(*std::max_element(e.begin(), e.end()), 1.129, 0.0005);
    EXPECT_NEAR(std::sqrt(rms), 7.0e-2, 0.05e-2);
    e = energy_ratios<TypeParam>(2e-4, phases);
    EXPECT_NEAR(mean(e), 1.00001, 0.000005);
    EXPECT_LT(*std::max_element(e.begin(), e.end()), 1 + 5.35e-3);
    EXPECT_GT(*std::min_element(e.begin(), e.end()), 1 - 5.35e-3);
}

// 200 discs, a fraction of 0.3, 0.5 m/s: the many-body limit of the same collisions.
TEST(Contact, ABoxOfDiscsKeepsEnergyAndMomentum)
{
    const int side = 20, rows = 10;
    const double pitch = std::sqrt(std::numbers::pi * r * r / 0.3), dt = 1e-4;
    const Box<2> box{{}, {{side * pitch, rows * pitch}}};
    auto discs = dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k});
    Simulation sim(discs, SymplecticEuler{}, Periodic(box), Serial{}, Double{}, NoWatch{});
    std::mt19937 random(3);
    for (int n = 0; n < side * rows; ++n) {
        const double angle = 2 * std::numbers::pi * double(random()) / 4294967296.0;
        sim.add({{(n % side + 0.5) * pitch, (n / side + 0.5) * pitch}},
                {{0.5 * std::cos(angle), 0.5 * std::sin(angle)}});
    }
    auto momentum = [&] {
        Vec<2, double> sum{};
        for (std::size_t i = 0; i < sim.particles().size(); ++i) sum += m * sim.particles().at(velocity, i);
        return sum;
    };
    const auto before = momentum();
    sim.run({.steps = 1, .dt = dt}); // energy needs lists
    const double e0 = 0.5 * m * 0.25 * side * rows;
    double furthest = 0, stored = 0;
    for (int n = 0; n < 200; ++n) {
        sim.run({.steps = 10, .dt = dt});
        const auto e = sim.energy();
        furthest = std::max(furthest, std::abs(e.total() / e0 - 1));
        stored = std::max(stored, e.internal / e0);
    }
    EXPECT_GT(stored, 0.02); // there were collisions
    EXPECT_LE(furthest, 5e-3);
    const double drift = std::sqrt((momentum() - before).squaredNorm()) / (0.5 * m * side * rows);
    EXPECT_LE(drift, 1e-13);
    RecordProperty("energy_error", testing::PrintToString(furthest));
    RecordProperty("momentum_drift", testing::PrintToString(drift));
    RecordProperty("stored", testing::PrintToString(stored));
}

} // namespace
