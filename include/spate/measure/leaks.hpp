// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief How many particles have gone through a wall.
#pragma once

#include "spate/core/field.hpp"
#include "spate/core/ranks.hpp"

#include <string>

namespace spate {

/// The number of mobile particles beyond a wall face by more than half a spacing, where the first layer of markers is; a
/// boundary with solids says itself who has `passed` them.
struct Leaks {
    double spacing; ///< of the particles [m]
    std::string name = "leaks";

    double operator()(auto const& scene) const
    {
        auto const& p = scene.particles();
        constexpr int dim = std::remove_cvref_t<decltype(p)>::dim;
        std::size_t n = 0;
        auto const& boundary = scene.system().boundary();
        for (std::size_t i = 0; i < p.size(); ++i) {
            const auto x = p.at(position, i);
            if constexpr (requires { boundary.passed(x); }) n += boundary.passed(x);
            else n += boundary.template beyond<dim>(x) > spacing / 2;
        }
        return double(party_of(scene).all(n, agree::Sum{}));
    }
};

} // namespace spate
