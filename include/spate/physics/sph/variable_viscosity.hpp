// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Laminar viscosity that each particle carries as a field.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"

namespace spate {

/// Laminar viscosity (Morris, Fox & Zhu 1997, eq. 22, with the seed's mean density) of the field `viscosity`:
/// dv_i/dt = sum_j m_j (mu_i + mu_j) x_ij . grad W_ij v_ij / (rho^2 (r^2 + eps h^2)), rho = (rho_i + rho_j)/2.
/// The field is given at the start or by a term of the user's; `Uniform{viscosity, mu}` makes it one number.
/// docs/models/wcsph.md (33).
struct VariableViscosity {
    static constexpr Fields reads{velocity, density, viscosity};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{acceleration};
    static constexpr bool viscous = true;
    double largest;    ///< the field is nowhere above, for the time step [Pa s]
    double eps = 0.01; ///< keeps the quotient finite at r = 0 [-]

    void check() const
    {
        require_non_negative("VariableViscosity.largest", largest, "Pa s");
        require_non_negative("VariableViscosity.eps", eps, "-");
    }
    /// [m^2/s]
    [[nodiscard]] double kinematic_viscosity(double rho0, double, int) const { return largest / rho0; }

    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto rho = 0.5 * (i[density] + j[density]);
        const auto f = (i[viscosity] + j[viscosity]) / (rho * rho * (ij.r2 + eps * (ij.h * ij.h)));
        i[acceleration] += (f * (j[mass] * ij.grad_w).dot(ij.x)) * (i[velocity] - j[velocity]);
    }
};

} // namespace spate
