// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Density diffusion (delta-SPH), on the whole density difference or on its dynamic part.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/core/term.hpp"
#include "spate/physics/from_model.hpp"

#include <cmath>

namespace spate {

/// Density diffusion (Molteni & Colagrossi 2009, eq. 5): d rho_i/dt += delta h c0 sum_j m_j/rho_j psi_ij . grad W_ij,
/// psi_ij = 2 (rho_i - rho_j) x_ij / (r^2 + 0.01 h^2). Drives a drift at a free surface under gravity.
/// Mobile <- mobile only, so that it moves no mass into a wall. docs/models/wcsph.md (17), (18).
struct MolteniColagrossi {
    static constexpr Fields reads{density};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{density_rate};
    static constexpr Between between{Role::mobile, Role::mobile};
    double delta = 0.1;     ///< [-], 0.05 to 0.2
    double c0 = from_model; ///< speed of sound [m/s]

    [[gnu::cold]] void check() const
    {
        require_non_negative("MolteniColagrossi.delta", delta, "-");
        require_positive("MolteniColagrossi.c0", c0, "m/s");
    }
    /// Decay of a sound wave, see stability.hpp [m^2/s].
    [[nodiscard]] double acoustic_damping(double, double h, double r2, double) const
    {
        return 2 * delta * c0 * h * r2 / (r2 + 0.01 * h * h);
    }
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto psi_x = 2 * (i[density] - j[density]) * ij.over_r2; // psi = psi_x x
        i[density_rate] += delta * c0 * ij.h * (1 / j[density]) * psi_x * (j[mass] * ij.grad_w).dot(ij.x);
    }
};

/// Density diffusion of the dynamic part (Fourtakas et al. 2019, eqs. 10-12): as Molteni & Colagrossi with rho_i - rho_j
/// less the hydrostatic difference rho_H = rho0 ((1 + p_H/B)^(1/7) - 1), p_H = rho0 g . x_ij; the default under gravity.
/// The root is its series to third order in p_H/B (error 1e-8 rho0 at p_H/B = 0.02); no gradient pass.
/// docs/models/wcsph.md (19).
template <int Dim>
struct Fourtakas {
    static constexpr Fields reads{density};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{density_rate};
    static constexpr Between between{Role::mobile, Role::mobile};
    double delta = 0.1;       ///< [-], 0.05 to 0.2
    double c0 = from_model;   ///< speed of sound [m/s]
    double rho0 = from_model; ///< reference density [kg/m^3]
    Vec<Dim, double> g{};     ///< gravity [m/s^2]
    double curvature = 0;     ///< gamma - 1 of the equation of state: 6 for Tait, 0 for a linear one

    [[gnu::cold]] void check() const
    {
        require_non_negative("DensityDiffusion.delta", delta, "-");
        require_positive("DensityDiffusion.c0", c0, "m/s");
        require_positive("DensityDiffusion.rho0", rho0, "kg/m^3");
    }
    /// Decay of a sound wave, see stability.hpp [m^2/s].
    [[nodiscard]] double acoustic_damping(double, double h, double r2, double) const
    {
        return 2 * delta * c0 * h * r2 / (r2 + 0.01 * h * h);
    }
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        auto gx = g[0] * ij.x[0];
        for (int c = 1; c < Dim; ++c) gx = gx + g[c] * ij.x[c];
        const auto s = gx * (1 / (c0 * c0)); // p_H / (rho0 c0^2); (1 + gamma s)^(1/gamma) - 1 = s - ...
        const auto rho_H = rho0 * (s * (1 - s * (0.5 * curvature - s * (curvature * (2 * curvature + 1) / 6))));
        const auto psi_x = 2 * ((i[density] - j[density]) - rho_H) * ij.over_r2; // psi = psi_x x
        i[density_rate] += delta * c0 * ij.h * (1 / j[density]) * psi_x * (j[mass] * ij.grad_w).dot(ij.x);
    }
};

/// What a scene writes: `DensityDiffusion{.delta = 0.1}`; the model completes it (Fourtakas with the model's gravity: in a
/// tank that is accelerated by a_w the pressure at rest follows g - a_w, and what is of a_w is diffused like any other).
struct DensityDiffusion {
    double delta = 0.1; ///< [-], 0.05 to 0.2
};

} // namespace spate
