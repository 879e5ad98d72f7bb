// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Monaghan's artificial pressure against the tensile instability.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/kernel/kernel.hpp"

namespace spate {

/// Tensile correction (Monaghan 2000, eqs. 3.1 to 3.8, with n = 4): dv_i/dt = -sum_j m_j R_ij (W_ij/W(dx))^4 grad W_ij,
/// R_ij = R_i + R_j, R_i = 0.2 |p_i|/rho_i^2 where p_i < 0; 0.01 (p_i/rho_i^2 + p_j/rho_j^2) where both pressures are
/// positive. docs/models/wcsph.md (34).
struct TensileCorrection {
    static constexpr Fields reads{density, pressure};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{acceleration};
    double tension = 0.2;            ///< of a negative pressure [-]
    double compression = 0.01;       ///< of two positive ones [-]
    double w_spacing = from_spacing; ///< W at the spacing [m^-dim]

    void check() const
    {
        require_non_negative("TensileCorrection.tension", tension, "-");
        require_non_negative("TensileCorrection.compression", compression, "-");
        require_positive("TensileCorrection.w_spacing", w_spacing, "m^-dim");
    }
    [[nodiscard]] bool open() const { return w_spacing == from_spacing; }
    void complete(double spacing, auto const& interaction)
    {
        auto const& kernel = interaction.kernel;
        w_spacing = kernel.sigma() * kernel.f(spacing / kernel.h);
    }

    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto v_i = 1 / i[density], v_j = 1 / j[density]; // specific volumes
        const auto e_i = i[pressure] * (v_i * v_i), e_j = j[pressure] * (v_j * v_j);
        const auto pull = max(-1 * e_i, 0) + max(-1 * e_j, 0);
        const auto push = where(min(e_i, e_j) > 0, e_i + e_j, 0);
        const auto f = ij.w * (1 / w_spacing), f2 = f * f;
        i[acceleration] -= ((tension * pull + compression * push) * (f2 * f2)) * (j[mass] * ij.grad_w);
    }
};

} // namespace spate
