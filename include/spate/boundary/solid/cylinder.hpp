// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A cylinder along an axis of space.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/vec.hpp"

#include <algorithm>
#include <cmath>

namespace spate {

struct Cylinder {
    Vec<3, double> foot; ///< centre of its lower end [m]
    double radius;       ///< [m]
    double height;       ///< [m]
    int axis = 2;        ///< along which it stands

    void check() const
    {
        require_positive("Cylinder.radius", radius, "m");
        require_positive("Cylinder.height", height, "m");
        require(axis >= 0 && axis < 3, "Cylinder.axis", axis, "0, 1 or 2");
    }
    [[nodiscard]] double distance(Vec<3, double> const& x) const
    {
        Vec<3, double> y = x - foot;
        const double along = std::abs(y[axis] - height / 2) - height / 2;
        y[axis] = 0;
        const double across = std::sqrt(y.squaredNorm()) - radius;
        return std::min(std::max(along, across), 0.0) + std::hypot(std::max(along, 0.0), std::max(across, 0.0));
    }
};

} // namespace spate
