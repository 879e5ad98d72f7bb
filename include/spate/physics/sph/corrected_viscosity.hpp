// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Laminar viscosity without the errors of sums over particles that lie anyhow.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/physics/sph/gradient_correction.hpp"

namespace spate {

// clang-format off
inline constexpr struct ViscousSum : VectorField { static constexpr std::string_view name = "viscous_sum", unit = "Pa/m"; static constexpr bool derived = true; } viscous_sum{};
inline constexpr struct Imbalance : VectorField  { static constexpr std::string_view name = "imbalance", unit = "1/m"; static constexpr bool derived = true; } imbalance{};
// clang-format on

/// sum_j 2 mu V_j F_ij v_ij, grad W = F x: the Laplacian of velocity but for what follows from sum V grad W and from M.
struct ViscousSums {
    static constexpr Fields reads{velocity};
    static constexpr Fields reads_j{mass, density};
    static constexpr Fields adds{viscous_sum};
    static constexpr bool viscous = true;
    double mu; ///< [Pa s]

    [[gnu::cold]] void check() const { require_non_negative("CorrectedViscosity.mu", mu, "Pa s"); }
    [[nodiscard]] double kinematic_viscosity(double rho0, double, int) const { return mu / rho0; }
    [[nodiscard]] double acoustic_damping(double rho0, double, double, double) const { return 2 * mu / rho0; }
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        i[viscous_sum] += (2 * mu * (j[mass] / j[density]) * ij.grad_w.F) * (i[velocity] - j[velocity]);
    }
};
/// sum_j V_j grad W_ij, which is 0 where particles lie evenly.
struct ImbalanceSum {
    static constexpr Fields reads_j{mass, density};
    static constexpr Fields adds{imbalance};
    static constexpr Between between{Role::mobile, Role::any};
    void operator()(auto& i, auto const& j, auto const& ij) const { i[imbalance] += j[mass] / j[density] * ij.grad_w; }
};
template <int Dim>
struct ViscosityOfSums {
    static constexpr auto reads = Fields{viscous_sum, imbalance, density} | rows_of<VelocitySlope, Dim>() |
                                  rows_of<Correction, Dim>() | rows_of<GradientMoment, Dim>();
    static constexpr Fields adds{acceleration};
    double mu;

    void operator()(auto& i) const
    {
        auto trace = i[density] * 0;
        each_row(
            rows_of<GradientMoment, Dim>(), [&](auto row, int k) __attribute__((always_inline)) {
                const auto m = i[row];
                trace = trace + m[k];
            });
        using V = decltype(trace);
        const auto s = i[viscous_sum], b = i[imbalance];
        const Vec<Dim, V> w = along_corrected<Dim, V>(i, b);
        auto a = s;
        each_row(
            rows_of<VelocitySlope, Dim>(), [&](auto row, int k) __attribute__((always_inline)) {
                const auto g = i[row];
                a[k] = s[k] - 2 * mu * w.dot(g);
            });
        i[acceleration] += (Dim / (where(trace > 0.1, trace, V(Dim)) * i[density])) * a;
    }
};

/// Laminar viscosity (Morris, Fox & Zhu 1997, eq. 22, for one mu), less the part of the sum that a linear velocity has
/// (after Fatehi & Manzari 2011) and over the mean second moment: exactly 0 for linear velocity fields on any
/// particles. Goes with GradientCorrection and CorrectedContinuity, whose sums it uses. docs/models/wcsph.md (46).
struct CorrectedViscosity {
    double mu; ///< dynamic viscosity [Pa s]

    template <class I>
    [[nodiscard]] auto terms(I const&) const
    {
        return std::tuple{ViscousSums{mu}, ImbalanceSum{}, ViscosityOfSums<I::dim>{mu}};
    }
};

} // namespace spate
