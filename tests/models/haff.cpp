// SPDX-License-Identifier: BSD-3-Clause
// A granular gas that cools by its collisions (Haff 1983): V54 of the validation plan. While it stays homogeneous,
// T = T0/(1 + t/tau)^2 with 1/tau = (1 - e^2) omega_E/(2 d), omega_E Enskog's collision rate at T0; in a plane
// omega_E = 2 sqrt(pi) n sigma chi sqrt(T0/m), chi = (1 - 7 phi/16)/(1 - phi)^2 (Henderson 1975).
#include "models/case.hpp"
#include "models/results.hpp"
#include "oracle/dice.hpp"

#include "spate/spate.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace spate;

/// Few grains a gas: in a box of less than some twenty free paths no eddy outlives the cooling (Goldhirsch & Zanetti 1993).
constexpr int side = 16;
constexpr double r = 0.01, m = 0.1, phi = 0.1, e = 0.9, speed = 0.5; // sqrt(T0/m) [m/s]
/// So stiff that a grain is in contact for less than a hundredth of the time: the law is that of hard discs.
constexpr LinearSpring spring{.k = 4e6}; // by the midpoint method: e of a dashpot is of first order under leapfrog

auto gas(std::uint64_t seed)
{
    const double pitch = r * std::sqrt(std::numbers::pi / phi), L = side * pitch;
    Simulation sim(dem<2>({.mass = m, .radius = r}, spring, Dashpot{.e = 1}), RungeKutta2{},
                   Periodic(Box<2>{{0, 0}, {L, L}}), Serial{});
    oracle::Dice dice(seed);
    std::vector<Vec<2, double>> v(side * side);
    Vec<2, double> mean{};
    for (auto& one : v) {
        const double far = std::sqrt(-2 * std::log(1 - dice.real(0, 1))), angle = dice.real(0, 2 * std::numbers::pi);
        one = {far * std::cos(angle), far * std::sin(angle)};
        mean += (1.0 / (side * side)) * one;
    }
    double square = 0;
    for (auto& one : v) one -= mean, square += one.squaredNorm();
    const double scale = speed * std::sqrt(2 * side * side / square);
    for (int k = 0; k < side * side; ++k)
        sim.add({(k % side + 0.5) * pitch, (k / side + 0.5) * pitch}, scale * v[std::size_t(k)]);
    return sim;
}

/// T over that of the start of cooling at times up to 5 tau, the mean of some gases.
TEST(LongHaff, AGranularGasCoolsWithTheSquareOfTime)
{
    const models::Case c("V54", "granular gas, e = 0.9", side);
    const double n = phi / (std::numbers::pi * r * r), chi = (1 - 7 * phi / 16) / ((1 - phi) * (1 - phi));
    const double rate = 2 * std::sqrt(std::numbers::pi) * n * 2 * r * chi * speed, tau = 4 / ((1 - e * e) * rate);
    const double dt = std::numbers::pi / spring.contact_frequency(m) / 25;
    constexpr int rows = 20, gases = 24;
    std::array<double, rows + 1> T{};
    for (int k = 0; k < gases; ++k) {
        auto sim = gas(std::uint64_t(k) + 1);
        sim.run({.until = 10 / rate, .dt = dt}); // without loss: from a lattice to a gas
        const double start = sim.energy().kinetic, from = sim.time();
        ASSERT_NEAR(start, side * side * m * speed * speed, 0.02 * start);
        std::get<1>(sim.system().terms()).zeta = spring.damping(e);
        for (int row = 0; row <= rows; ++row) {
            sim.run({.until = from + 5 * tau * row / rows, .dt = dt});
            T[std::size_t(row)] += sim.energy().kinetic / (start * gases);
        }
    }
    auto table = models::results("haff.csv", "t_over_tau,T_over_T0,law");
    double worst = 0;
    for (int row = 0; row <= rows; ++row) {
        const double s = 5.0 * row / rows, law = 1 / ((1 + s) * (1 + s));
        table << s << ',' << T[std::size_t(row)] << ',' << law << '\n';
        worst = std::max(worst, std::abs(T[std::size_t(row)] / law - 1));
    }
    c.at_most("error of temperature, worst to 5 tau", worst, 0.05);
    EXPECT_LT(T[rows], 0.03); // 1/36
}

} // namespace
