// SPDX-License-Identifier: BSD-3-Clause
// Still water in 3D, and for long: V19 of the validation plan.
#include "models/still_water.hpp"

namespace {

using namespace still_water;

template <class Wall>
class LongStillWaterOn : public StillWaterOn<Wall> {};
TYPED_TEST_SUITE(LongStillWaterOn, States);
/// In 3D with walls on all sides, and a kernel whose gradient is true on its lattice (to 0.06 %; the cubic spline's at 1.2 dx
/// is too small by 1.8 %).
TYPED_TEST(LongStillWaterOn, HasTheExactPressureIn3DWhenCoarse)
{
    constexpr int n = 20;
    const auto c = this->named("3D, Wendland C2, a period of sound", n);
    auto s = still<WendlandC2<3>>(n, 1.5, DensityDiffusion{.delta = 0.1}, TypeParam{});
    calm(s);
    const Worst w = watch(s, H / n, 1);
    tell(this->name("3D, H/dx 20, short"), w);
    this->expect(c, w, this->gate);
    if (std::same_as<TypeParam, Extrapolated>) c.known_gap(of_floor, w.floor, "V19 floor extrapolated 3D");
    else c.at_most(of_floor, w.floor, 0.01);
}
/// The kernel of the other free-surface cases, in 3D.
TEST(LongStillWater, HasTheExactPressureIn3DWithTheCubicSpline)
{
    constexpr int n = 20;
    const models::Case c("V19", "3D, cubic spline, a period of sound, adami", n);
    auto s = still<CubicSpline<3>>(n, 1.2);
    calm(s);
    const Worst w = watch(s, H / n, 1);
    tell("3D, H/dx 20, cubic spline", w);
    c.at_most(of_creep, w.creep, 0.5);
    EXPECT_EQ(w.leaks, 0);
    c.known_gap(of_pressure, w.l2, "V19 3D cubic spline L2");
    c.known_gap(of_floor, w.floor, "V19 3D cubic spline floor");
    c.known_gap(of_motion, w.kinetic, "V19 3D cubic spline kinetic");
}
TYPED_TEST(LongStillWaterOn, HasTheExactPressureIn3D)
{
    constexpr int n = 50;
    const auto c = this->named("3D, Wendland C2, a period of sound", n);
    auto s = still<WendlandC2<3>>(n, 1.5, DensityDiffusion{.delta = 0.1}, TypeParam{});
    calm(s);
    const Worst w = watch(s, H / n, 1);
    tell(this->name("3D, H/dx 50, short"), w);
    this->expect(c, w, this->gate);
    if (std::same_as<TypeParam, Extrapolated>) c.known_gap(of_floor, w.floor, "V19 floor extrapolated 3D H/dx 50");
    else c.at_most(of_floor, w.floor, 0.01);
}
/// The same gates for 20 sqrt(H/g).
TYPED_TEST(LongStillWaterOn, HasTheExactPressureForTwentyUnits)
{
    constexpr int n = 50;
    const auto c = this->named("2D, 20 sqrt(H/g)", n);
    auto s = still<CubicSpline<2>>(n, 1.2, DensityDiffusion{.delta = 0.1}, TypeParam{});
    calm(s);
    auto file = models::results("still_water_50_" + std::string(TypeParam::name) + ".csv",
                                "t_over_unit,l2,floor,kinetic,creep,gap");
    const double start = s.time();
    Worst all;
    for (int k = 1; k <= 20; ++k) {
        s.run({.until = start + k * unit - sound, .cfl = 0.2});
        const Worst w = watch(s, H / n, 1);
        all.of(w);
        file << k << ',' << w.l2 << ',' << w.floor << ',' << w.kinetic << ',' << w.creep << ',' << w.gap << '\n';
    }
    tell(this->name("2D, H/dx 50, 20 units"), all);
    save_profile("still_water_50_profile_" + std::string(TypeParam::name) + ".csv", s);
    this->expect(c, all, this->gate);
    c.known_gap(of_floor, all.floor, std::string("V19 floor 20 units ") + TypeParam::name);
}

/// The floor is a known gap above: the cubic spline at h = 1.2 dx on a lattice has a gradient too small by 0.92 %
/// (kernel_lattice_constants.csv), so that water at rest presses harder by as much. A kernel whose gradient is true there
/// (to 0.09 %) meets the gate of the floor too.
TEST(LongStillWater, HasTheExactPressureOnTheFloorWithWendlandC2)
{
    constexpr int n = 50;
    const models::Case c("V19", "2D, Wendland C2, after 20 sqrt(H/g), adami", n);
    auto s = still<WendlandC2<2>>(n, 2);
    calm(s);
    s.run({.until = s.time() + 20 * unit - sound, .cfl = 0.2});
    const Worst w = watch(s, H / n, 1);
    tell("H/dx 50, Wendland C2, after 20 units", w);
    save_profile("still_water_50_profile_wendland_c2.csv", s);
    c.at_most(of_pressure, w.l2, 0.01);
    c.at_most(of_floor, w.floor, 0.01);
    c.at_most(of_motion, w.kinetic, 1e-6);
    c.at_most(of_creep, w.creep, 0.5);
    EXPECT_EQ(w.leaks, 0);
}

/// Diffusion of the dynamic part of density keeps the surface within half a spacing; of the whole (Molteni & Colagrossi)
/// it does not. V19 asks that the one creeps ten times as far as the other: docs/results/validation.md.
template <class Diffusion>
Worst after_many_steps(Diffusion diffusion)
{
    constexpr int n = 25;
    auto s = still<CubicSpline<2>>(n, 1.2, diffusion);
    calm(s);
    s.run({.steps = 100000, .cfl = 0.2});
    return watch(s, H / n, 1);
}
TEST(LongStillWater, DoesNotCreepIn100000Steps)
{
    const models::Case c("V19", "2D, 1e5 steps", 25);
    const Worst fourtakas = after_many_steps(DensityDiffusion{.delta = 0.1});
    const Worst molteni = after_many_steps(MolteniColagrossi{.delta = 0.1});
    tell("H/dx 25, 100000 steps, Fourtakas", fourtakas);
    tell("H/dx 25, 100000 steps, Molteni & Colagrossi", molteni);
    c.at_most(std::string(of_creep) + ", Fourtakas", fourtakas.creep, 0.5);
    c.at_least(std::string(of_creep) + ", Molteni & Colagrossi", molteni.creep, 0.5);
    EXPECT_EQ(fourtakas.leaks, 0);
    c.known_gap("creep of Fourtakas over a tenth of Molteni", 10 * fourtakas.creep / molteni.creep,
                "V19 creep of Fourtakas over a tenth of Molteni");
}

} // namespace
