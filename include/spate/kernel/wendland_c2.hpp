// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Wendland's C2 kernel, support 2h: does not pair, wants h of 1.5 to 2 spacings.
#pragma once

#include "spate/kernel/kernel.hpp"

#include <numbers>

namespace spate {

/// Wendland C2 (Wendland 1995; Dehnen & Aly 2012, table 1): f(q) = (1-q/2)^4 (2q+1) in 2D and 3D, sigma = 7/(4 pi),
/// 21/(16 pi) over h^dim; f(q) = (1-q/2)^3 (3q/2+1) in 1D, sigma = 5/8 over h. docs/models/wcsph.md (3), (4).
template <int Dim>
struct WendlandC2 {
    static constexpr int dim = Dim;
    static constexpr double radius = 2;
    static constexpr double smoothing = Dim == 3 ? 1.5 : 2; ///< h over the spacing, unless h is given [-]
    double h = from_spacing;                                ///< smoothing length [m]

    [[nodiscard]] double sigma() const
    {
        constexpr double s[] = {5.0 / 8, 7 / (4 * std::numbers::pi), 21 / (16 * std::numbers::pi)};
        return s[Dim - 1] / detail::power(h, Dim);
    }
    template <class V>
    [[gnu::always_inline]] static V f(V const& q)
    {
        const V t = max(1 - 0.5 * q, V(0));
        if constexpr (Dim == 1) return t * t * t * (1.5 * q + 1);
        else return t * t * (t * t) * (2 * q + 1);
    }
    template <class V>
    [[gnu::always_inline]] static V g(V const& q)
    {
        const V t = max(1 - 0.5 * q, V(0));
        if constexpr (Dim == 1) return -3 * (t * t);
        else return -5 * (t * t * t);
    }
};

} // namespace spate
