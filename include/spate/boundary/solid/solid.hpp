// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A solid: where it is, by the distance to its surface. Box, Sphere, Cylinder, HalfSpace, Wedge; unite,
/// intersect, subtract, inside_out.
#pragma once

#include "spate/core/vec.hpp"

#include <concepts>

namespace spate {

// clang-format off
template <class S, int Dim>
concept Solid = requires(S const s, Vec<Dim, double> const x) {
    { s.distance(x) } -> std::same_as<double>; // to the surface [m], negative within; never more than the true one
};
// clang-format on

} // namespace spate
