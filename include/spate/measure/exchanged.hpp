// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What particles that entered and left during a run have brought and taken along, and its columns in a history.
#pragma once

#include "spate/core/vec.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace spate {

/// What some particles carry.
template <int Dim>
struct Amount {
    std::int64_t particles = 0;
    double mass = 0;             ///< [kg]
    Vec<Dim, double> momentum{}; ///< [kg m/s]
    double energy = 0;           ///< kinetic, potential and internal; of contacts, what parts with them [J]
    double dissipated = 0;       ///< what they had lost in contacts, where the model counts it [J]

    Amount& operator+=(Amount const& b)
    {
        particles += b.particles, mass += b.mass, momentum += b.momentum;
        energy += b.energy, dissipated += b.dissipated;
        return *this;
    }
};

/// Since the scene began.
template <int Dim>
struct Exchanged {
    Amount<Dim> entered, left;
    double moment = 0; ///< sum of (mass entered less mass left) t [kg s]: what gravity has done to a mass that changes

    [[nodiscard]] bool any() const { return entered.particles + left.particles > 0; }
    [[nodiscard]] double mass() const { return entered.mass - left.mass; }
    [[nodiscard]] double energy() const { return entered.energy - left.energy; }
};

/// One number of them, as a column.
struct ExchangedColumn {
    enum class What { particles, mass, energy, momentum };
    std::string name;
    bool left;
    What what;
    int axis = 0; ///< of momentum

    double operator()(auto const& scene) const
    {
        auto const& e = scene.exchanged();
        auto const& a = left ? e.left : e.entered;
        switch (what) {
        case What::particles: return double(a.particles);
        case What::mass: return a.mass;
        case What::energy: return a.energy;
        default: return a.momentum[axis];
        }
    }
};
/// entered_particles, entered_mass, entered_energy, entered_momentum_x, ..., and the same of those that left:
/// `History(directory, 0.01, exchanged_columns<2>())`.
template <int Dim>
std::vector<ExchangedColumn> exchanged_columns()
{
    using What = ExchangedColumn::What;
    std::vector<ExchangedColumn> all;
    for (bool left : {false, true}) {
        const std::string side = left ? "left_" : "entered_";
        all.push_back({side + "particles", left, What::particles});
        all.push_back({side + "mass", left, What::mass});
        all.push_back({side + "energy", left, What::energy});
        for (int c = 0; c < Dim; ++c) all.push_back({side + "momentum_" + "xyz"[c], left, What::momentum, c});
    }
    return all;
}

} // namespace spate
