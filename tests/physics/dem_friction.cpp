// SPDX-License-Identifier: BSD-3-Clause
// Rough grains: what friction conserves, what it remembers, and what comes out of a collision.
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

template <int Dim, class I = Leapfrog, class Backend = Serial, class Precision = Double>
auto rough(Backend backend = {}, Precision precision = {})
{
    return Simulation(dem<Dim>({.mass = 0.1, .radius = 0.01}, spring, dashpot, friction), I{}, Open{}, backend,
                      precision, NoWatch{});
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
    const auto serial = hash(rough<3>());
    for (int threads : {1, 2, 3, 7}) EXPECT_EQ(serial, hash(rough<3>(Threads{.count = threads, .cell = threads})));
    EXPECT_EQ(serial, hash(rough<3>(Serial{}, ScalarOf<Double>{})));
}

} // namespace
