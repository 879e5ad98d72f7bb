// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Viscosity along the line of centres: conserves angular momentum.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"

namespace spate {

/// Viscosity (Cleary 1998; Monaghan 2005, eq. 4.4, at one viscosity):
/// dv_i/dt = sum_j m_j 2 (dim + 2) mu / (rho_i rho_j) v_ij . x_ij / (r^2 + 0.01 h^2) grad W_ij.
/// Acts as mu on shear and as 3 mu on compression along a wave. docs/models/wcsph.md (32).
template <int Dim>
struct MonaghanCleary {
    static constexpr Fields reads{velocity, density};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{acceleration};
    static constexpr bool viscous = true;
    double mu; ///< dynamic viscosity [Pa s]

    void check() const { require_non_negative("MonaghanCleary.mu", mu, "Pa s"); }
    /// Of what it damps fastest, a compressive wave [m^2/s].
    [[nodiscard]] double kinematic_viscosity(double rho0, double, int) const { return 3 * mu / rho0; }
    /// Decay of a sound wave, see stability.hpp [m^2/s].
    [[nodiscard]] double acoustic_damping(double rho0, double h, double r2, double xe2) const
    {
        return 2 * (Dim + 2) * mu / rho0 * xe2 / (r2 + 0.01 * h * h);
    }

    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto vx = (i[velocity] - j[velocity]).dot(ij.x);
        const auto f = 2 * (Dim + 2) * mu / (i[density] * j[density]) * vx * ij.over_r2;
        i[acceleration] += f * (j[mass] * ij.grad_w);
    }
};

} // namespace spate
