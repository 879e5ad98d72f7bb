// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Gradients corrected for how particles lie: exact for linear fields on any of them.
#pragma once

#include "spate/core/fields.hpp"
#include "spate/core/term.hpp"
#include "spate/physics/rows.hpp"

#include <tuple>

namespace spate {

namespace detail {
inline constexpr std::string_view moment_rows[] = {"gradient_moment_0", "gradient_moment_1", "gradient_moment_2"};
inline constexpr std::string_view correction_rows[] = {"correction_0", "correction_1", "correction_2"};
inline constexpr std::string_view slope_rows[] = {"velocity_slope_0", "velocity_slope_1", "velocity_slope_2"};
} // namespace detail
template <int k>
struct GradientMoment : VectorField { // row k of M = -sum V_j grad W (x) x_ij
    static constexpr std::string_view name = detail::moment_rows[k];
    static constexpr bool derived = true;
};
template <int k>
struct Correction : VectorField { // row k of L = M^-1
    static constexpr std::string_view name = detail::correction_rows[k];
    static constexpr bool derived = true;
};
template <int k>
struct VelocitySlope : VectorField { // row k of sum V_j v_ji (x) grad W
    static constexpr std::string_view name = detail::slope_rows[k], unit = "1/s";
    static constexpr bool derived = true;
};
// clang-format off
inline constexpr struct PressureSlope : VectorField { static constexpr std::string_view name = "pressure_slope", unit = "Pa/m"; static constexpr bool derived = true; } pressure_slope{};
// clang-format on

/// L^T b, so that (L^T b) . sum V_j f_ji grad W is the derivative of f along b.
template <int Dim, class V>
[[gnu::always_inline]] inline Vec<Dim, V> along_corrected(auto& i, Vec<Dim, V> const& b)
{
    Vec<Dim, V> w{};
    each_row(
        rows_of<Correction, Dim>(), [&](auto row, int k) __attribute__((always_inline)) {
            const auto l = i[row];
            for (int c = 0; c < Dim; ++c) w[c] = w[c] + b[k] * l[c];
        });
    return w;
}

template <int Dim>
struct GradientMoments {
    static constexpr Fields reads_j{mass, density};
    static constexpr auto adds = rows_of<GradientMoment, Dim>();
    static constexpr Between between{Role::mobile, Role::any};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto V_j = j[mass] / j[density];
        each_row(
            adds, [&](auto row, int k) __attribute__((always_inline)) { i[row] -= (V_j * ij.grad_w[k]) * ij.x; });
    }
};
/// L = M^-1; where M is nearly singular (pivots a thousandfold apart: few neighbours, or all in a line) L = 1.
template <int Dim>
struct InvertGradientMoments {
    static constexpr auto reads = rows_of<GradientMoment, Dim>();
    static constexpr auto writes = rows_of<Correction, Dim>();
    static constexpr double worst = 1e3; ///< ratio of pivots [-]
    void operator()(auto& i) const
    {
        using V = std::remove_cvref_t<decltype(i[GradientMoment<0>{}][0])>;
        V a[std::size_t(Dim)][std::size_t(Dim)];
        each_row(
            reads, [&](auto row, int k) __attribute__((always_inline)) {
                const auto m = i[row];
                for (int c = 0; c < Dim; ++c) a[k][c] = m[c];
            });
        const Factored<Dim, V> moments(a);
        const auto regular = moments.least() * V(worst) > moments.most();
        each_row(
            writes, [&](auto row, int k) __attribute__((always_inline)) {
                V e[std::size_t(Dim)];
                for (int c = 0; c < Dim; ++c) e[c] = V(c == k ? 1 : 0);
                moments.solve(e);
                Vec<Dim, V> l;
                for (int c = 0; c < Dim; ++c) l[c] = where(regular, e[c], V(c == k ? 1 : 0));
                i[row] = l;
            });
    }
};
/// For the corrected terms of a model: L_i = (-sum_j V_j grad W_ij (x) x_ij)^-1 (Randles & Libersky 1996;
/// Bonet & Lok 1999). docs/models/wcsph.md (43).
struct GradientCorrection {
    template <class I>
    [[nodiscard]] auto terms(I const&) const
    {
        return std::tuple{GradientMoments<I::dim>{}, InvertGradientMoments<I::dim>{}};
    }
};

template <int Dim>
struct VelocitySlopes {
    static constexpr Fields reads{velocity};
    static constexpr Fields reads_j{mass, density};
    static constexpr auto adds = rows_of<VelocitySlope, Dim>();
    static constexpr Between between{Role::mobile, Role::any};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto g = (j[mass] / j[density]) * ij.grad_w;
        const auto v = j[velocity] - i[velocity];
        each_row(
            adds, [&](auto row, int k) __attribute__((always_inline)) { i[row] += v[k] * g; });
    }
};
template <int Dim>
struct ThinByDivergence {
    static constexpr auto reads = rows_of<VelocitySlope, Dim>() | rows_of<Correction, Dim>() | Fields{density};
    static constexpr Fields adds{density_rate};
    void operator()(auto& i) const
    {
        auto divergence = i[density] * 0;
        each_row(
            rows_of<VelocitySlope, Dim>(), [&](auto row, int k) __attribute__((always_inline)) {
                const auto g = i[row];
                each_row(
                    rows_of<Correction, Dim>(), [&](auto l, int c)
                                                    __attribute__((always_inline)) { divergence += g[c] * i[l][k]; });
            });
        i[density_rate] = i[density_rate] - i[density] * divergence;
    }
};
/// d rho_i/dt = rho_i sum_j V_j v_ij . L_i grad W_ij. docs/models/wcsph.md (44).
struct CorrectedContinuity {
    template <class I>
    [[nodiscard]] auto terms(I const&) const
    {
        return std::tuple{VelocitySlopes<I::dim>{}, ThinByDivergence<I::dim>{}};
    }
};

struct PressureSlopes {
    static constexpr Fields reads{pressure};
    static constexpr Fields reads_j{mass, density};
    static constexpr Fields adds{pressure_slope};
    static constexpr Between between{Role::mobile, Role::any};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        i[pressure_slope] += (j[mass] / j[density] * (j[pressure] - i[pressure])) * ij.grad_w;
    }
};
template <int Dim>
struct PushDownSlope {
    static constexpr auto reads = rows_of<Correction, Dim>() | Fields{pressure_slope, density};
    static constexpr Fields adds{acceleration};
    void operator()(auto& i) const
    {
        const auto s = i[pressure_slope];
        const auto v = 1 / i[density];
        auto a = s;
        each_row(
            rows_of<Correction, Dim>(), [&](auto row, int k)
                                            __attribute__((always_inline)) { a[k] = v * i[row].dot(s); });
        i[acceleration] = i[acceleration] - a;
    }
};
/// dv_i/dt = -1/rho_i sum_j V_j (p_j - p_i) L_i grad W_ij. Momentum and energy are not conserved to rounding, and nothing in it
/// keeps particles apart: it goes with Shifting. docs/models/wcsph.md (45).
struct CorrectedPressureForce {
    template <class I>
    [[nodiscard]] auto terms(I const&) const
    {
        return std::tuple{PressureSlopes{}, PushDownSlope<I::dim>{}};
    }
};

} // namespace spate
