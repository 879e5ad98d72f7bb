// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Density as a sum over the neighbours, in place of continuity.
#pragma once

#include "spate/core/fields.hpp"
#include "spate/core/term.hpp"

namespace spate {

/// Summation density (Monaghan 1992, eq. 2.10): rho_i = sum_j m_j W_ij, i itself and wall markers among j. Mass is exact;
/// at a free surface density falls to half. Continuity<2> is its time derivative. docs/models/wcsph.md (35).
struct SummationDensity {
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{density};
    static constexpr Between between{Role::mobile, Role::any};
    static constexpr bool self = true;
    void operator()(auto& i, auto const& j, auto const& ij) const { i[density] += j[mass] * ij.w; }
};

} // namespace spate
