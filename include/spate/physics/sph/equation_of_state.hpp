// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What an equation of state is: pressure from density, and back, and at rest under gravity.
#pragma once

#include <concepts>

namespace spate {

// clang-format off
template <class E>
concept EquationOfState = requires(E const e, double x) {
    { e.rho0 } -> std::convertible_to<double>;           // reference density [kg/m^3]
    { e.c0 } -> std::convertible_to<double>;             // speed of sound at rho0 [m/s]
    { e.pressure_of(x) } -> std::same_as<double>;        // p(rho) [Pa]
    { e.density_of(x) } -> std::same_as<double>;         // rho(p) [kg/m^3]
    { e.hydrostatic_density(x) } -> std::same_as<double>; // rho where the potential is g z [m^2/s^2] below the surface
    { e.enthalpy_of(x) } -> std::same_as<double>;        // integral of dp/rho from rho0, the inverse of that [m^2/s^2]
    { e.energy_of(x) } -> std::same_as<double>;          // compressive energy e(rho) [J/kg]
};
// clang-format on

} // namespace spate
