// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The model of equal round grains: mass and radius are uniform, so no array holds them.
#pragma once

#include "spate/physics/dem/discs.hpp"
#include "spate/physics/dem/linear_spring.hpp"
#include "spate/physics/gravity.hpp"
#include "spate/physics/physics.hpp"

namespace spate {

/// Equal grains: `dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5})`.
struct Grain {
    double mass;   ///< [kg]
    double radius; ///< [m]
};
template <int Dim, class... T>
auto dem(Grain grain, T... term)
{
    require_positive("Grain.mass", grain.mass, "kg");
    require_positive("Grain.radius", grain.radius, "m");
    return physics(Round<Dim>{grain.radius}, Uniform{mass, grain.mass}, Uniform{radius, grain.radius}, term...);
}

} // namespace spate
