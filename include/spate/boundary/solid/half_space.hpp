// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief All on one side of a plane.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/vec.hpp"

#include <cmath>

namespace spate {

template <int Dim>
struct HalfSpace {
    Vec<Dim, double> point;  ///< of the plane [m]
    Vec<Dim, double> normal; ///< out of the solid, of any length

    void check() const { require_positive("HalfSpace.normal length", std::sqrt(normal.squaredNorm()), "-"); }
    [[nodiscard]] double distance(Vec<Dim, double> const& x) const
    {
        return (x - point).dot(normal) / std::sqrt(normal.squaredNorm());
    }
};

} // namespace spate
