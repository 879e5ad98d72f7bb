// SPDX-License-Identifier: BSD-3-Clause
// A tank of 1 m by 1 m with an open top, and water as stiff as is asked for: the scene of the tests of measures.
#pragma once

#include <spate/spate.hpp>

namespace measured {

inline constexpr double dx = 0.05, h = 1.2 * dx, g = 9.81;
using Point = spate::Vec<2, double>;

/// Filled to a height with water at rest.
template <class... Options>
auto tank(double depth, double c0, Options... options)
{
    using namespace spate;
    auto water = wcsph(CubicSpline<2>{.h = h}, Tait{.rho0 = 1000, .c0 = c0}, Continuity<2>{}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -g}});
    Simulation still(water, SymplecticEuler{}, Bce(Box<2>{{0, 0}, {1, 1}}, dx, Adami{}, open(top), options...),
                     Serial{});
    if (depth > 0) still.fill(Box<2>{{0, 0}, {1, depth}}, dx, hydrostatic);
    return still;
}

} // namespace measured
