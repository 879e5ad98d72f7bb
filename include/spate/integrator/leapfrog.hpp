// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Leapfrog: kick-drift-kick for forces of position, staggered where density drifts by a rate of its own.
#pragma once

#include <type_traits>

namespace spate {

/// v' = v + dt/2 a; x' = x + dt/2 v'; rho+ = rho + dt rhodot(x', v'); x+ = x' + dt/2 v'; v+ = v' + dt/2 a(x+, rho+).
/// No growth to omega dt < 2. Without a driven field the two half drifts are one: velocity Verlet. The force at the
/// start of a step is that of the end of the last one; continuity and momentum are two dependent sweeps.
/// docs/models/time_integration.md (6) to (8).
struct Leapfrog {
    static constexpr const char* name = "leapfrog";
    static constexpr int order = 2;
    static constexpr int evaluations = 1;
    static constexpr bool saves = false;
    static constexpr double ahead_velocity = 1;       ///< rates are taken at positions up to x + this v dt ...
    static constexpr double ahead_acceleration = 0.5; ///< ... + this a dt^2: the force is taken at its end
    static constexpr bool reflects = true;            ///< off elastic walls after the drift, before forces are taken
    static constexpr double imaginary_limit = 2;
    static constexpr double real_limit = 2;
    /// Bounded oscillation of the measured energy at z = omega dt, relative: of the shadow Hamiltonian.
    static double energy_error(double z) { return z * z / 4; }
    static double growth(double) { return 0; }

    void step(auto& s, double dt) const
    {
        if (!s.kick_rates_current()) s.rates(s.kicked);
        if constexpr (decltype(s.driven)::size > 0) {
            s.advance(s.kicked, s.free, dt / 2);
            s.rates(s.driven);
            s.advance(s.driven, dt);
            s.advance(s.free, dt / 2);
        }
        else {
            s.advance(s.kicked, dt / 2);
            s.advance(s.free, dt);
        }
        if constexpr (std::remove_cvref_t<decltype(s)>::reflects) s.reflect();
        s.rates(s.kicked);
        s.advance(s.kicked, dt / 2);
        s.keep_kick_rates();
    }
};

} // namespace spate
