// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief XSPH: particles move with a velocity nearer to that of their neighbours.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/core/term.hpp"

namespace spate {

/// XSPH (Monaghan 1989, eq. 2.6): dx_i/dt = v_i + eps sum_j m_j (v_j - v_i) W_ij / rho, rho = (rho_i + rho_j)/2.
/// Conserves momentum: sum m dx/dt = sum m v. Fluid only. docs/models/wcsph.md (36).
struct Xsph {
    static constexpr Fields reads{velocity, density};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{transport_velocity};
    static constexpr Between between{Role::mobile, Role::mobile};
    double eps = 0.5; ///< [-]; below 1, so that no particle moves faster than its neighbours

    void check() const { require(eps >= 0 && eps < 1, "Xsph.eps", eps, "0 or above, and below 1 [-]"); }
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto rho = 0.5 * (i[density] + j[density]);
        i[transport_velocity] += (eps * j[mass] * ij.w * (1 / rho)) * (j[velocity] - i[velocity]);
    }
};

} // namespace spate
