// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The time step: what each criterion allows, and which one binds.
#pragma once

#include "spate/physics/wcsph.hpp"

#include <limits>
#include <string_view>

namespace spate {

/// What bounds the step of a model; zero where a criterion does not apply.
struct Stiffness {
    double length = 0;            ///< h, or the radius of a grain [m]
    double sound_speed = 0;       ///< [m/s]
    double viscosity = 0;         ///< sum of kinematic viscosities [m^2/s]
    double contact_frequency = 0; ///< of two touching grains [1/s]
};

/// \param grain_mass  of the lightest grain [kg]    \param grain_radius  of the smallest one [m]
template <class P>
Stiffness stiffness_of(P const& physics, double grain_mass, [[maybe_unused]] double grain_radius = 0)
{
    Stiffness s;
    s.length = physics.interaction.length();
    double rho0 = 0;
    detail::each_in(physics.terms, [&](auto const& t) {
        if constexpr (EquationOfState<std::remove_cvref_t<decltype(t)>>) s.sound_speed = t.c0, rho0 = t.rho0;
        if constexpr (requires { t.contact_frequency(1.0); })
            s.contact_frequency = std::max(s.contact_frequency, t.contact_frequency(grain_mass));
        if constexpr (requires { t.contact_frequency(1.0, 1.0); })
            s.contact_frequency = std::max(s.contact_frequency, t.contact_frequency(grain_mass, grain_radius));
    });
    detail::each_in(physics.terms, [&](auto const& t) {
        if constexpr (requires { t.kinematic_viscosity(1.0, 1.0, 1); })
            s.viscosity += t.kinematic_viscosity(rho0, s.length, P::dim);
    });
    return s;
}

/// A step and the criterion that bound it.
struct TimeStep {
    double dt = std::numeric_limits<double>::infinity(); ///< [s]
    std::string_view criterion = "none";

    void bound(double limit, std::string_view by)
    {
        if (limit < dt) dt = limit, criterion = by;
    }
};

/// Acoustic C h / (c0 + max|v|), viscous C/2 h^2 / nu (0.125 at C = 0.25: Morris, Fox & Zhu 1997), force
/// C sqrt(h / max|a|) (Monaghan 1992), contact pi / (25 omega); the fields of `s` say which apply.
/// docs/models/wcsph.md (21) to (23), dem.md (8).
inline TimeStep time_step(Stiffness const& s, double cfl, double speed, double acceleration)
{
    TimeStep t;
    constexpr double pi = 3.14159265358979323846, steps_in_contact = 25;
    if (s.sound_speed > 0) t.bound(cfl * s.length / (s.sound_speed + speed), "acoustic");
    if (s.viscosity > 0) t.bound(0.5 * cfl * s.length * s.length / s.viscosity, "viscous");
    if (s.sound_speed > 0 && acceleration > 0) t.bound(cfl * std::sqrt(s.length / acceleration), "force");
    if (s.contact_frequency > 0) t.bound(pi / (steps_in_contact * s.contact_frequency), "contact");
    return t;
}

} // namespace spate
