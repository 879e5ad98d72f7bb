// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Forward Euler, kept for comparison: it creates energy at every step size on an undamped oscillator.
#pragma once

#include <cmath>

namespace spate {

/// y+ = y + dt f(y). On the imaginary axis |R|^2 = 1 + z^2: grows at every dt; on the negative real axis |z| <= 2.
/// docs/models/time_integration.md (1), (2).
struct ForwardEuler {
    static constexpr const char* name = "forward_euler";
    static constexpr int order = 1;
    static constexpr int evaluations = 1;       ///< of the rates, a step
    static constexpr bool saves = false;        ///< keeps the start of the step
    static constexpr double ahead_velocity = 0; ///< rates are taken at positions up to x + this v dt ...
    static constexpr double ahead_acceleration =
        0;                                       ///< ... + this a dt^2: rates are taken at the start of the step only
    static constexpr double imaginary_limit = 0; ///< largest stable omega dt without damping
    static constexpr double real_limit = 2;      ///< largest stable rate * dt of a decay
    /// Amplitude growth less 1 over a step, of an undamped oscillation at z = omega dt.
    /// Bounded oscillation of the measured energy at z = omega dt, relative: none: it grows.
    static double energy_error(double) { return 0; }
    static double growth(double z) { return std::sqrt(1 + z * z) - 1; }

    void step(auto& s, double dt) const
    {
        s.rates(s.all);
        s.advance(s.drifting, s.kicked, dt); // positions with the velocity of the start
    }
};

} // namespace spate
