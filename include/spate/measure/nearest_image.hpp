// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The shortest way between two points where space closes on itself.
#pragma once

#include "spate/core/vec.hpp"

#include <cmath>

namespace spate {

/// x, less whole periods of the periodic axes of a grid [m].
template <int Dim>
Vec<Dim, double> nearest_image(Vec<Dim, double> x, auto const& grid)
{
    for (int c = 0; c < Dim; ++c)
        if (grid.periodic(c)) x[c] -= grid.period(c) * std::round(x[c] / grid.period(c));
    return x;
}

} // namespace spate
