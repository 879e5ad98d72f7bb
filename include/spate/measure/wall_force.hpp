// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The force of the particles on the walls.
#pragma once

#include "spate/core/fields.hpp"
#include "spate/core/ranks.hpp"
#include "spate/core/reduction.hpp"

#include <array>
#include <string>

namespace spate {

/// The sum over the mobile particles of -m a, a the acceleration by the markers of the boundary, or by walls of contact: the
/// exact opposite of what the walls do to the particles. Derived fields are those of the last evaluation: refresh() the scene
/// before.
struct WallForce {
    std::string name = "wall_force";

    [[gnu::cold]] auto operator()(auto& scene) const // [N]
    {
        using Engine = std::remove_cvref_t<decltype(scene.system())>;
        constexpr bool touched = Set<Engine::M::wall_adds>::template contains<Acceleration>;
        static_assert(Engine::species_count == 2 || touched,
                      "spate: WallForce needs a boundary of markers, such as Bce, or Walls of contact");
        constexpr int dim = Engine::dim;
        std::array<ExactSum, std::size_t(dim)> sum;
        auto push = [&](double m, Vec<dim, double> const& a) {
            for (int c = 0; c < dim; ++c) sum[std::size_t(c)].add(-m * a[c]);
        };
        if constexpr (touched)
            scene.system().wall_sums(
                [&](std::size_t i, auto const& sums) { push(scene.particles().at(mass, i), sums[acceleration]); });
        else
            scene.system().template partial_sums<1>(
                [&](std::size_t i, auto const& p) { push(p.at(mass, i), p.at(acceleration, i)); });
        party_of(scene).each(sum, agree::Sum{});
        Vec<dim, double> force;
        for (int c = 0; c < dim; ++c) force[c] = sum[std::size_t(c)].value();
        return force;
    }
};

} // namespace spate
