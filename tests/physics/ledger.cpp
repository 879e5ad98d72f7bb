// SPDX-License-Identifier: BSD-3-Clause
// What re-initialisation does to energy is in its ledger; the rest is conserved as without it.
#include <spate/spate.hpp>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace spate;

/// Fluid at rest with densities at random by 1 %, without viscosity: by Continuity<2> and PressureForce<2> its energy is kept.
template <class... Term>
auto noise(Term... term)
{
    auto fluid =
        wcsph(CubicSpline<2>{.h = 1.3}, LinearEos{.rho0 = 1, .c0 = 10}, Continuity<2>{}, PressureForce<2>{}, term...);
    const Box<2> box{{0, 0}, {16, 16}};
    Simulation s(fluid, Leapfrog{}, Periodic(box), Serial{});
    std::mt19937 random(3);
    s.fill(box, 1,
           [&](auto& p, std::size_t i) { p.put(density, i, 1 + 0.01 * (double(random()) / 2147483648.0 - 1)); });
    return s;
}

TEST(DensityReinit, EnergyThatItTakesIsInTheLedger)
{
    auto s = noise(DensityReinit<Shepard>{.every = 5});
    static_assert(decltype(s)::writes_energy);
    const double start = s.energy().total();
    s.run({.steps = 60, .cfl = 0.05});
    const double change = s.energy().total() - start, written = s.written_energy();
    std::printf("energy: start %.4e, change %.4e, of it written %.4e\n", start, change, written);
    EXPECT_GT(std::abs(written), 0.1 * start); // it smooths what is rough
    // Leapfrog keeps energy to (omega dt)^2/8 of itself, omega h/c = 1.07 at most on this lattice.
    EXPECT_NEAR(change, written, 0.01 * start);
}
TEST(DensityReinit, NothingIsWrittenWithoutIt)
{
    auto s = noise();
    static_assert(!decltype(s)::writes_energy);
    const double start = s.energy().total();
    s.run({.steps = 60, .cfl = 0.05});
    EXPECT_NEAR(s.energy().total(), start, 0.01 * start);
    EXPECT_EQ(s.written_energy(), 0);
}

} // namespace
