// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The cubic B-spline, support 2h.
#pragma once

#include "spate/kernel/kernel.hpp"

#include <numbers>

namespace spate {

/// Cubic spline (Monaghan & Lattanzio 1985): f(q) = (2-q)^3 - 4(1-q)^3 for q < 1, (2-q)^3 for q < 2, 0 beyond;
/// sigma = 1/6, 5/(14 pi), 1/(4 pi) over h^dim. docs/models/wcsph.md (2).
template <int Dim>
struct CubicSpline {
    static constexpr int dim = Dim;
    static constexpr double radius = 2;
    static constexpr double smoothing = 1.2; ///< h over the spacing, unless h is given [-]
    double h = from_spacing;                 ///< smoothing length [m]

    [[nodiscard]] double sigma() const
    {
        constexpr double s[] = {1.0 / 6, 5 / (14 * std::numbers::pi), 1 / (4 * std::numbers::pi)};
        return s[Dim - 1] / detail::power(h, Dim);
    }
    template <class V>
    [[gnu::always_inline]] static V f(V const& q)
    {
        const V s = max(2 - q, V(0)), t = max(1 - q, V(0));
        return s * s * s - 4 * (t * t * t);
    }
    template <class V>
    [[gnu::always_inline]] static V g(V const& q)
    {
        return g(q, 1 / q);
    }
    /// From q and 1/q, which an interaction can have without waiting for q; what 1/q is at q = 0 does not matter.
    template <class V>
    [[gnu::always_inline]] static V g(V const& q, V const& over_q)
    {
        const V s = max(2 - q, V(0));
        return where(q < 1, 9 * q - 12, (-3 * (s * s)) * over_q);
    }
};

} // namespace spate
