// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What a picture shows, and how: balls, colours, axes. Not the drawing: that is io/picture.hpp.
#pragma once

#include <array>
#include <limits>
#include <string>

namespace spate::io {

struct Ball {
    float x[3];           ///< in 2D: to the right, up, ignored  [m]
    float radius;         ///< [m]
    float value;          ///< what the colour shows; red if not a number
    bool ghosted = false; ///< a wall marker: light grey, without a value
};

/// How wall markers are drawn in 3D; in 2D they are solid unless left out.
enum class Ghosts { translucent, solid, left_out };

struct Picture {
    static constexpr double automatic = std::numeric_limits<double>::quiet_NaN();

    std::string title = {};                           ///< on top; the place for the time
    std::string value_name = {};                      ///< empty: no colour bar
    std::string unit = {};                            ///< of the value
    int dim = 3;                                      ///< 2 or 3
    double value_min = automatic;                     ///< colour at the low end
    double value_max = automatic;                     ///< colour at the high end
    std::array<double, 3> seen_from{0.5, -0.8, 0.45}; ///< 3D: direction from the scene to the viewer; z is up
    int width = 1400;                                 ///< [pixels]
    int height = 900;                                 ///< [pixels]
    Ghosts ghosts = Ghosts::translucent;
    std::array<std::string, 3> axes{"x", "y", "z"};               ///< names along x[0], x[1], x[2]
    std::array<double, 3> lower{automatic, automatic, automatic}; ///< balls whose centre is outside are left out  [m]
    std::array<double, 3> upper{automatic, automatic, automatic}; ///< [m]
};

} // namespace spate::io
