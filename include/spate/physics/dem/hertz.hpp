// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The elastic contact of spheres.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/physics/dem/contact.hpp"
#include "spate/physics/dem/restitution.hpp"

#include <limits>

namespace spate {

/// An elastic material.
struct Elastic {
    double young;   ///< Young's modulus [Pa]
    double poisson; ///< Poisson's ratio [-]

    [[nodiscard]] double shear() const { return young / (2 * (1 + poisson)); }
    [[gnu::cold]] void check() const
    {
        require(young > 0, "Elastic.young", young, "above 0 [Pa]");
        require(poisson > -1 && poisson <= 0.5, "Elastic.poisson", poisson, "above -1 and at most 0.5 [-]");
    }
};
/// What nothing deforms.
inline constexpr Elastic rigid{std::numeric_limits<double>::infinity(), 0};

/// Hertz: m_i dv_i/dt = sum_j 4/3 E* sqrt(R_ij) overlap^(3/2) n. Docs (21).
struct Hertz {
    static constexpr Fields reads{radius};
    static constexpr Fields reads_i{mass};
    static constexpr Fields adds{acceleration};
    static constexpr bool normal = true, stores_energy = true;
    double modulus;   ///< E* of the two materials [Pa]
    double shear = 0; ///< G* of them, which Mindlin needs [Pa]

    /// Of two materials; of a grain and a wall of material b.
    [[nodiscard, gnu::cold]] static Hertz of(Elastic const& a, Elastic const& b)
    {
        a.check(), b.check();
        auto soft = [](Elastic const& x) { return (1 - x.poisson * x.poisson) / x.young; };
        auto soft_across = [](Elastic const& x) { return (2 - x.poisson) / x.shear(); };
        return {1 / (soft(a) + soft(b)), 1 / (soft_across(a) + soft_across(b))};
    }
    [[nodiscard, gnu::cold]] static Hertz of(Elastic const& both) { return of(both, both); }

    [[gnu::cold]] void check() const
    {
        require_positive("Hertz.modulus", modulus, "Pa");
        require_non_negative("Hertz.shear", shear, "Pa");
    }
    /// So that a 25th of its contact time is 0.15 of the Rayleigh time of a sphere of mass m [kg] and radius R [m], of the
    /// material of which two have these moduli: [1/s]. Docs (28).
    [[nodiscard]] double contact_frequency(double m, double R) const
    {
        const double q = modulus / shear, nu = shear > 0 ? (q - 4) / (q - 2) : 0.3, G = modulus * (1 - nu);
        const double density = m / (4.0 / 3 * std::numbers::pi * R * R * R);
        const double rayleigh = std::numbers::pi * R * std::sqrt(density / G) / (0.1631 * nu + 0.8766);
        return std::numbers::pi / (25 * 0.15 * rayleigh);
    }
    /// Elastic energy of a contact [J].
    [[nodiscard]] double energy(auto const& i, auto const& j, auto const& ij) const
    {
        return 8.0 / 15 * modulus * std::sqrt(reduced(i[radius], j[radius]) * ij.overlap) * ij.overlap * ij.overlap;
    }

    /// Damping over the critical one at each overlap, for a coefficient of restitution e [-]: Tsuji, Tanaka & Ishida 1992.
    [[nodiscard]] static double damping(double e) { return std::sqrt(5.0 / 6) * damping_ratio(e); }
    [[nodiscard]] static double damping_without_pull(double)
    {
        throw BadInput("Dashpot.tail", "cut", "Tail::pulls with Hertz, for which its damping is known");
    }
    /// dF/d overlap [N/m].
    [[gnu::always_inline]] auto stiffness(auto const& i, auto const& j, auto const& ij) const
    {
        return 2 * modulus * sqrt(reduced(i[radius], j[radius]) * ij.overlap);
    }
    /// Of the tangential spring [N/m].
    [[gnu::always_inline]] auto stiffness_across(auto const& i, auto const& j, auto const& ij) const
    {
        return 8 * shear * sqrt(reduced(i[radius], j[radius]) * ij.overlap);
    }
    [[gnu::always_inline]] auto force(auto const& i, auto const& j, auto const& ij) const
    {
        return 4.0 / 3 * modulus * sqrt(reduced(i[radius], j[radius]) * ij.overlap) * ij.overlap;
    }
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        i[acceleration] += (1 / i[mass] * force(i, j, ij)) * ij.n;
    }
};

} // namespace spate
