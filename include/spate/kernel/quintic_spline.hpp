// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The quintic B-spline, support 3h: smoother than the cubic one, at the price of a wider support.
#pragma once

#include "spate/kernel/kernel.hpp"

#include <numbers>

namespace spate {

/// Quintic spline (Schoenberg 1946; Morris, Fox & Zhu 1997, eq. 24): f(q) = (3-q)^5 - 6(2-q)^5 + 15(1-q)^5, each power
/// only where its base is positive; sigma = 1/120, 7/(478 pi), 1/(120 pi) over h^dim. Within h the same polynomial is
/// 66 - 60 q^2 + 30 q^4 - 10 q^5, which does not cancel. docs/models/wcsph.md (27).
template <int Dim>
struct QuinticSpline {
    static constexpr int dim = Dim;
    static constexpr double radius = 3;
    static constexpr double smoothing = 1; ///< h over the spacing, unless h is given [-]
    double h = from_spacing;               ///< smoothing length [m]

    [[nodiscard]] double sigma() const
    {
        constexpr double s[] = {1.0 / 120, 7 / (478 * std::numbers::pi), 1 / (120 * std::numbers::pi)};
        return s[Dim - 1] / detail::power(h, Dim);
    }
    template <class V>
    [[gnu::always_inline]] static V f(V const& q)
    {
        const V s = max(3 - q, V(0)), t = max(2 - q, V(0));
        const V s2 = s * s, t2 = t * t, q2 = q * q;
        return where(q < 1, 66 - q2 * (60 - q2 * (30 - 10 * q)), s2 * s2 * s - 6 * (t2 * t2 * t));
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
        const V s = max(3 - q, V(0)), t = max(2 - q, V(0));
        const V s2 = s * s, t2 = t * t;
        return where(q < 1, (q * q) * (120 - 50 * q) - 120, (-5 * (s2 * s2 - 6 * (t2 * t2))) * over_q);
    }
};

} // namespace spate
