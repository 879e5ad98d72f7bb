// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The exact velocity of plane Poiseuille flow that starts from rest.
#pragma once

#include <cmath>
#include <numbers>

/// Morris, Fox & Zhu (1997, section 5.2): a parabola less a series that dies out; speed in the middle at the end V0.
inline double series(double y_over_L, double nu_t_over_L2, double V0)
{
    const double pi = std::numbers::pi, y = y_over_L;
    double u = 4 * y * (1 - y);
    for (int n = 1; n < 200; n += 2)
        u -= 32 / (pi * pi * pi * n * n * n) * std::sin(n * pi * y) * std::exp(-n * n * pi * pi * nu_t_over_L2);
    return V0 * u;
}
