// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Space that closes on itself along some or all axes.
#pragma once

#include "spate/core/box.hpp"

#include <optional>

namespace spate {

/// Periodic(Box<2>{...}): all axes; Periodic(Box<2>{...}, open(top, bottom)): periodic in x only.
template <int Dim>
class Periodic {
public:
    static constexpr bool markers = false;

    template <class... Options>
    explicit Periodic(Box<Dim> box, Options... options) : box_(box), edges_(Edge::periodic)
    {
        (apply(edges_, options), ...);
        for (int c = 0; c < Dim; ++c) {
            if (edges_.at(c, false) == Edge::periodic && edges_.at(c, true) != Edge::periodic)
                edges_.set({c, false}, Edge::open); // one open face opens the axis
            if (edges_.at(c, true) == Edge::periodic && edges_.at(c, false) != Edge::periodic)
                edges_.set({c, true}, Edge::open);
        }
    }
    template <int>
    [[nodiscard]] Edges<Dim> const& edges() const
    {
        return edges_;
    }
    template <int>
    [[nodiscard]] std::optional<Box<Dim>> box() const
    {
        return box_;
    }
    /// \param reach  of the neighbour lists [m]: a particle and its image must not share a neighbour
    void check(double reach) const { check_periodic(box_, edges_, reach); }
    template <int>
    [[nodiscard]] double beyond(Vec<Dim, double> const&) const
    {
        return 0;
    }
    [[nodiscard]] double thickness(double) const { return 0; }

    [[gnu::cold]] static void check_periodic(Box<Dim> const& box, Edges<Dim> const& edges, double reach)
    {
        for (int c = 0; c < Dim; ++c) {
            const double length = box.size()[c];
            const std::string axis = along_axis("box length", c);
            require_positive(axis, length, "m");
            if ((edges.at(c, false) == Edge::periodic) != (edges.at(c, true) == Edge::periodic))
                throw BadInput("axis " + std::to_string(c), "periodic at one end and open or a wall at the other",
                               "periodic at both ends or at none");
            if (edges.periodic(c))
                require(length >= 2 * reach, "periodic " + axis, length,
                        "at least twice the reach of the neighbour lists, " + text(2 * reach) +
                            " m: take a smaller h or a longer box");
            constexpr double most = 1 << 26; // bins have indices
            if (edges.periodic(c))
                require(!(length > most * reach), "periodic " + axis, length,
                        "at most 67108864 times the reach of the neighbour lists, " + text(most * reach) + " m");
        }
    }

private:
    Box<Dim> box_;
    Edges<Dim> edges_;
};
template <int Dim, class... Options>
Periodic(Box<Dim>, Options...) -> Periodic<Dim>;

} // namespace spate
