// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A face that slides in its own plane at a constant speed: its markers have a velocity and stay where they are.
#pragma once

#include "spate/core/box.hpp"

namespace spate {

/// Option of a boundary of markers: `lid(top, 1.0, 0.0)`. The markers beyond the face, corners too.
template <int Dim>
struct Lid {
    Face face;
    Vec<Dim, double> velocity; ///< [m/s], along the face
};
template <std::convertible_to<double>... C>
Lid<int(sizeof...(C))> lid(Face face, C... velocity)
{
    return {face, {{double(velocity)...}}};
}

} // namespace spate
