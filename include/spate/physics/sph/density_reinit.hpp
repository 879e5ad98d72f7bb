// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Density made smooth again each few steps: by Shepard's average or by moving least squares.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/term.hpp"
#include "spate/physics/rows.hpp"

#include <tuple>

namespace spate {

/// How a density is averaged: exact for a constant, or for a linear field.
struct Shepard {};
struct Mls {};

// clang-format off
/// sum V W, sum m W; with xi = x_ij/h: sum V W xi, sum m W xi, and the rows of sum V W xi (x) xi.
inline constexpr struct ReinitVolume : ScalarField      { static constexpr std::string_view name = "reinit_volume"; static constexpr bool derived = true; } reinit_volume{};
inline constexpr struct ReinitMass : ScalarField        { static constexpr std::string_view name = "reinit_mass", unit = "kg/m^3"; static constexpr bool derived = true; } reinit_mass{};
inline constexpr struct ReinitVolumeFirst : VectorField { static constexpr std::string_view name = "reinit_volume_first"; static constexpr bool derived = true; } reinit_volume_first{};
inline constexpr struct ReinitMassFirst : VectorField   { static constexpr std::string_view name = "reinit_mass_first", unit = "kg/m^3"; static constexpr bool derived = true; } reinit_mass_first{};
// clang-format on
namespace detail {
inline constexpr std::string_view reinit_rows[] = {"reinit_volume_second_0", "reinit_volume_second_1",
                                                   "reinit_volume_second_2"};
} // namespace detail
template <int k>
struct ReinitVolumeSecond : VectorField {
    static constexpr std::string_view name = detail::reinit_rows[k];
    static constexpr bool derived = true;
};

/// Sums over the fluid, i itself too; V_j = m_j/rho_j of the density before.
template <class How, int Dim>
struct ReinitSums;
template <int Dim>
struct ReinitSums<Shepard, Dim> {
    static constexpr Fields reads_j{mass, density};
    static constexpr Fields adds{reinit_volume, reinit_mass};
    static constexpr Between between{Role::mobile, Role::mobile};
    static constexpr bool self = true;
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        i[reinit_volume] += j[mass] / j[density] * ij.w;
        i[reinit_mass] += j[mass] * ij.w;
    }
};
template <int Dim>
struct ReinitSums<Mls, Dim> {
    static constexpr Fields reads_j{mass, density};
    static constexpr auto adds =
        Fields{reinit_volume, reinit_mass, reinit_volume_first, reinit_mass_first} | rows_of<ReinitVolumeSecond, Dim>();
    static constexpr Between between{Role::mobile, Role::mobile};
    static constexpr bool self = true;
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto V_w = j[mass] / j[density] * ij.w, m_w = j[mass] * ij.w;
        const auto xi = (1 / ij.h) * ij.x;
        i[reinit_volume] += V_w;
        i[reinit_mass] += m_w;
        i[reinit_volume_first] += V_w * xi;
        i[reinit_mass_first] += m_w * xi;
        each_row(
            rows_of<ReinitVolumeSecond, Dim>(), [&](auto row, int k)
                                                    __attribute__((always_inline)) { i[row] += (V_w * xi[k]) * xi; });
    }
};

template <class How, int Dim>
struct ReinitDensity;
/// rho_i = sum m W / sum V W.
template <int Dim>
struct ReinitDensity<Shepard, Dim> {
    static constexpr Fields reads{reinit_volume, reinit_mass};
    static constexpr Fields writes{density};
    static constexpr When when = When::after_step;
    static constexpr bool writes_energy = true; ///< no force does the work: it goes into a ledger
    int every;
    void check() const { require(every >= 1, "DensityReinit.every", every, "1 or above [steps]"); }
    void operator()(auto& i) const { i[density] = i[reinit_mass] / i[reinit_volume]; }
};
/// rho_i = sum m W (beta_0 + beta . xi), beta = A^-1 e_1, A = sum V W (1, xi) (x) (1, xi); where A is near singular (its
/// pivots differ by a million or more: too few neighbours, or all in a plane) Shepard's.
template <int Dim>
struct ReinitDensity<Mls, Dim> {
    static constexpr auto reads = ReinitSums<Mls, Dim>::adds;
    static constexpr Fields writes{density};
    static constexpr When when = When::after_step;
    static constexpr bool writes_energy = true; ///< no force does the work: it goes into a ledger
    int every;
    void check() const { require(every >= 1, "DensityReinit.every", every, "1 or above [steps]"); }
    void operator()(auto& i) const
    {
        const auto volume = i[reinit_volume], m = i[reinit_mass];
        const auto first = i[reinit_volume_first], m_first = i[reinit_mass_first];
        using V = std::remove_cv_t<decltype(volume)>;
        V A[std::size_t(Dim) + 1][std::size_t(Dim) + 1], beta[std::size_t(Dim) + 1];
        A[0][0] = volume;
        beta[0] = V(1);
        for (int c = 0; c < Dim; ++c) A[0][c + 1] = A[c + 1][0] = first[c], beta[c + 1] = V(0);
        each_row(
            rows_of<ReinitVolumeSecond, Dim>(), [&](auto row, int k) __attribute__((always_inline)) {
                const auto second = i[row];
                for (int c = 0; c < Dim; ++c) A[k + 1][c + 1] = second[c];
            });
        const Factored<Dim + 1, V> factors(A);
        factors.solve(beta);
        V rho = beta[0] * m;
        for (int c = 0; c < Dim; ++c) rho = rho + beta[c + 1] * m_first[c];
        i[density] = where(factors.least() > V(1e-6) * factors.most(), rho, m / volume);
    }
};

/// Density re-initialisation after each `every` steps, `DensityReinit<Mls>{.every = 20}`: by Shepard (Randles & Libersky
/// 1996) or by moving least squares (Belytschko et al. 1996; Colagrossi & Landrini 2003, sec. 2.3). Fluid only; mass is
/// not touched, energy is not conserved. docs/models/wcsph.md (37), (38).
template <class How>
struct DensityReinit {
    int every = 20; ///< steps

    template <class I>
    [[nodiscard]] auto terms(I const&) const
    {
        return std::tuple{ReinitSums<How, I::dim>{}, ReinitDensity<How, I::dim>{every}};
    }
};

} // namespace spate
