// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The pressure gradient of the sigma family for any real sigma.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/physics/from_model.hpp"
#include "spate/physics/sph/power.hpp"

#include <tuple>

namespace spate {

// clang-format off
/// (rho/rho0)^(sigma-2) and p/rho0^2 (rho/rho0)^-sigma of the pressure force.
inline constexpr struct PressureWeight : ScalarField   { static constexpr std::string_view name = "pressure_weight"; static constexpr bool derived = true; } pressure_weight{};
inline constexpr struct WeightedPressure : ScalarField { static constexpr std::string_view name = "weighted_pressure", unit = "Pa m^6/kg^2"; static constexpr bool derived = true; } weighted_pressure{};
// clang-format on

/// The weights of each particle, so that no pair takes a power or divides.
struct SigmaPressureWeights {
    static constexpr Fields reads{density, pressure};
    static constexpr Fields writes{pressure_weight, weighted_pressure};
    double sigma; ///< [-]
    double rho0;  ///< reference density [kg/m^3]

    void check() const
    {
        require_finite("SigmaPressure.sigma", sigma, "-");
        require_positive("SigmaPressure.rho0", rho0, "kg/m^3");
    }
    void operator()(auto& i) const
    {
        const auto rho = i[density];
        const auto x = rho * (1 / rho0);
        const auto b = detail::power_of(x, sigma - 2); // rho^-sigma = 1/(rho^2 rho^(sigma-2))
        i[pressure_weight] = b;
        i[weighted_pressure] = i[pressure] / (rho * rho * b);
    }
};
/// dv_i/dt = -sum_j m_j (p_i/(rho_i^sigma rho_j^(2-sigma)) + p_j/(rho_i^(2-sigma) rho_j^sigma)) grad W_ij.
struct SigmaPressureSum {
    static constexpr Fields reads{pressure_weight, weighted_pressure};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{acceleration};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto both = i[weighted_pressure] * j[pressure_weight] + j[weighted_pressure] * i[pressure_weight];
        i[acceleration] -= (j[mass] * both) * ij.grad_w;
    }
};

/// Pressure force (sigma family of the seed):
/// dv_i/dt = -sum_j m_j (p_i/(rho_i^sigma rho_j^(2-sigma)) + p_j/(rho_i^(2-sigma) rho_j^sigma)) grad W_ij.
/// Conserves momentum and angular momentum for every sigma. docs/models/wcsph.md (12).
struct SigmaPressure {
    double sigma;             ///< [-]
    double rho0 = from_model; ///< reference density; cancels [kg/m^3]

    [[nodiscard]] auto terms(auto const&) const
    {
        return std::tuple{SigmaPressureWeights{sigma, rho0}, SigmaPressureSum{}};
    }
};

} // namespace spate
