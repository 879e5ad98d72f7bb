// SPDX-License-Identifier: BSD-3-Clause
// Grains in small numbers, for tests of what contacts do.
#pragma once

#include "oracle/dice.hpp"

#include <spate/spate.hpp>

namespace grains {

using namespace spate;

/// What a cloud of grains is made of; equal ones, or of radii from 0.5 to 1 of the largest and masses to match.
struct Cloud {
    int side = 4;
    double mass = 0.1, radius = 0.01, speed = 1, spin = 50;
};
/// Grains on a lattice, a little apart, that fly at random towards each other: many contacts of every kind. Centred at the
/// origin, where positions are round to least.
template <int Dim>
void scatter(auto& sim, Cloud const& c, std::uint64_t seed)
{
    oracle::Dice dice(seed);
    std::size_t n = 1;
    for (int d = 0; d < Dim; ++d) n *= std::size_t(c.side);
    auto& p = sim.particles();
    p.resize(n);
    using P = std::remove_cvref_t<decltype(p)>;
    for (std::size_t i = 0; i < n; ++i) {
        Vec<Dim, double> x, v;
        std::size_t rest = i;
        for (int d = 0; d < Dim; ++d) {
            const double at = double(rest % std::size_t(c.side)) - 0.5 * (c.side - 1);
            x[d] = (at + dice.real(-0.02, 0.02)) * 2.1 * c.radius;
            v[d] = dice.real(-c.speed, c.speed) - at * c.speed; // towards the middle
            rest /= std::size_t(c.side);
        }
        p.put(position, i, x), p.put(velocity, i, v);
        if constexpr (P::template has<AngularVelocity>) {
            auto w = p.at(angular_velocity, i);
            for (auto& component : w.c) component = dice.real(-c.spin, c.spin);
            p.put(angular_velocity, i, w);
        }
        if constexpr (Set<P::fields>::template contains<Radius>) {
            const double size = dice.real(0.5, 1);
            p.put(radius, i, size * c.radius), p.put(mass, i, size * size * size * c.mass);
        }
    }
    sim.prepare();
}

/// sum of m v; sum of x x m v + I omega, with one component in a plane, three in space.
template <int Dim>
auto momentum(auto const& sim)
{
    auto const& p = sim.particles();
    Vec<Dim, double> sum{};
    for (std::size_t i = 0; i < p.size(); ++i) sum += p.at(mass, i) * p.at(velocity, i);
    return sum;
}
template <int Dim>
auto angular_momentum(auto const& sim)
{
    auto const& p = sim.particles();
    Value<AngularVelocity, Dim, double> sum{};
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double m = p.at(mass, i), r = p.at(radius, i);
        sum += m * cross(p.at(position, i), p.at(velocity, i));
        if constexpr (std::remove_cvref_t<decltype(p)>::template has<AngularVelocity>)
            sum += (inertia<Dim> * m * r * r) * p.at(angular_velocity, i);
    }
    return sum;
}

} // namespace grains
