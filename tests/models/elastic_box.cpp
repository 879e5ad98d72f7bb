// SPDX-License-Identifier: BSD-3-Clause
// The energy of the seed's box of discs, small and for long: V51 of the validation plan. 1024 discs, area fraction 0.2,
// |v| = 0.5 m/s, elastic walls, leapfrog at a 25th of the contact time: about a million contacts.
#include "models/case.hpp"
#include "models/results.hpp"
#include "oracle/dice.hpp"

#include "spate/spate.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace spate;

constexpr int side = 32;
constexpr double r = 0.01, m = 0.1, phi = 0.2, speed = 0.5;
constexpr LinearSpring spring{.k = 1e5};

/// Bounded by the 1 % of V51 at every look, and what is left is no trend: the mean of the changes between looks is less than
/// three of its standard errors.
TEST(LongElasticBox, KeepsItsEnergyOverAMillionSteps)
{
    const models::Case c("V51", "1024 discs, 1e6 steps", side);
    const double pitch = r * std::sqrt(std::numbers::pi / phi), L = side * pitch; // 1.2683 m
    Simulation sim(dem<2>({.mass = m, .radius = r}, spring), Leapfrog{}, Walls(Box<2>{{0, 0}, {L, L}}), Serial{});
    oracle::Dice dice(12345);
    for (int k = 0; k < side * side; ++k) {
        const double angle = dice.real(0, 2 * std::numbers::pi);
        sim.add({(k % side + 0.5) * pitch, (k / side + 0.5) * pitch},
                {speed * std::cos(angle), speed * std::sin(angle)});
    }
    const double dt = std::numbers::pi / spring.contact_frequency(m) / 25;
    auto table = models::results("elastic_box.csv", "step,energy_change");
    const double start = sim.energy().total();
    constexpr int looks = 100;
    double before = 0, most = 0, sum = 0, square = 0;
    for (int k = 1; k <= looks; ++k) {
        sim.run({.steps = 10000, .dt = dt});
        sim.make_lists_current();
        const double now = sim.energy().total() / start - 1;
        table << sim.steps() << ',' << now << '\n';
        most = std::max(most, std::abs(now));
        sum += now - before, square += (now - before) * (now - before), before = now;
    }
    const double mean = sum / looks, error = std::sqrt((square / looks - mean * mean) / looks);
    std::printf("largest |dE/E| %.3g, after a million steps %.3g, drift %.3g +- %.2g in 10000 steps\n", most, before,
                mean, error);
    c.at_most("energy, off by at most", most, 1e-2);
    c.at_most("drift of energy [standard errors]", std::abs(mean) / error, 3);
}

} // namespace
