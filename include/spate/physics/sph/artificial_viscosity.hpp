// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Monaghan's artificial viscosity.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/physics/from_model.hpp"

namespace spate {

/// Artificial viscosity (Monaghan 1992, eqs. 4.1, 4.2, with beta = 0): dv_i/dt = -sum_j m_j Pi_ij grad W_ij,
/// Pi_ij = -alpha c0 mu_ij / rho for approaching pairs, else 0; mu_ij = h v_ij . x_ij / (r^2 + 0.01 h^2),
/// rho = (rho_i + rho_j)/2. On all pairs it would act as a kinematic viscosity of alpha c0 h / (2 (dim + 2)); on those
/// that approach it acts as half of that in shear. docs/models/wcsph.md (16).
struct ArtificialViscosity {
    static constexpr Fields reads{velocity, density};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{acceleration};
    /// Walls of no_slip and free_slip mean it.
    static constexpr bool viscous = true;

    double alpha;           ///< [-], Monaghan 1992: 0.01 to 0.1
    double c0 = from_model; ///< speed of sound [m/s]

    [[gnu::cold]] void check() const
    {
        require_non_negative("ArtificialViscosity.alpha", alpha, "-");
        require_positive("ArtificialViscosity.c0", c0, "m/s");
    }
    /// [m^2/s]
    [[nodiscard]] double kinematic_viscosity(double, double h, int dim) const
    {
        return alpha * c0 * h / (2 * (dim + 2));
    }
    /// Decay of a sound wave, see stability.hpp; half, since it acts on approaching pairs only [m^2/s].
    [[nodiscard]] double acoustic_damping(double, double h, double r2, double xe2) const
    {
        return 0.5 * alpha * c0 * h * xe2 / (r2 + 0.01 * h * h);
    }

    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto vx = (i[velocity] - j[velocity]).dot(ij.x);
        const auto mu = min(vx, 0) * ij.h * ij.over_r2; // 0 where the pair parts
        const auto rho = 0.5 * (i[density] + j[density]);
        i[acceleration] += (alpha * c0 * mu * (1 / rho)) * (j[mass] * ij.grad_w);
    }
};

} // namespace spate
