// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief How many particles have gone through a wall.
#pragma once

#include "spate/core/field.hpp"

#include <string>

namespace spate {

/// The number of mobile particles beyond a wall face by more than half a spacing, where the first layer of markers is.
struct Leaks {
    double spacing; ///< of the particles [m]
    std::string name = "leaks";

    double operator()(auto const& scene) const
    {
        auto const& p = scene.particles();
        constexpr int dim = std::remove_cvref_t<decltype(p)>::dim;
        std::size_t n = 0;
        for (std::size_t i = 0; i < p.size(); ++i)
            if (scene.system().boundary().template beyond<dim>(p.at(position, i)) > spacing / 2) ++n;
        return double(n);
    }
};

} // namespace spate
