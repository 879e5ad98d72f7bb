// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Symplectic (semi-implicit) Euler: kick, then drift with the new velocity.
#pragma once

namespace spate {

/// v+ = v + dt a(x, rho); x+ = x + dt v+, rho+ = rho + dt rhodot(x, v+). Energy stays bounded to omega dt < 2.
/// Where a drift needs a rate (density), it is a second, dependent sweep. docs/models/time_integration.md (3) to (5).
struct SymplecticEuler {
    static constexpr const char* name = "symplectic_euler";
    static constexpr int order = 1;
    static constexpr int evaluations = 1;
    static constexpr bool saves = false;
    static constexpr double ahead_velocity = 0; ///< rates are taken at positions up to x + this v dt ...
    static constexpr double ahead_acceleration =
        0; ///< ... + this a dt^2: rates are taken at the start of the step only
    static constexpr double imaginary_limit = 2;
    static constexpr double real_limit = 2;
    /// Bounded oscillation of the measured energy at z = omega dt, relative: velocities lag positions by half a step.
    static double energy_error(double z) { return z / 2; }
    static double growth(double) { return 0; }

    void step(auto& s, double dt) const
    {
        s.rates(s.kicked);
        if constexpr (decltype(s.driven)::size > 0) {
            s.advance(s.kicked, dt);
            s.rates(s.driven);
            s.advance(s.drifting, dt);
        }
        else s.advance(s.kicked, s.drifting, dt);
    }
};

} // namespace spate
