// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Wendland's C6 kernel, support 2h: does not pair, wants h of 2 spacings or more.
#pragma once

#include "spate/kernel/kernel.hpp"

#include <numbers>

namespace spate {

/// Wendland C6 (Wendland 1995; Dehnen & Aly 2012, table 1): f(q) = (1-q/2)^8 (4 q^3 + 25 q^2/4 + 4q + 1) in 2D and 3D,
/// sigma = 39/(14 pi), 1365/(512 pi) over h^dim; f(q) = (1-q/2)^7 (21 q^3/8 + 19 q^2/4 + 7q/2 + 1) in 1D,
/// sigma = 55/64 over h. docs/models/wcsph.md (30), (31).
template <int Dim>
struct WendlandC6 {
    static constexpr int dim = Dim;
    static constexpr double radius = 2;
    static constexpr double smoothing = 2; ///< h over the spacing, unless h is given [-]
    double h = from_spacing;               ///< smoothing length [m]

    [[nodiscard]] double sigma() const
    {
        constexpr double s[] = {55.0 / 64, 39 / (14 * std::numbers::pi), 1365 / (512 * std::numbers::pi)};
        return s[Dim - 1] / detail::power(h, Dim);
    }
    template <class V>
    [[gnu::always_inline]] static V f(V const& r)
    {
        const V q = min(r, V(2)); // the cube of the sentinel's would be too much for a float
        const V t = 1 - 0.5 * q, t2 = t * t, t4 = t2 * t2;
        if constexpr (Dim == 1) return t4 * t2 * t * (q * (q * (2.625 * q + 4.75) + 3.5) + 1);
        else return t4 * t4 * (q * (q * (4 * q + 6.25) + 4) + 1);
    }
    template <class V>
    [[gnu::always_inline]] static V g(V const& q)
    {
        const V t = max(1 - 0.5 * q, V(0)), t2 = t * t, t4 = t2 * t2;
        if constexpr (Dim == 1) return -0.375 * (t4 * t2) * (q * (35 * q + 36) + 12);
        else return -5.5 * (t4 * t2 * t) * (q * (4 * q + 3.5) + 1);
    }
};

} // namespace spate
