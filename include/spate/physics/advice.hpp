// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What stability theory says of an integrator, a model and a step, before the first one: warnings with a cure.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/physics/dem/normal_law.hpp"
#include "spate/physics/sph/stability.hpp"
#include "spate/physics/time_step.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace spate {

namespace detail {
template <class T>
inline constexpr bool damps = is_dashpot<T> || requires(T t)
{
    t.acoustic_damping(1.0, 1.0, 1.0, 1.0);
};
template <class T>
inline constexpr bool sums_pressure = decltype(reads_i<T>() | reads_j<T>())::template contains<Pressure> && //
                                      !std::is_same_v<decltype(adds<T>()), Fields<>>;
} // namespace detail

/// Whether no step is stable, which is known before anything runs: the integrator makes each oscillation grow, the model
/// has one (sound, or the spring of a contact), and no term of it damps. For a static_assert over a scene's own types.
template <class P, class I>
inline constexpr bool unstable_at_every_step = []<class... T>(std::tuple<T...> const*) {
    const bool sound = has_equation_of_state<P> && (detail::sums_pressure<T> || ...);
    return I::imaginary_limit == 0 && (sound || (is_spring<T> || ...)) && !(detail::damps<T> || ...);
}(static_cast<typename P::Terms const*>(nullptr));

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
/// \param density_ratio  of the densest to the thinnest at the start [-]
template <class I, class P>
[[gnu::cold]] std::vector<std::string> advice(P const& physics, [[maybe_unused]] double spacing,
                                              Stiffness const& stiffness, double dt,
                                              [[maybe_unused]] double density_ratio = 1)
{
    std::vector<std::string> warnings;
    auto warn = [&](std::string const& w) { warnings.push_back(w); };
    detail::each_in(physics.terms, [&]<class T>(T const&) {
        if constexpr (requires { T::most_density_ratio; })
            if (density_ratio > T::most_density_ratio)
                warn("densities differ by a factor of " + text(density_ratio) +
                     ", for which sums with sigma = 2 are not made: take Continuity<1> and PressureForce<1>");
    });
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
                 text(std::ceil(1 / (w.net_growth * dt))) + " steps beyond its damping: " +
                 (unstable_at_every_step<P, I> ? "nothing damps it, so no dt is stable: take Leapfrog, or "
                                               : "take a smaller cfl, Leapfrog, or more ") +
                 "ArtificialViscosity or DensityDiffusion");
    }
    if (stiffness.contact_frequency > 0) {
        const double z = stiffness.contact_frequency * dt;
        if (I::growth(z) > 0)
            warn(std::string(I::name) + " multiplies the energy of an undamped contact by " +
                 text(std::exp(2 * std::log1p(I::growth(z)) * std::numbers::pi / z)) + " at this dt" +
                 (unstable_at_every_step<P, I> ? ", and no dt is stable as no Dashpot damps" : "") +
                 ": take SymplecticEuler or Leapfrog");
        else if (z > std::numbers::pi / 10)
            warn("the contact is under-resolved: dt = " + text(dt) + " s is above a tenth of the contact time, " +
                 text(std::numbers::pi / stiffness.contact_frequency) + " s");
    }
    return warnings;
}

} // namespace spate
