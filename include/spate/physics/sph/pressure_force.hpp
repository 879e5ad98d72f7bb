// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The pressure gradient by the sigma family.
#pragma once

#include "spate/core/fields.hpp"

namespace spate {

/// Pressure force (Monaghan 1992, eq. 3.3; sigma family of the seed):
/// dv_i/dt = -sum_j m_j (p_i/(rho_i^sigma rho_j^(2-sigma)) + p_j/(rho_i^(2-sigma) rho_j^sigma)) grad W_ij.
/// docs/models/wcsph.md (12) to (14).
template <int Sigma>
struct PressureForce;

/// sigma = 2: dv_i/dt = -sum_j m_j (p_i/rho_i^2 + p_j/rho_j^2) grad W_ij.
template <>
struct PressureForce<2> {
    static constexpr double most_density_ratio = 10; ///< at a jump the heavy side pushes by V^2 of the light one [-]
    static constexpr Fields reads{density, pressure};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{acceleration};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto v_i = 1 / i[density], v_j = 1 / j[density]; // specific volumes
        i[acceleration] -= (i[pressure] * (v_i * v_i) + j[pressure] * (v_j * v_j)) * (j[mass] * ij.grad_w);
    }
};
/// sigma = 1: dv_i/dt = -sum_j m_j (p_i + p_j)/(rho_i rho_j) grad W_ij.
template <>
struct PressureForce<1> {
    static constexpr Fields reads{density, pressure};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{acceleration};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto v_i = 1 / i[density], v_j = 1 / j[density]; // specific volumes
        i[acceleration] -= (j[mass] * (i[pressure] + j[pressure]) * (v_i * v_j)) * ij.grad_w;
    }
};

} // namespace spate
