// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Space without an end.
#pragma once

#include "spate/core/box.hpp"

#include <optional>

namespace spate {

/// No boundary: particles go where they go; memory follows the cells that they occupy.
struct Open {
    static constexpr bool markers = false;

    template <int Dim>
    [[nodiscard]] Edges<Dim> edges() const
    {
        return Edges<Dim>(Edge::open);
    }
    /// The box that space is, where it is one.
    template <int Dim>
    [[nodiscard]] std::optional<Box<Dim>> box() const
    {
        return {};
    }
    void check(double) const {}
    /// How far beyond a wall face a coordinate is [m]; 0 or less: not.
    template <int Dim>
    [[nodiscard]] double beyond(Vec<Dim, double> const&) const
    {
        return 0;
    }
    /// Beyond this distance past a wall a particle has left the domain [m].
    [[nodiscard]] double thickness(double) const { return 0; }
};

} // namespace spate
