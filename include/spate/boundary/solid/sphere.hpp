// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A ball; in 2D a disc, or a cylinder seen along its axis.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/vec.hpp"

#include <cmath>

namespace spate {

template <int Dim>
struct Sphere {
    Vec<Dim, double> centre; ///< [m]
    double radius;           ///< [m]

    void check() const { require_positive("Sphere.radius", radius, "m"); }
    [[nodiscard]] double distance(Vec<Dim, double> const& x) const
    {
        return std::sqrt((x - centre).squaredNorm()) - radius;
    }
};

} // namespace spate
