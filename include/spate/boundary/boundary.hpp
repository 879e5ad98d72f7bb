// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What a boundary is: where space ends, and how. One with markers owns a species of particles besides; what it
/// must say of them stands in physics/model.hpp.
#pragma once

#include "spate/core/box.hpp"

#include <concepts>
#include <optional>

namespace spate {

// clang-format off
template <class B, int Dim>
concept Boundary = requires(B const b, Vec<Dim, double> const x, double length) {
    { B::markers } -> std::convertible_to<bool>;                                 // owns a species of markers
    { b.template edges<Dim>() } -> std::convertible_to<Edges<Dim>>;              // what ends space at each face
    { b.template box<Dim>() } -> std::convertible_to<std::optional<Box<Dim>>>;   // the box that space is, if it is one
    b.check(length);                                                             // throws BadInput; reach of the lists [m]
    { b.template beyond<Dim>(x) } -> std::convertible_to<double>;                // how far past a wall face [m]
    { b.thickness(length) } -> std::convertible_to<double>;                      // further past it is out of the domain [m]
};
// clang-format on

} // namespace spate
