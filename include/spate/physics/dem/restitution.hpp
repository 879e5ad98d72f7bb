// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The damping of a contact from its coefficient of restitution.
#pragma once

#include <cmath>
#include <numbers>

namespace spate {

/// Of a linear spring and dashpot that part at zero overlap, damped by zeta over the critical. Docs (10).
[[nodiscard, gnu::cold]] inline double restitution(double zeta)
{
    if (zeta >= 1) return 0;
    return std::exp(-std::numbers::pi * zeta / std::sqrt(1 - zeta * zeta));
}
[[nodiscard, gnu::cold]] inline double damping_ratio(double e)
{
    if (e == 0) return 1;
    const double l = std::log(e);
    return -l / std::sqrt(std::numbers::pi * std::numbers::pi + l * l);
}

/// Of the same where the force never pulls: they part when it is zero (Schwager & Poeschel 2007). Docs (11).
[[nodiscard, gnu::cold]] inline double restitution_without_pull(double zeta)
{
    if (zeta == 1) return std::exp(-2.0);
    if (zeta > 1) {
        const double w = std::sqrt(zeta * zeta - 1);
        return std::exp(-zeta / w * 2 * std::log(zeta + w)); // ln((zeta + w)/(zeta - w)), the product of both is 1
    }
    const double w = std::sqrt(1 - zeta * zeta);
    return std::exp(-zeta / w * (std::numbers::pi - std::atan2(2 * zeta * w, 1 - 2 * zeta * zeta)));
}
/// Solved for zeta; e above 0.
[[nodiscard, gnu::cold]] inline double damping_ratio_without_pull(double e)
{
    if (e >= 1) return 0;
    double low = 0, high = 1;
    while (restitution_without_pull(high) > e) high *= 2;
    for (int n = 0; n < 200 && low < high; ++n) { // to the last bit
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) break;
        (restitution_without_pull(middle) > e ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace spate
