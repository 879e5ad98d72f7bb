// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Continuity by the sigma family.
#pragma once

#include "spate/core/fields.hpp"

namespace spate {

/// Continuity (Monaghan 1994, eq. 2.1; sigma family of the seed): d rho_i/dt = sum_j m_j v_ij . grad W_ij
/// / (rho_i^(sigma-2) rho_j^(2-sigma)). Energy is conserved only with PressureForce of the same sigma.
/// docs/models/wcsph.md (9) to (11).
template <int Sigma>
struct Continuity;

/// sigma = 2: d rho_i/dt = sum_j m_j v_ij . grad W_ij, the exact time derivative of sum_j m_j W_ij.
template <>
struct Continuity<2> {
    static constexpr Fields reads{velocity};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{density_rate};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        i[density_rate] += (j[mass] * ij.grad_w).dot(i[velocity] - j[velocity]);
    }
};
/// sigma = 1: d rho_i/dt = rho_i sum_j m_j/rho_j v_ij . grad W_ij, for density jumps (Colagrossi & Landrini 2003).
template <>
struct Continuity<1> {
    static constexpr Fields reads{velocity, density};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{density_rate};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto V_j = j[mass] * (1 / j[density]);
        i[density_rate] += i[density] * V_j * (i[velocity] - j[velocity]).dot(ij.grad_w);
    }
};

} // namespace spate
