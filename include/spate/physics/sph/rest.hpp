// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Fluid at rest under gravity in the box that is filled: the starts `hydrostatic` and `settled`.
#pragma once

#include "spate/core/box.hpp"
#include "spate/physics/sph/equation_of_state.hpp"

#include <algorithm>
#include <cmath>

namespace spate {

/// Each fluid particle on the lattice, with the density of its depth below the top of the filled box. The mass in a volume
/// is rho0 and not that density, so that the fluid sinks a little, and rings.
inline constexpr struct Hydrostatic {
} hydrostatic{};

/// Each fluid particle where it bears the weight of the lattice above it: the lattice pressed together along gravity, its
/// foot in place, until the mass in a volume is the density carried. Gravity has the direction of an axis; a column
/// stands on the foot of the box, not on a solid in it.
inline constexpr struct Settled {
} settled{};

namespace detail {

/// What is known of a point of the filled box, in units of potential, |g| times a length [m^2/s^2].
/// \tparam Eos  its equation of state
template <int Dim, EquationOfState Eos>
struct AtRest {
    Eos const& eos;
    Box<Dim> const& box;
    Vec<Dim, double> const& g;

    /// Below the top of the box, against gravity.
    [[nodiscard]] double depth(Vec<Dim, double> const& x) const
    {
        double gz = 0;
        for (int c = 0; c < Dim; ++c) gz += g[c] * (x[c] - (g[c] < 0 ? box.hi[c] : box.lo[c]));
        return gz;
    }
    /// From its top to its foot.
    [[nodiscard]] double height() const
    {
        double gz = 0;
        for (int c = 0; c < Dim; ++c) gz += std::abs(g[c]) * box.size()[c];
        return gz;
    }
    /// Under the column that reached so deep on the lattice: p = rho0 g z (the mass above is that of the lattice).
    [[nodiscard]] double density_under(double gz) const { return eos.density_of(eos.rho0 * std::max(0.0, gz)); }
    /// Of that column once it is pressed together: integral of rho0/rho(rho0 s) ds from 0 to gz = integral of dp/rho.
    [[nodiscard]] double settled_depth(double gz) const { return eos.enthalpy_of(density_under(gz)); }
    /// How far the surface has sunk.
    [[nodiscard]] double sunk() const { return height() - settled_depth(height()); }
    /// Where a point of the lattice comes to lie.
    [[nodiscard]] Vec<Dim, double> settled_place(Vec<Dim, double> x) const
    {
        const double g2 = g.squaredNorm(), gz = depth(x);
        if (g2 > 0) x += ((sunk() - (gz - settled_depth(gz))) / g2) * g;
        return x;
    }
};
template <int Dim, class Eos>
AtRest(Eos const&, Box<Dim> const&, Vec<Dim, double> const&) -> AtRest<Dim, Eos>;

} // namespace detail
} // namespace spate
