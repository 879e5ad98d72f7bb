// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Shifting that takes velocity and density along: a particle that is moved gets what the fluid has at its new place.
#pragma once

#include "spate/physics/sph/gradient_correction.hpp"
#include "spate/physics/sph/shifting.hpp"

namespace spate {

// clang-format off
inline constexpr struct DensitySlope : VectorField { static constexpr std::string_view name = "density_slope", unit = "kg/m^4"; static constexpr bool derived = true; } density_slope{};
// clang-format on

/// sum_j V_j (rho_j - rho_i) grad W_ij.
struct DensitySlopes {
    static constexpr Fields reads{density};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{density_slope};
    static constexpr Between between{Role::mobile, Role::mobile};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        i[density_slope] += (j[mass] / j[density] * (j[density] - i[density])) * ij.grad_w;
    }
};
/// ShiftInside, and f += dx . grad f of velocity and density.
template <int Dim>
struct ShiftAlong : ShiftInside<Dim> {
    static constexpr auto reads = Fields{crowding, position, velocity, density, density_slope} |
                                  rows_of<VelocitySlope, Dim>() | rows_of<Correction, Dim>();
    static constexpr Fields writes{position, velocity, density};

    void operator()(auto& i) const
    {
        const auto s = i[crowding], slope = i[density_slope];
        using V = std::remove_cvref_t<decltype(s[0])>;
        const Vec<Dim, V> d = this->bounded(s), w = along_corrected<Dim, V>(i, d);
        Vec<Dim, V> change{};
        each_row(
            rows_of<VelocitySlope, Dim>(), [&](auto row, int k) __attribute__((always_inline)) {
                const auto g = i[row];
                change[k] = w.dot(g);
            });
        i[velocity] += change;
        i[density] += w.dot(slope);
        i[position] += d;
    }
};

/// Shifting (Sun et al. 2017, eq. 8) with the fields of the new place to first order, v_i += dx_i . grad v and rho_i +=
/// dx_i . grad rho with corrected gradients (the advection of the consistent scheme of Sun et al. 2019): without it velocities
/// are off by what the flow differs over a shift. Goes with GradientCorrection and CorrectedContinuity.
/// docs/models/wcsph.md (39), (47).
struct ConsistentShifting {
    double mach;            ///< fastest flow over c0 [-]
    double cfl = 0.25;      ///< C, of the time step [-]
    double repulsion = 0.2; ///< [-]
    double most = 0.05;     ///< longest shift over the spacing [-]

    template <class I>
    [[nodiscard]] auto terms(I const&) const
    {
        return std::tuple{CrowdingSum{repulsion}, DensitySlopes{}, ShiftAlong<I::dim>{{cfl * mach, most}}};
    }
};

} // namespace spate
