// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A ramp: a right-angled triangle upright on the floor, in 3D of endless width.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/vec.hpp"

#include <algorithm>
#include <cmath>

namespace spate {

/// Rises from the toe along x to its height, and falls upright there; a negative length rises towards smaller x.
template <int Dim>
struct Wedge {
    static_assert(Dim >= 2, "spate: a wedge needs a plane");
    Vec<Dim, double> toe; ///< [m]
    double length;        ///< along x [m]
    double height;        ///< along the last axis [m]

    void check() const
    {
        require(length != 0 && std::isfinite(length), "Wedge.length", length, "a finite number other than 0 [m]");
        require_positive("Wedge.height", height, "m");
    }
    [[nodiscard]] double distance(Vec<Dim, double> const& x) const
    {
        const double along = length > 0 ? x[0] - toe[0] : toe[0] - x[0], up = x[Dim - 1] - toe[Dim - 1];
        const double base = std::abs(length), slope = (up * base - along * height) / std::hypot(base, height);
        return std::max({slope, along - base, -up});
    }
};

} // namespace spate
