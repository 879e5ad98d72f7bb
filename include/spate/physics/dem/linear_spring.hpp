// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The undamped linear contact spring of the granular seed.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"

#include <cmath>

namespace spate {

/// Linear spring (Cundall & Strack 1979, normal part): m_i dv_i/dt = sum_j k overlap_ij n_ij. Contact of two equal
/// masses: omega = sqrt(2 k / m), t_c = pi / omega. docs/models/dem.md (3) to (7).
struct LinearSpring {
    static constexpr Fields reads_i{mass};
    static constexpr Fields adds{acceleration};
    double k; ///< contact stiffness [N/m]

    [[gnu::cold]] void check() const { require_non_negative("LinearSpring.k", k, "N/m"); }
    /// Angular frequency of a contact between two particles of mass m [kg]: [1/s].
    [[nodiscard]] double contact_frequency(double m) const { return std::sqrt(2 * k / m); }

    static constexpr bool stores_energy = true;
    /// Elastic energy of a contact [J].
    [[nodiscard]] double energy(auto const& ij) const { return ij.overlap > 0 ? 0.5 * k * ij.overlap * ij.overlap : 0; }

    void operator()(auto& i, auto const&, auto const& ij) const
    {
        i[acceleration] += (k * ij.overlap / i[mass]) * ij.n;
    }
};

} // namespace spate
