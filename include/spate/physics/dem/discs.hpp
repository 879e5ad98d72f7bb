// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The interaction of discs and spheres: pairs that overlap.
#pragma once

#include "spate/cells/neighbours.hpp"
#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/physics/dem/contact.hpp"

namespace spate {

/// Round particles of Dim dimensions that touch when nearer than the sum of their radii.
template <int Dim>
struct Round {
    static constexpr int dim = Dim;
    static constexpr Fields reads{position, radius};
    /// Short lists: a thick skin, as they move every way, the thicker the fewer are within it, and targets in their own order.
    static constexpr Neighbours neighbours{.skin = Dim == 2 ? 0.5 : 0.2, .finer = 1, .window = 1};
    double largest; ///< largest radius of the scene [m]

    [[nodiscard]] double range() const { return 2 * largest; }
    [[nodiscard]] double length() const { return largest; }
    [[gnu::cold]] void check() const { require_positive("radius", largest, "m"); }

    /// Whether they touch: most listed pairs do not, and root and quotient of pair() are dear.
    [[gnu::always_inline]] auto touch(auto const& i, auto const& j) const
    {
        const auto d = i[radius] + j[radius];
        return (i[position] - j[position]).squaredNorm() < d * d;
    }
    template <class V>
    [[gnu::always_inline]] auto pair(auto const& i, auto const& j) const
    {
        const Vec<Dim, V> x = i[position] - j[position];
        const V r2 = x.squaredNorm(), d = i[radius] + j[radius];
        const V r = sqrt(r2);
        Contact<Dim, V, decltype(r2 < r2)> ij;
        ij.mask = r2 < d * d;
        ij.n = (r * (1 / r2)) * x; // 1/r, but root and quotient do not wait for each other
        ij.overlap = d - r;
        return ij;
    }
};
using Discs = Round<2>;
using Spheres = Round<3>;

} // namespace spate
