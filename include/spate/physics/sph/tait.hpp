// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Tait's equation of state with exponent 7.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/physics/sph/equation_of_state.hpp"

#include <cmath>

namespace spate {

/// Tait (Monaghan 1994, eq. 3.2; Cole 1948): p = B ((rho/rho0)^7 - 1), B = rho0 c0^2 / 7.
/// Computed as B s(7 + s(21 + ...)), s = (rho - rho0)/rho0: exact near s = 0 in float too, and without libm.
/// docs/models/wcsph.md (5), (7), (8).
struct Tait {
    static constexpr Fields reads{density};
    static constexpr Fields writes{pressure};
    double rho0; ///< reference density [kg/m^3]
    double c0;   ///< speed of sound at rho0 [m/s]; ten times the fastest flow keeps density within 1 %

    static constexpr double gamma = 7;
    /// Largest rho/rho0 that a run may have [-]. Water keeps to the law up to 1.4 (Cole 1948); at 3, where p = 2186 B, a run
    /// has left all that it was set up for, and rho^7 is still far from the largest float.
    static constexpr double most_compression = 3;
    [[nodiscard]] double stiffness() const { return rho0 * c0 * c0 / gamma; } ///< B [Pa]
    [[gnu::cold]] void check() const
    {
        require_positive("Tait.rho0", rho0, "kg/m^3");
        require_positive("Tait.c0", c0, "m/s");
    }
    void operator()(auto& i) const { i[pressure] = pressure_of(i[density]); }

    template <class V>
    [[gnu::always_inline]] V pressure_of(V const& rho) const
    {
        const V s = (rho - V(rho0)) * V(1 / rho0);
        return V(stiffness()) * (s * (7 + s * (21 + s * (35 + s * (35 + s * (21 + s * (7 + s)))))));
    }
    /// rho = rho0 (1 + p/B)^(1/7): the eighth root by square roots, then five steps of Newton to the seventh.
    template <class V>
    [[gnu::always_inline]] V density_of(V const& p) const
    {
        const V x = 1 + p * V(1 / stiffness());
        V y = sqrt(sqrt(sqrt(x)));
        for (int k = 0; k < 5; ++k) {
            const V y2 = y * y, y6 = y2 * y2 * y2;
            y = y - (y6 * y - x) / (7 * y6);
        }
        return V(rho0) * y;
    }
    /// dp = rho d(gz) integrated: rho = rho0 (1 + 6 gz / (7 B/rho0))^(1/6).
    [[nodiscard]] double hydrostatic_density(double gz) const
    {
        return rho0 * std::pow(1 + (gamma - 1) * gz * rho0 / (gamma * stiffness()), 1 / (gamma - 1));
    }
    /// Integral of dp/rho from rho0 = 7/6 (B/rho0) ((rho/rho0)^6 - 1), factored: exact near rho0 too.
    [[nodiscard]] double enthalpy_of(double rho) const
    {
        const double x = rho / rho0, s = (rho - rho0) / rho0;
        return gamma * stiffness() / ((gamma - 1) * rho0) * s * (x + 1) * (x * x + x + 1) * (x * x - x + 1);
    }
    /// e = integral of p/rho^2 from rho0 = (B/rho0) ((x^6 - 1)/6 + 1/x - 1), x = rho/rho0, by its series for small s.
    [[nodiscard]] double energy_of(double rho) const
    {
        const double x = rho / rho0, s = x - 1;
        if (std::abs(s) < 1e-3) return 0.5 * c0 * c0 * s * s * (1 + s * 2 / 3);
        return stiffness() / rho0 * ((std::pow(x, 6) - 1) / 6 + 1 / x - 1);
    }
};
static_assert(EquationOfState<Tait>);

} // namespace spate
