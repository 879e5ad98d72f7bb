// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The energy of the mobile particles by part, each sum exact and so the same on any number of threads.
#pragma once

#include "spate/core/fields.hpp"

#include <vector>

namespace spate {

/// [J], of all mobile particles.
struct Energy {
    double kinetic = 0;    ///< sum m v^2 / 2
    double potential = 0;  ///< -sum m g . x
    double internal = 0;   ///< compressive: sum m e(rho); elastic: stored in contacts
    double rotational = 0; ///< sum I omega^2 / 2
    double dissipated = 0; ///< lost in contacts since the start, where the model counts it

    [[nodiscard]] double total() const { return kinetic + rotational + potential + internal; }
};

/// \param s  a system    \param eos  its equation of state, or a pointer to nothing
template <class S, class Eos, int Dim>
Energy energy_of(S const& s, Eos const* eos, Vec<Dim, double> const& g)
{
    auto const& p = s.mobile();
    using Q = std::remove_cvref_t<decltype(p)>;
    Energy e;
    auto mass_of = [&](std::size_t i) {
        if constexpr (Q::template has<Mass>) return p.at(mass, i);
        else return 1.0;
    };
    e.kinetic = s.sum([&](std::size_t i) { return 0.5 * mass_of(i) * p.at(velocity, i).squaredNorm(); });
    if (g != Vec<Dim, double>{})
        e.potential = s.sum([&](std::size_t i) { return -mass_of(i) * g.dot(p.at(position, i)); });
    if constexpr (!std::is_void_v<Eos> && Q::template has<Density>)
        e.internal = s.sum([&](std::size_t i) { return mass_of(i) * eos->energy_of(p.at(density, i)); });
    else e.internal = s.pair_energy() + s.wall_energy();
    if constexpr (Q::template has<AngularVelocity>)
        e.rotational = s.sum([&](std::size_t i) {
            const double r = p.at(radius, i);
            return 0.5 * inertia<Dim> * mass_of(i) * r * r * p.at(angular_velocity, i).squaredNorm();
        });
    if constexpr (Q::template has<Dissipated>) e.dissipated = s.sum([&](std::size_t i) { return p.at(dissipated, i); });
    return e;
}

/// Some particles of a system, as energy_of and sums see them; contacts between one of them and another count wholly.
template <class S>
struct Some {
    S const& system;
    std::vector<char> const& is; ///< by particle
    bool contacts;               ///< whether they may touch; lists must be current

    auto const& mobile() const { return system.mobile(); }
    [[nodiscard]] double sum(auto const& f) const
    {
        return system.sum([&](std::size_t i) { return is[i] != 0 ? f(i) : 0.0; });
    }
    [[nodiscard]] double wall_energy() const
    {
        return system.wall_energy([&](std::size_t i) { return is[i] != 0; });
    }
    [[nodiscard]] double pair_energy() const
    {
        if (!contacts) return 0;
        return system.pair_energy([&](std::size_t i, std::size_t j) {
            return is[i] == 0 ? 0.0 : is[j] != 0 ? 0.5 : 1.0;
        });
    }
};

} // namespace spate
