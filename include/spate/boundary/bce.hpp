// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Walls of markers (boundary condition enforcing): layers of particles on the lattice of the fluid's spacing,
/// a species of their own that others see and that sees others only.
#pragma once

#include "spate/boundary/periodic.hpp"
#include "spate/core/box.hpp"
#include "spate/core/fields.hpp"

#include <cmath>
#include <optional>

namespace spate {

/// A box lined with markers: `Bce tank(Box<3>{...}, dx, Adami{}, open(top))`; faces may be open, axes periodic.
/// Layers lie at 1/2, 3/2, ... spacings outside the faces, as many as the range needs.
/// \tparam State  how the markers get density and pressure: ByContinuity or Adami
template <int Dim, class State>
class Bce {
public:
    static constexpr bool markers = true;
    static constexpr Fields uniform{mass, velocity}; ///< of the markers: no array; the wall stands still
    static constexpr auto state = State::fields;

    template <class... Options>
    [[gnu::cold]] Bce(Box<Dim> box, double spacing, State how, Options... options)
        : box_(box), spacing_(spacing), how_(how), edges_(Edge::wall)
    {
        (apply(edges_, options), ...);
        require_positive("Bce.spacing", spacing, "m");
        for (int c = 0; c < Dim; ++c) {
            const std::string length = along_axis("Bce.box length", c);
            require_positive(length, box.size()[c], "m");
            const double n = box.size()[c] / spacing;
            require(n > 1 - 1e-6, "Bce.spacing", spacing, "at most the box length " + text(box.size()[c]) + " m");
            require(std::abs(n - std::round(n)) < 1e-6 * n, length, box.size()[c],
                    "a whole number of spacings; the nearest is " + text(std::round(n) * spacing) +
                        " m, or take spacing " + text(box.size()[c] / std::round(n)) + " m");
        }
    }
    template <class P>
    [[nodiscard]] auto terms(P const& physics) const
    {
        return how_.terms(physics);
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
    [[nodiscard]] double spacing() const { return spacing_; }
    [[nodiscard]] int layers(double range) const { return int(std::ceil(range / spacing_ - 1e-9)); }
    [[nodiscard]] double thickness(double range) const { return layers(range) * spacing_; }
    void check(double reach) const { Periodic<Dim>::check_periodic(box_, edges_, reach); }

    /// f(x) for each marker of walls that cover `range`.
    void place(double range, auto const& f) const
    {
        Vec<Dim, double> x{};
        place_axis<Dim - 1>(layers(range), x, true, f);
    }
    /// The largest distance of x beyond a wall face [m]; 0 or less: inside.
    template <int>
    [[nodiscard]] double beyond(Vec<Dim, double> const& x) const
    {
        double far = -std::numeric_limits<double>::infinity();
        for (int c = 0; c < Dim; ++c) {
            if (edges_.at(c, false) == Edge::wall) far = std::max(far, box_.lo[c] - x[c]);
            if (edges_.at(c, true) == Edge::wall) far = std::max(far, x[c] - box_.hi[c]);
        }
        return far;
    }

private:
    template <int c>
    [[gnu::cold]] void place_axis(int layers, Vec<Dim, double>& x, bool inside, auto const& f) const
    {
        const int n = int(std::round(box_.size()[c] / spacing_));
        const int first = edges_.at(c, false) == Edge::wall ? -layers : 0;
        const int last = edges_.at(c, true) == Edge::wall ? n + layers : n;
        for (int k = first; k < last; ++k) {
            x[c] = box_.lo[c] + (k + 0.5) * spacing_;
            const bool in = inside && k >= 0 && k < n;
            if constexpr (c > 0) place_axis<c - 1>(layers, x, in, f);
            else if (!in) f(x);
        }
    }

    Box<Dim> box_;
    double spacing_;
    State how_;
    Edges<Dim> edges_;
};
template <int Dim, class State, class... Options>
Bce(Box<Dim>, double, State, Options...) -> Bce<Dim, State>;

} // namespace spate
