// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Shifting: particles are moved a little after each step, from where they crowd to where they are few.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/term.hpp"
#include "spate/kernel/kernel.hpp"
#include "spate/physics/rows.hpp"

#include <tuple>

namespace spate {

// clang-format off
/// The gradient of the concentration of particles, and that of unity, which points inwards at a free surface.
inline constexpr struct Crowding : VectorField     { static constexpr std::string_view name = "crowding", unit = "1/m"; static constexpr bool derived = true; } crowding{};
inline constexpr struct SurfaceSlope : VectorField { static constexpr std::string_view name = "surface_slope", unit = "1/m"; static constexpr bool derived = true; } surface_slope{};
// clang-format on
namespace detail {
inline constexpr std::string_view surface_rows[] = {"surface_moment_0", "surface_moment_1", "surface_moment_2"};
} // namespace detail
template <int k>
struct SurfaceMoment : VectorField { // row k of sum V grad W (x) x_ji: near 1 inside
    static constexpr std::string_view name = detail::surface_rows[k];
    static constexpr bool derived = true;
};

/// sum_j (1 + R (W_ij/W(dx))^4) m_j/(rho_i + rho_j) grad W_ij.
struct CrowdingSum {
    static constexpr Fields reads{density};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{crowding};
    static constexpr Between between{Role::mobile, Role::any};
    double repulsion;                ///< R [-]
    double w_spacing = from_spacing; ///< W at the spacing [m^-dim]

    void check() const
    {
        require_non_negative("Shifting.repulsion", repulsion, "-");
        require_positive("Shifting.w_spacing", w_spacing, "m^-dim");
    }
    [[nodiscard]] bool open() const { return w_spacing == from_spacing; }
    void complete(double spacing, auto const& interaction)
    {
        auto const& kernel = interaction.kernel;
        w_spacing = kernel.sigma() * kernel.f(spacing / kernel.h);
    }
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto f = ij.w * (1 / w_spacing), f2 = f * f;
        i[crowding] += ((1 + repulsion * (f2 * f2)) * (1 / (i[density] + j[density]))) * (j[mass] * ij.grad_w);
    }
};
/// What tells a particle that it lies at a free surface, and which way it faces; walls count as fluid.
template <int Dim>
struct SurfaceSums {
    static constexpr Fields reads_j{mass, density};
    static constexpr auto adds = Fields{surface_slope} | rows_of<SurfaceMoment, Dim>();
    static constexpr Between between{Role::mobile, Role::any};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto V_j = j[mass] / j[density];
        i[surface_slope] += V_j * ij.grad_w;
        each_row(
            rows_of<SurfaceMoment, Dim>(), [&](auto row, int k) __attribute__((always_inline)) {
                i[row] -= (V_j * ij.grad_w[k]) * ij.x;
            });
    }
};

/// dx_i = -C Ma (2h)^2 crowding, no longer than a share of the spacing.
template <int Dim>
struct ShiftInside {
    static constexpr Fields reads{crowding, position};
    static constexpr Fields writes{position};
    static constexpr When when = When::after_step;
    double strength;               ///< C Ma [-]
    double most;                   ///< longest shift over the spacing [-]
    double spacing = from_spacing; ///< [m]
    double h = from_spacing;       ///< smoothing length [m]

    void check() const
    {
        require_non_negative("Shifting.cfl * Shifting.mach", strength, "-");
        require(most >= 0 && most <= 0.5, "Shifting.most", most, "0 to 0.5 [-]");
        require_positive("Shifting.spacing", spacing, "m");
    }
    [[nodiscard]] bool open() const { return spacing == from_spacing; }
    void complete(double of_fill, auto const& interaction) { spacing = of_fill, h = interaction.kernel.h; }

    template <class V>
    [[nodiscard, gnu::always_inline]] Vec<Dim, V> bounded(Vec<Dim, V> const& s) const
    {
        const Vec<Dim, V> d = V(-strength * 4 * h * h) * s;
        const V length = sqrt(d.squaredNorm()), longest = V(most * spacing);
        return where(length > longest, longest / max(length, longest), V(1)) * d;
    }
    void operator()(auto& i) const
    {
        const auto s = i[crowding];
        i[position] += bounded(s);
    }
};
/// The same; where the least eigenvalue of the surface moment is below 0.75, along the surface only.
template <int Dim>
struct ShiftAtSurface : ShiftInside<Dim> {
    static constexpr auto reads = Fields{crowding, surface_slope, position} | rows_of<SurfaceMoment, Dim>();
    static constexpr double threshold = 0.75; ///< of the eigenvalue [-] (Sun et al. 2017, sec. 3.3)

    void operator()(auto& i) const
    {
        const auto s = i[crowding], n = i[surface_slope];
        using V = std::remove_cvref_t<decltype(s[0])>;
        V a[std::size_t(Dim)][std::size_t(Dim)];
        each_row(
            rows_of<SurfaceMoment, Dim>(), [&](auto row, int k) __attribute__((always_inline)) {
                const auto moment = i[row];
                for (int c = 0; c < Dim; ++c) a[k][c] = moment[c] - (c == k ? threshold : 0);
            });
        const V n2 = n.squaredNorm();
        const Vec<Dim, V> along = s - (s.dot(n) / where(n2 > 0, n2, V(1))) * n;
        i[position] += this->bounded(where(Factored<Dim, V>(a).least() > 0, Vec<Dim, V>(s), along));
    }
};

/// Particle shifting (Lind et al. 2012; Sun et al. 2017, eq. 8), after each step:
/// dx_i = -C Ma (2h)^2 sum_j (1 + 0.2 (W_ij/W(dx))^4) m_j/(rho_i + rho_j) grad W_ij, at most dx/20. For flows without a
/// free surface. Velocity and density stay with the particle. docs/models/wcsph.md (39).
struct Shifting {
    double mach;            ///< fastest flow over c0 [-]
    double cfl = 0.25;      ///< C, of the time step [-]
    double repulsion = 0.2; ///< [-]
    double most = 0.05;     ///< longest shift over the spacing [-]

    template <class I>
    [[nodiscard]] auto terms(I const&) const
    {
        return std::tuple{CrowdingSum{repulsion}, ShiftInside<I::dim>{cfl * mach, most}};
    }
};
/// Shifting that keeps to the surface where there is one (least eigenvalue of sum V grad W (x) x_ji below 0.75).
/// docs/models/wcsph.md (39), (40).
struct SurfaceShifting {
    double mach;            ///< fastest flow over c0 [-]
    double cfl = 0.25;      ///< C, of the time step [-]
    double repulsion = 0.2; ///< [-]
    double most = 0.05;     ///< longest shift over the spacing [-]

    template <class I>
    [[nodiscard]] auto terms(I const&) const
    {
        return std::tuple{CrowdingSum{repulsion}, SurfaceSums<I::dim>{}, ShiftAtSurface<I::dim>{{cfl * mach, most}}};
    }
};

} // namespace spate
