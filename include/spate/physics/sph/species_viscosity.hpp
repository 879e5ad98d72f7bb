// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Laminar viscosity of one species as a source: fluid on fluid, wall on fluid.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/core/term.hpp"

namespace spate {

/// LaminarViscosity of the sources of one role: dv_i/dt = sum_j m_j 2 mu x_ij . grad W_ij v_ij / (rho^2 (r^2 + eps h^2))
/// over j of that role only. `SpeciesViscosity<Role::mobile>` alone leaves the walls smooth (free slip); with
/// `SpeciesViscosity<Role::marker>` they rub with a viscosity of their own. docs/models/wcsph.md (15).
template <Role Source>
struct SpeciesViscosity {
    static constexpr Fields reads{velocity, density};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{acceleration};
    static constexpr bool viscous = true;
    static constexpr Between between{Role::mobile, Source};
    double mu;         ///< dynamic viscosity [Pa s]
    double eps = 0.01; ///< keeps the quotient finite at r = 0 [-]

    void check() const
    {
        require_non_negative("SpeciesViscosity.mu", mu, "Pa s");
        require_non_negative("SpeciesViscosity.eps", eps, "-");
    }
    /// [m^2/s]
    [[nodiscard]] double kinematic_viscosity(double rho0, double, int) const { return mu / rho0; }
    /// Decay of a sound wave, see stability.hpp; a wall damps none of the fluid's inside [m^2/s].
    [[nodiscard]] double acoustic_damping(double rho0, double h, double r2, double) const
    {
        return Source == Role::marker ? 0 : 2 * mu / rho0 * r2 / (r2 + eps * h * h);
    }

    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto rho = 0.5 * (i[density] + j[density]);
        const auto f = 2 * mu / (rho * rho * (ij.r2 + eps * (ij.h * ij.h)));
        i[acceleration] += (f * (j[mass] * ij.grad_w).dot(ij.x)) * (i[velocity] - j[velocity]);
    }
};

} // namespace spate
