// SPDX-License-Identifier: BSD-3-Clause
// The bits of a run do not depend on who computes it, with every term of the fluid in some scene: a dam break with
// corrections of density and of positions, and a stirred periodic box whose density is summed.
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace {
using namespace scenes;

template <class Precision = Double, class Backend>
Outcome corrected_dam(Backend backend, Neighbours n = usual)
{
    constexpr double dx = 0.02, height = 0.2;
    auto water = wcsph(CubicSpline<2>{}, Tait{.rho0 = 1000, .c0 = 20}, SigmaContinuity{1.5},
                       DensityDiffusion{.delta = 0.1}, SigmaPressure{1.5}, TensileCorrection{},
                       MonaghanCleary<2>{.mu = 1}, SpeciesViscosity<Role::marker>{.mu = 0.5}, Gravity<2>{{0, -9.81}},
                       Xsph{.eps = 0.3}, DensityReinit<Mls>{.every = 7}, SurfaceShifting{.mach = 0.05});
    Bce tank(Box<2>{{}, {{0.4, 0.4}}}, dx, Adami{}, open(top));
    Simulation sim(water, RungeKutta2{}, tank, backend, Precision{}, Watch{}, n);
    sim.fill(Box<2>{{}, {{0.2, height}}}, dx, hydrostatic);
    return outcome(sim, 700);
}
template <class Precision = Double, class Backend>
Outcome stirred_box(Backend backend, Neighbours n = usual)
{
    const Box<2> box{{}, {{20, 20}}};
    auto fluid = wcsph(QuinticSpline<2>{}, LinearEos{.rho0 = 1, .c0 = 15}, SummationDensity{}, PressureForce<2>{},
                       VariableViscosity{.largest = 0.1}, Xsph{}, Shifting{.mach = 0.05});
    Simulation sim(fluid, Leapfrog{}, Periodic(box), backend, Precision{}, Watch{}, n);
    sim.fill(box, 1, [](auto& p, std::size_t i) {
        const auto x = p.at(position, i);
        auto wave = [](double y) { // a parabola for each half wave: the same bits with every libm
            const double s = y / 10, t = s < 1 ? s : s - 1;
            return (s < 1 ? 4 : -4) * t * (1 - t);
        };
        p.put(velocity, i, {{wave(x[1]), wave(x[0])}});
        p.put(viscosity, i, x[0] < 10 ? 0.1 : 0.05);
    });
    return outcome(sim, 400);
}
/// \param f  runs the scene with a backend and neighbours, in double unless a precision is its template argument
void expect_same_bits(auto const& f)
{
    const Outcome reference = f(ScalarOf<Double>{}, Serial{}, usual);
    EXPECT_GE(reference.rebuilds, 10);
    EXPECT_EQ(f(Double{}, Threads{1}, usual).hash, reference.hash) << "packs";
    EXPECT_EQ(f(Double{}, Threads{3}, usual).hash, reference.hash);
    EXPECT_EQ(f(Double{}, Threads{2, 3}, usual).hash, reference.hash);
    EXPECT_EQ(f(Double{}, Threads{1, 1}, usual).hash, reference.hash);
    const auto thin = f(Double{}, Threads{1}, Neighbours{.skin = 0.1, .bins = 1.4, .trigger = 0.08});
    const auto thick = f(Double{}, Threads{1}, Neighbours{.skin = 0.4, .bins = 1.4, .trigger = 0.08});
    EXPECT_EQ(thin.hash, thick.hash) << "a list with a thin skin misses nobody";
}
TEST(BitsOfTerms, OfACorrectedDamBreakDependOnNobody)
{
    expect_same_bits(
        [](auto precision, auto backend, Neighbours n) { return corrected_dam<decltype(precision)>(backend, n); });
}
TEST(BitsOfTerms, OfAStirredBoxDependOnNobody)
{
    expect_same_bits(
        [](auto precision, auto backend, Neighbours n) { return stirred_box<decltype(precision)>(backend, n); });
}

} // namespace
