// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The scenes that are timed: a jittered block of water, the dam break "big", a box of discs.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include <spate/spate.hpp>

namespace bench {

using namespace spate;

constexpr double dx = 0.01;                    ///< spacing of the particles of all water [m]
constexpr double g = 9.81;                     ///< [m/s^2]
const double c0 = 10 * std::sqrt(2 * g * 0.4); ///< of the dam break "big" [m/s]

/// Water with the terms of the scene dam_break, or with others.
template <class... T>
auto water(double h_over_dx, T... term)
{
    return wcsph(CubicSpline<3>{.h = h_over_dx * dx}, Tait{.rho0 = 1000, .c0 = c0}, term...);
}
inline auto dam_break_water()
{
    return water(1.2, Continuity<2>{}, DensityDiffusion{.delta = 0.1}, PressureForce<2>{},
                 ArtificialViscosity{.alpha = 0.1}, Gravity<3>{{0, 0, -g}});
}

/// Numbers from -1 to 1 for the particles of a scene.
class Dice {
public:
    double operator()() { return any_(random_); }

private:
    std::mt19937_64 random_{1};
    std::uniform_real_distribution<double> any_{-1, 1};
};

/// A cube of n^3 particles in open space, jittered by a fifth of the spacing, with speeds and densities at random, and
/// its lists and rates made once.
template <class P, class I = RungeKutta2, class Precision = Double>
auto block(int n, P const& physics, I integrator = {}, Precision precision = {}, Neighbours neighbours = {},
           int cell = 0)
{
    Simulation s(physics, integrator, Open{}, Serial{.cell = cell}, precision, Watch{}, neighbours);
    Dice dice;
    s.fill(Box<3>{{0, 0, 0}, {n * dx, n * dx, n * dx}}, dx, [&](auto& p, std::size_t i) {
        auto x = p.at(position, i);
        for (int c = 0; c < 3; ++c) x[c] += 0.2 * dx * dice();
        p.put(position, i, x);
        p.put(velocity, i, {dice(), dice(), dice()});
        if constexpr (std::remove_cvref_t<decltype(p)>::template has<Density>)
            p.put(density, i, 1000 * (1 + 0.01 * dice()));
    });
    s.system().rebuild();
    s.system().rates(s.system().all); // fills pressure and the records
    return s;
}

/// The dam break "big" of the issue, at rest: a column of 0.5 x 0.4 x 0.4 m in a tank of 1 x 0.4 x 0.5 m.
template <class Workers, class Precision = Double, class Wall = Adami>
auto big_dam_on(Workers workers, Precision precision = {}, Wall wall = {.suction = false})
{
    Bce tank(Box<3>{{0, 0, 0}, {1, 0.4, 0.5}}, dx, wall, open(top));
    Simulation dam(dam_break_water(), RungeKutta2{}, tank, workers, precision);
    dam.fill(Box<3>{{0, 0, 0}, {0.5, 0.4, 0.4}}, dx, hydrostatic);
    return dam;
}
template <class Precision = Double, class Wall = Adami>
auto big_dam(int threads, Precision precision = {}, Wall wall = {.suction = false})
{
    return big_dam_on(Threads{.count = threads}, precision, wall);
}

/// The seed's run (`dam_break --case seed`): 17,556 particles of water and 121,776 markers, at rest.
template <class Workers>
auto seed_dam_on(Workers workers, Neighbours neighbours = {})
{
    constexpr double h = 0.02;
    auto fluid =
        wcsph(CubicSpline<3>{.h = h}, Tait{.rho0 = 1000, .c0 = 25}, Continuity<2>{}, DensityDiffusion{.delta = 0.1},
              PressureForce<2>{}, LaminarViscosity{.mu = 1}, Gravity<3>{{0, 0, -1}});
    Bce tank(Box<3>{{0, 0, 0}, {3.08, 0.08, 2.28}}, h, ByContinuity{}, layers(3));
    Simulation dam(fluid, RungeKutta2{}, tank, workers, Double{}, Watch{}, neighbours);
    dam.fill(Box<3>{{0, 0, 0}, {1.54, 0.08, 1.14}}, h, hydrostatic);
    return dam;
}
inline auto seed_dam() { return seed_dam_on(Threads{.count = 1}); }

/// The box of the granular deck: 262,144 discs of 0.1 kg and 0.01 m, k = 1e5 N/m, no damping, elastic walls, at most 0.5 m/s.
/// The deck does not say how large the box is; discs cover 0.3 of this one. A row of `edge` discs along each axis.
template <class Workers>
auto granular_deck_on(Workers workers, int edge = 512)
{
    constexpr double r = 0.01;
    const double a = r * std::sqrt(std::numbers::pi / 0.3); // [m]
    Simulation box(dem<2>({.mass = 0.1, .radius = r}, LinearSpring{.k = 1e5}), SymplecticEuler{},
                   Walls(Box<2>{{0, 0}, {edge * a, edge * a}}), workers, Double{}, Watch{.energy_every = 100});
    Dice dice;
    for (int j = 0; j < edge; ++j)
        for (int i = 0; i < edge; ++i) {
            const double v = 0.5 * std::sqrt(std::abs(dice())), angle = std::numbers::pi * dice();
            const double x = a * (i + 0.5) + 0.15 * a * dice(), y = a * (j + 0.5) + 0.15 * a * dice();
            box.add({x, y}, {v * std::cos(angle), v * std::sin(angle)});
        }
    return box;
}

/// Discs on a jittered triangular lattice of area fraction phi, periodic, with random speeds of up to 0.5 m/s.
inline auto discs(int edge, double phi, int threads, Neighbours neighbours)
{
    constexpr double r = 0.01; // [m]
    const double a = r * std::sqrt(2 * std::numbers::pi / (std::sqrt(3.0) * phi)), b = a * std::sqrt(3.0) / 2;
    Simulation box(dem<2>({.mass = 0.1, .radius = r}, LinearSpring{.k = 1e5}), SymplecticEuler{},
                   Periodic(Box<2>{{0, 0}, {edge * a, edge * b}}), Threads{.count = threads}, Double{}, Watch{},
                   neighbours);
    Dice dice;
    const double jitter = phi > 0.5 ? 0.05 * r : 0.15 * a;
    for (int j = 0; j < edge; ++j)
        for (int i = 0; i < edge; ++i) {
            const double v = 0.5 * std::sqrt(std::abs(dice())), angle = std::numbers::pi * dice();
            const double x = a * (i + 0.5 * (j & 1)) + jitter * dice(), y = b * j + jitter * dice();
            box.add({x, y}, {v * std::cos(angle), v * std::sin(angle)});
        }
    box.prepare();
    return box;
}

} // namespace bench
