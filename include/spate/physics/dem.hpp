// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The models of round grains: equal ones, whose mass and radius no array holds, or of many sizes; and what a term of
/// a contact takes from the others.
#pragma once

#include "spate/physics/dem/by_material.hpp"
#include "spate/physics/dem/dashpot.hpp"
#include "spate/physics/dem/discs.hpp"
#include "spate/physics/dem/friction.hpp"
#include "spate/physics/dem/hertz.hpp"
#include "spate/physics/dem/linear_spring.hpp"
#include "spate/physics/dem/mindlin.hpp"
#include "spate/physics/dem/rolling_resistance.hpp"
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
    return physics(Round<Dim>{grain.radius}, Uniform{mass, grain.mass}, Uniform{radius, grain.radius},
                   detail::completed_in<detail::most_materials<T...>>(term, term...)...);
}

/// Grains of many sizes; mass and radius are fields: `dem<2>(Mixture{.largest = 0.02}, LinearSpring{.k = 1e5})`.
struct Mixture {
    double largest; ///< radius of the largest grain [m]
};
template <int Dim, class... T>
auto dem(Mixture mixture, T... term)
{
    return physics(Round<Dim>{mixture.largest}, detail::completed_in<detail::most_materials<T...>>(term, term...)...);
}

} // namespace spate
