// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What a smoothing kernel is: W(r, h) = sigma f(q), q = r/h, and grad_a W = sigma h^-2 g(q) x_ab, g = f'(q)/q.
/// Laws (each a test): W integrates to 1; g is the derivative of f over q, finite at 0, never positive; 0 from the support on.
#pragma once

#include "spate/core/pack.hpp"

#include <concepts>
#include <limits>

namespace spate {

/// A length that follows from the spacing of the particles unless the user gives it: h of a kernel that says how many
/// spacings it wants (`smoothing`), and the spacing itself where a term needs it. No NaN: that is what a mistake gives.
inline constexpr double from_spacing = std::numeric_limits<double>::lowest();

// clang-format off
template <class K>
concept Kernel = requires(K const k, double q) {
    { K::dim } -> std::convertible_to<int>;     // 1, 2 or 3
    { k.h } -> std::convertible_to<double>;     // smoothing length [m]
    { K::radius } -> std::convertible_to<double>; // support over h [-]
    { k.sigma() } -> std::same_as<double>;      // normalisation with h^-dim in it [m^-dim]
    { K::f(q) } -> std::same_as<double>;        // shape [-]
    { K::g(q) } -> std::same_as<double>;        // f'(q)/q [-]
};
// clang-format on

namespace detail {
constexpr double power(double x, int n)
{
    double y = 1;
    for (int k = 0; k < n; ++k) y *= x;
    return y;
}
} // namespace detail

} // namespace spate
