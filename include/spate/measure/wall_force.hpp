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

/// The sum over the mobile particles of -m a, a the acceleration by the markers of the boundary: the exact opposite of what
/// the walls do to the fluid. Derived fields are those of the last evaluation: refresh() the scene before.
struct WallForce {
    std::string name = "wall_force";

    auto operator()(auto& scene) const // [N]
    {
        using Engine = std::remove_cvref_t<decltype(scene.system())>;
        static_assert(Engine::species_count == 2, "spate: WallForce needs a boundary of markers, such as Bce");
        constexpr int dim = Engine::dim;
        std::array<ExactSum, std::size_t(dim)> sum;
        scene.system().template partial_sums<1>([&](std::size_t i, auto const& p) {
            const auto f = p.at(mass, i) * p.at(acceleration, i);
            for (int c = 0; c < dim; ++c) sum[std::size_t(c)].add(-f[c]);
        });
        party_of(scene).each(sum, agree::Sum{});
        Vec<dim, double> force;
        for (int c = 0; c < dim; ++c) force[c] = sum[std::size_t(c)].value();
        return force;
    }
};

} // namespace spate
