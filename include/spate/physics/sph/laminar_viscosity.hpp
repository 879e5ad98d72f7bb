// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Laminar viscosity of the seed (Morris form).
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"

namespace spate {

/// Laminar viscosity (Morris, Fox & Zhu 1997, eq. 22, with the seed's mean density):
/// dv_i/dt = sum_j m_j 2 mu x_ij . grad W_ij v_ij / (rho^2 (r^2 + eps h^2)), rho = (rho_i + rho_j)/2.
/// Conserves linear, not angular momentum. docs/models/wcsph.md (15).
struct LaminarViscosity {
    static constexpr Fields reads{velocity, density};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{acceleration};
    /// Walls of no_slip and free_slip mean it.
    static constexpr bool viscous = true;

    double mu;         ///< dynamic viscosity [Pa s]
    double eps = 0.01; ///< keeps the quotient finite at r = 0 [-]; costs 1 to 2 % of mu; 0 is allowed off coincidence

    [[gnu::cold]] void check() const
    {
        require_non_negative("LaminarViscosity.mu", mu, "Pa s");
        require_non_negative("LaminarViscosity.eps", eps, "-");
    }
    /// [m^2/s]
    [[nodiscard]] double kinematic_viscosity(double rho0, double, int) const { return mu / rho0; }
    /// Decay of a sound wave, see stability.hpp [m^2/s].
    [[nodiscard]] double acoustic_damping(double rho0, double h, double r2, double) const
    {
        return 2 * mu / rho0 * r2 / (r2 + eps * h * h);
    }

    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto rho = 0.5 * (i[density] + j[density]);
        const auto f = 2 * mu / (rho * rho * (ij.r2 + eps * (ij.h * ij.h)));
        i[acceleration] += (f * (j[mass] * ij.grad_w).dot(ij.x)) * (i[velocity] - j[velocity]);
    }
};

} // namespace spate
