// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Wendland's C4 kernel, support 2h: does not pair, wants h of 2 spacings.
#pragma once

#include "spate/kernel/kernel.hpp"

#include <numbers>

namespace spate {

/// Wendland C4 (Wendland 1995; Dehnen & Aly 2012, table 1): f(q) = (1-q/2)^6 (35 q^2/12 + 3q + 1) in 2D and 3D,
/// sigma = 9/(4 pi), 495/(256 pi) over h^dim; f(q) = (1-q/2)^5 (2 q^2 + 5q/2 + 1) in 1D, sigma = 3/4 over h.
/// docs/models/wcsph.md (28), (29).
template <int Dim>
struct WendlandC4 {
    static constexpr int dim = Dim;
    static constexpr double radius = 2;
    static constexpr double smoothing = 2; ///< h over the spacing, unless h is given [-]
    double h = from_spacing;               ///< smoothing length [m]

    [[nodiscard]] double sigma() const
    {
        constexpr double s[] = {3.0 / 4, 9 / (4 * std::numbers::pi), 495 / (256 * std::numbers::pi)};
        return s[Dim - 1] / detail::power(h, Dim);
    }
    template <class V>
    [[gnu::always_inline]] static V f(V const& q)
    {
        const V t = max(1 - 0.5 * q, V(0)), t2 = t * t;
        if constexpr (Dim == 1) return t2 * t2 * t * (q * (2 * q + 2.5) + 1);
        else return t2 * t2 * t2 * (q * (35.0 / 12 * q + 3) + 1);
    }
    template <class V>
    [[gnu::always_inline]] static V g(V const& q)
    {
        const V t = max(1 - 0.5 * q, V(0)), t2 = t * t;
        if constexpr (Dim == 1) return -3.5 * (t2 * t2) * (2 * q + 1);
        else return -14.0 / 3 * (t2 * t2 * t) * (2.5 * q + 1);
    }
};

} // namespace spate
