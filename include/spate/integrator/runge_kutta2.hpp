// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The midpoint method of the seed, done right: positions too move with the velocity of the half step.
#pragma once

#include <cmath>

namespace spate {

/// y' = y + dt/2 f(y); y+ = y + dt f(y'). On the imaginary axis |R|^2 = 1 + z^4/4: amplitudes grow by z^4/8 a step, so
/// long runs need damping; on the negative real axis |z| <= 2. docs/models/time_integration.md (9), (10).
struct RungeKutta2 {
    static constexpr const char* name = "runge_kutta2";
    static constexpr int order = 2;
    static constexpr int evaluations = 2;
    static constexpr bool saves = true;
    static constexpr double ahead_velocity = 0.5;   ///< rates are taken at positions up to x + this v dt ...
    static constexpr double ahead_acceleration = 0; ///< ... + this a dt^2: the second rates are taken at x + dt/2 v
    static constexpr double imaginary_limit = 0;
    static constexpr double real_limit = 2;
    /// Bounded oscillation of the measured energy at z = omega dt, relative: none: it grows.
    static double energy_error(double) { return 0; }
    static double growth(double z) { return std::sqrt(1 + z * z * z * z / 4) - 1; }

    void step(auto& s, double dt) const
    {
        s.save();
        s.rates(s.all);
        s.advance(s.drifting, s.kicked, dt / 2);
        s.rates(s.all, dt);                        // of the whole step
        s.advance_saved(s.drifting, s.kicked, dt); // positions with the velocity of the half step
    }
};

} // namespace spate
