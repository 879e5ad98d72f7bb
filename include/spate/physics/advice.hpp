// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What stability theory says of an integrator, a model and a step, before the first one: warnings with a cure.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/physics/sph/stability.hpp"
#include "spate/physics/time_step.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace spate {

/// The largest step that linear theory lets stand, and what bounds it; infinite where the scheme has no limit of its own,
/// since it grows at any step that nothing damps.
template <class I, class P>
[[gnu::cold]] TimeStep stable_step(P const& physics, [[maybe_unused]] double spacing, Stiffness const& stiffness,
                                   [[maybe_unused]] double dt)
{
    TimeStep stable;
    if constexpr (has_equation_of_state<P>)
        if (spacing > 0) {
            const WorstWave w = worst_wave(physics, spacing, dt, &I::growth);
            if (I::imaginary_limit > 0) stable.bound(I::imaginary_limit / w.frequency, "acoustic");
            if (w.decay > 0) stable.bound(I::real_limit / w.decay, "viscous");
        }
    if (I::imaginary_limit > 0 && stiffness.contact_frequency > 0)
        stable.bound(I::imaginary_limit / stiffness.contact_frequency, "contact");
    return stable;
}

/// One sentence for each limit that a step passes: of sound and viscosity on the lattice of the particles (of an undamped
/// oscillation, for contacts). docs/models/time_integration.md.
/// \tparam I  integrator    \param spacing  of the particles [m]; 0: none yet    \param dt  [s]
template <class I, class P>
[[gnu::cold]] std::vector<std::string> advice(P const& physics, [[maybe_unused]] double spacing,
                                              Stiffness const& stiffness, double dt)
{
    std::vector<std::string> warnings;
    auto warn = [&](std::string const& w) { warnings.push_back(w); };
    if constexpr (has_equation_of_state<P>) {
        if (!(spacing > 0)) return warnings;
        const WorstWave w = worst_wave(physics, spacing, dt, &I::growth);
        const double z = w.frequency * dt, decay = w.decay * dt;
        if (I::imaginary_limit > 0 && z > I::imaginary_limit)
            warn("dt = " + text(dt) + " s is above the acoustic limit of " + I::name + ", " +
                 text(I::imaginary_limit / w.frequency) + " s: take a smaller dt or cfl");
        if (decay > I::real_limit)
            warn("dt = " + text(dt) + " s is above the viscous limit of " + I::name + ", " +
                 text(I::real_limit / w.decay) + " s: take a smaller dt or cfl");
        if (w.net_growth * dt > 1e-12)
            warn(std::string(I::name) + " lets sound of wavelength " + text(w.wavelength) + " m grow e-fold in " +
                 text(std::ceil(1 / (w.net_growth * dt))) +
                 " steps beyond its damping: take a smaller cfl, Leapfrog, or " +
                 "more ArtificialViscosity or DensityDiffusion");
    }
    if (stiffness.contact_frequency > 0) {
        const double z = stiffness.contact_frequency * dt;
        if (I::growth(z) > 0)
            warn(std::string(I::name) + " multiplies the energy of an undamped contact by " +
                 text(std::exp(2 * std::log1p(I::growth(z)) * std::numbers::pi / z)) +
                 " at this dt: take SymplecticEuler or Leapfrog");
        else if (z > std::numbers::pi / 10)
            warn("the contact is under-resolved: dt = " + text(dt) + " s is above a tenth of the contact time, " +
                 text(std::numbers::pi / stiffness.contact_frequency) + " s");
    }
    return warnings;
}

} // namespace spate
