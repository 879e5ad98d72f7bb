// SPDX-License-Identifier: BSD-3-Clause
// The granular seed's box of 262,144 discs at an area fraction of 0.8 between walls of springs, against another code: LAMMPS
// (two versions, two pair styles) has a total energy of 3275.860266 J after 400 steps of velocity Verlet at 1e-4 s, from the same
// start (numpy's default_rng(12345)).
#include <granular_box/start.hpp>

#include <spate/spate.hpp>

#include <gtest/gtest.h>

namespace {

using namespace spate;

constexpr double r = 0.01, m = 0.1, k = 1e5, speed = 0.5; // m, kg, N/m, m/s

/// The box of the deck with n discs at an area fraction.
template <class I, class... WallOptions>
auto box_of(granular::Start<2> const& start, I integrator, int threads, WallOptions... options)
{
    Simulation box(dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k}), integrator, Walls(*start.box, options...),
                   Threads{.count = threads});
    for (std::size_t i = 0; i < start.x.size(); ++i) box.add(start.x[i], start.v[i]);
    return box;
}

TEST(GranularBox, HasTheEnergyOfAnotherCode)
{
    const auto start = granular::scattered(262144, r, 0.8, speed, 12345);
    auto box = box_of(start, Leapfrog{}, 2, contact(LinearSpring{.k = k}));
    EXPECT_NEAR(box.energy().kinetic, 0.5 * m * speed * speed * 262144, 1e-7); // some discs overlap a wall
    box.run({.steps = 400, .dt = 1e-4});
    box.make_lists_current();
    EXPECT_NEAR(box.energy().total(), 3275.860266, 3275.86e-8); // eight digits
}
// The first draws of numpy.random.default_rng(12345), version 1.24, and of its permutation.
TEST(Dice, DrawWhatNumpyDraws)
{
    granular::Dice one(12345);
    EXPECT_EQ(one.uniform(0, 1), 0.22733602246716966);
    granular::Dice other(12345);
    const auto order = other.permutation(263000);
    EXPECT_EQ(order[0], 165801u);
    EXPECT_EQ(order[1], 164498u);
    EXPECT_EQ(order[262999], 176525u);
    EXPECT_NEAR(other.uniform(-1, 1), -0.72443588632339995, 1e-16);
}
TEST(GranularBox, RefusesAFractionThatCannotBePacked)
{
    for (double fraction : {0.0, -1.0, 0.95, 1.2})
        EXPECT_THROW(granular::scattered(1000, r, fraction, speed, 1), BadInput);
    for (double fraction : {0.01, 0.3, 0.59, 0.6, 0.8}) {
        const auto start = granular::scattered(1000, r, fraction, speed, 1);
        EXPECT_NEAR(1000 * std::numbers::pi * r * r / (start.box->hi[0] * start.box->hi[1]), fraction, 1e-12);
        double nearest = 1;
        for (std::size_t i = 0; i < start.x.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, (start.x[i] - start.x[j]).squaredNorm());
        EXPECT_GT(std::sqrt(nearest), 2 * r) << fraction; // nobody overlaps
    }
}

/// The smaller box in which numerics has the many-body runs: 200 discs at 0.3.
template <class I>
auto small_box(I integrator, std::uint64_t seed)
{
    return box_of(granular::scattered(200, r, 0.3, speed, seed), integrator, 1, contact(LinearSpring{.k = k}));
}
// Forward Euler multiplies the energy of a contact by 38.65 at the seed's step: the watch ends the run within 30 steps.
TEST(GranularBox, StopsForwardEulerAtTheSeedsStep)
{
    auto box = small_box(ForwardEuler{}, 1);
    try {
        box.run({.steps = 2000, .dt = 1e-3});
        FAIL() << "no stop";
    }
    catch (EnergyRunaway const& e) {
        EXPECT_LE(e.facts().step, 30);
    }
    ASSERT_FALSE(box.report().warnings.empty());
    EXPECT_NE(box.report().warnings[0].find("forward_euler"), std::string::npos);
}
template <class I>
void expect_bounded(I integrator)
{
    for (std::uint64_t seed : {1u, 2u}) {
        auto box = small_box(integrator, seed);
        const double before = box.energy().total();
        double worst = 0;
        for (int n = 0; n < 50; ++n) {
            box.run({.steps = 100, .dt = 1e-4});
            box.make_lists_current();
            worst = std::max(worst, std::abs(box.energy().total() / before - 1));
        }
        EXPECT_LE(worst, 5e-3) << integrator.name << ", seed " << seed;
    }
}
TEST(GranularBox, KeepsItsEnergyWithSchemesThatAreSymplectic)
{
    expect_bounded(SymplecticEuler{});
    expect_bounded(Leapfrog{});
}

} // namespace
