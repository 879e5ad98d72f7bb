// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Planes that reflect particles as a mirror does light: no markers, no force.
#pragma once

#include "spate/boundary/periodic.hpp"
#include "spate/core/box.hpp"

#include <cmath>
#include <limits>
#include <optional>

namespace spate {

/// `Walls(Box<2>{...}, open(top))`: elastic walls at the faces of a box; others open or periodic. What has a radius touches
/// them with its surface, what has none with its centre. docs/models/boundaries.md (9).
template <int Dim>
class Walls {
public:
    static constexpr bool markers = false;
    static constexpr int bounces = 8; ///< off the two planes of an axis within one step; more is a stop

    template <class... Options>
    explicit Walls(Box<Dim> box, Options... options) : box_(box), edges_(Edge::wall)
    {
        (apply(edges_, options), ...);
        for (int c = 0; c < Dim; ++c) require_positive(along_axis("Walls.box length", c), box.size()[c], "m");
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
    void check(double reach) const { Periodic<Dim>::check_periodic(box_, edges_, reach); }
    template <int>
    [[nodiscard]] double beyond(Vec<Dim, double> const& x) const
    {
        double far = -std::numeric_limits<double>::infinity();
        for (int c = 0; c < Dim; ++c) far = std::max({far, least(c, 0) - x[c], x[c] - most(c, 0)});
        return far;
    }
    [[nodiscard]] double thickness(double) const { return 0; } // nothing is ever beyond

    enum class Bounce { none, some, too_many };
    /// x <- 2 wall - x and the outward velocity inwards, until x is inside.
    /// \param r  radius [m]
    Bounce reflect(Vec<Dim, double>& x, Vec<Dim, double>& v, double r) const
    {
        Bounce b = Bounce::none;
        for (int c = 0; c < Dim; ++c) {
            const double lo = least(c, r), hi = most(c, r);
            for (int k = 0; x[c] < lo || x[c] > hi; ++k) {
                if (k == bounces) return Bounce::too_many;
                const bool below = x[c] < lo;
                x[c] = 2 * (below ? lo : hi) - x[c];
                v[c] = below ? std::abs(v[c]) : -std::abs(v[c]);
                b = Bounce::some;
            }
        }
        return b;
    }

private:
    [[nodiscard]] double least(int c, double r) const
    {
        return edges_.at(c, false) == Edge::wall ? box_.lo[c] + r : -std::numeric_limits<double>::infinity();
    }
    [[nodiscard]] double most(int c, double r) const
    {
        return edges_.at(c, true) == Edge::wall ? box_.hi[c] - r : std::numeric_limits<double>::infinity();
    }
    Box<Dim> box_;
    Edges<Dim> edges_;
};
template <int Dim, class... Options>
Walls(Box<Dim>, Options...) -> Walls<Dim>;

} // namespace spate
