// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The linear (isothermal) equation of state.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/physics/sph/equation_of_state.hpp"

#include <cmath>

namespace spate {

/// Linear equation of state (Morris, Fox & Zhu 1997, eq. 11): p = c0^2 (rho - rho0).
/// docs/models/wcsph.md (6), (7), (8).
struct LinearEos {
    static constexpr Fields reads{density};
    static constexpr Fields writes{pressure};
    double rho0; ///< reference density [kg/m^3]
    double c0;   ///< speed of sound [m/s]

    [[gnu::cold]] void check() const
    {
        require_positive("LinearEos.rho0", rho0, "kg/m^3");
        require_positive("LinearEos.c0", c0, "m/s");
    }
    void operator()(auto& i) const { i[pressure] = pressure_of(i[density]); }

    template <class V>
    [[gnu::always_inline]] V pressure_of(V const& rho) const
    {
        return V(c0 * c0) * (rho - V(rho0));
    }
    template <class V>
    [[gnu::always_inline]] V density_of(V const& p) const
    {
        return V(rho0) + p * V(1 / (c0 * c0));
    }
    [[nodiscard]] double hydrostatic_density(double gz) const { return rho0 * std::exp(gz / (c0 * c0)); }
    [[nodiscard]] double enthalpy_of(double rho) const { return c0 * c0 * std::log1p((rho - rho0) / rho0); }
    /// e = c0^2 (ln x + 1/x - 1), x = rho/rho0, by its series for small s.
    [[nodiscard]] double energy_of(double rho) const
    {
        const double x = rho / rho0, s = x - 1;
        if (std::abs(s) < 1e-3) return 0.5 * c0 * c0 * s * s * (1 - s * 4 / 3);
        return c0 * c0 * (std::log(x) + 1 / x - 1);
    }
};
static_assert(EquationOfState<LinearEos>);

} // namespace spate
