// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Continuity of the sigma family for any real sigma.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/physics/from_model.hpp"
#include "spate/physics/sph/power.hpp"

#include <tuple>

namespace spate {

// clang-format off
/// (rho/rho0)^(sigma-2) of the continuity equation.
inline constexpr struct ContinuityWeight : ScalarField { static constexpr std::string_view name = "continuity_weight"; static constexpr bool derived = true; } continuity_weight{};
// clang-format on

/// The weight of each particle, so that no pair takes a power.
struct SigmaContinuityWeight {
    static constexpr Fields reads{density};
    static constexpr Fields writes{continuity_weight};
    double sigma; ///< [-]
    double rho0;  ///< reference density [kg/m^3]

    void check() const
    {
        require_finite("SigmaContinuity.sigma", sigma, "-");
        require_positive("SigmaContinuity.rho0", rho0, "kg/m^3");
    }
    void operator()(auto& i) const
    {
        const auto rho = i[density];
        i[continuity_weight] = detail::power_of(rho * (1 / rho0), sigma - 2);
    }
};
/// d rho_i/dt = sum_j m_j v_ij . grad W_ij rho_i^(2-sigma) rho_j^(sigma-2).
struct SigmaContinuitySum {
    static constexpr Fields reads{velocity, continuity_weight};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{density_rate};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto over_i = 1 / i[continuity_weight]; // once for all neighbours
        i[density_rate] += (over_i * j[continuity_weight]) * (j[mass] * ij.grad_w).dot(i[velocity] - j[velocity]);
    }
};

/// Continuity (sigma family of the seed): d rho_i/dt = sum_j m_j v_ij . grad W_ij / (rho_i^(sigma-2) rho_j^(2-sigma)).
/// Sigma of 1 and 2 are cheaper as Continuity<1> and <2>. Energy is conserved only with SigmaPressure of the same sigma.
/// docs/models/wcsph.md (9).
struct SigmaContinuity {
    double sigma;             ///< [-]
    double rho0 = from_model; ///< reference density; cancels [kg/m^3]

    [[nodiscard]] auto terms(auto const&) const
    {
        return std::tuple{SigmaContinuityWeight{sigma, rho0}, SigmaContinuitySum{}};
    }
};

} // namespace spate
