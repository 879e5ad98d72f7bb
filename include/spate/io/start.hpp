// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Where particles are at the start of a run, and how fast: what a file of them says.
///        Not the state of a run that goes on: that is a checkpoint.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "spate/core/box.hpp"
#include "spate/core/fields.hpp"

namespace spate::io {

/// One entry a particle, in the order of the ids that they get.
template <int Dim>
struct Start {
    std::vector<Vec<Dim, double>> x;  ///< [m]
    std::vector<Vec<Dim, double>> v;  ///< [m/s]
    std::vector<double> radius;       ///< [m]; empty: not said
    std::vector<double> mass;         ///< [kg]; empty: not said
    std::vector<Vec<3, double>> spin; ///< angular velocity [rad/s], in 2D about z; empty: none
    std::optional<Box<Dim>> box;      ///< in which they are, if the file says so

    [[nodiscard]] std::size_t size() const { return x.size(); }

    /// Adds them to a scene. Radius and mass go to particles that carry them; where they are one value for all, the file
    /// must agree to a billionth.
    [[gnu::cold]] void add_to(auto& scene) const
    {
        auto& p = scene.particles();
        agrees(p, spate::radius, radius, "m");
        agrees(p, spate::mass, mass, "kg");
        if constexpr (!std::remove_cvref_t<decltype(p)>::template has<AngularVelocity>)
            for (std::size_t k = 0; k < spin.size(); ++k)
                require(spin[k] == Vec<3, double>{}, "spin of particle " + std::to_string(k) + " of the start file",
                        std::sqrt(spin[k].squaredNorm()), "0 rad/s: no term of the model turns grains");
        for (std::size_t k = 0; k < size(); ++k) {
            const std::size_t i = scene.add(x[k], v[k]);
            give(p, i, spate::radius, radius, k);
            give(p, i, spate::mass, mass, k);
            turn(p, i, k);
        }
    }

private:
    template <Field F>
    static void agrees(auto const& p, F f, std::vector<double> const& said, std::string const& unit)
    {
        using P = std::remove_cvref_t<decltype(p)>;
        if constexpr (Set<P::uniform>::template contains<F>)
            for (std::size_t k = 0; k < said.size(); ++k)
                require(std::abs(said[k] - p.value(f)) <= 1e-9 * p.value(f),
                        std::string(F::name) + " of particle " + std::to_string(k) + " of the start file", said[k],
                        "that of the model, " + text(p.value(f)) + " " + unit + ", to a billionth");
    }
    void turn([[maybe_unused]] auto& p, [[maybe_unused]] std::size_t i, [[maybe_unused]] std::size_t k) const
    {
        if constexpr (std::remove_cvref_t<decltype(p)>::template has<AngularVelocity>) {
            if (spin.empty()) return;
            auto w = p.at(angular_velocity, i);
            if constexpr (Dim == 3) w = spin[k];
            else w[0] = spin[k][2];
            p.put(angular_velocity, i, w);
        }
    }
    template <Field F>
    static void give(auto& p, std::size_t i, F f, std::vector<double> const& said, std::size_t k)
    {
        if constexpr (Set<std::remove_cvref_t<decltype(p)>::fields>::template contains<F>)
            if (!said.empty()) p.put(f, i, said[k]);
    }
};

} // namespace spate::io
