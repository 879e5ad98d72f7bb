// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The undamped linear contact spring of the granular seed.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/physics/dem/restitution.hpp"

#include <cmath>

namespace spate {

/// Linear spring (Cundall & Strack 1979, normal part): m_i dv_i/dt = sum_j k overlap_ij n_ij. Contact of two equal
/// masses: omega = sqrt(2 k / m), t_c = pi / omega. docs/models/dem.md (3) to (7).
struct LinearSpring {
    static constexpr Fields reads_i{mass};
    static constexpr Fields adds{acceleration};
    double k; ///< contact stiffness [N/m]

    [[gnu::cold]] void check() const { require_positive("LinearSpring.k", k, "N/m"); }
    /// Angular frequency of a contact between two particles of mass m [kg]: [1/s].
    [[nodiscard]] double contact_frequency(double m) const { return std::sqrt(2 * k / m); }

    static constexpr bool stores_energy = true;
    /// Elastic energy of a contact [J].
    [[nodiscard]] double energy(auto const& ij) const { return ij.overlap > 0 ? 0.5 * k * ij.overlap * ij.overlap : 0; }

    // What other terms of a contact build on.
    static constexpr bool normal = true;
    /// Damping over the critical one for a coefficient of restitution e [-].
    [[nodiscard]] static double damping(double e) { return damping_ratio(e); }
    [[nodiscard]] static double damping_without_pull(double e) { return damping_ratio_without_pull(e); }
    [[gnu::always_inline]] auto stiffness(auto const&, auto const&, auto const& ij) const
    {
        return typename std::remove_cvref_t<decltype(ij)>::value(k);
    }
    [[gnu::always_inline]] auto force(auto const&, auto const&, auto const& ij) const { return k * ij.overlap; }

    void operator()(auto& i, auto const&, auto const& ij) const
    {
        i[acceleration] += (k / i[mass] * ij.overlap) * ij.n;
    }
};

} // namespace spate
