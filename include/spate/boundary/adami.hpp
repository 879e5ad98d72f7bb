// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Wall markers whose pressure is extrapolated from the particles in front of them.
#pragma once

#include "spate/core/term.hpp"

#include <tuple>

namespace spate {

// clang-format off
/// Shepard sums of a marker over the particles in front of it.
inline constexpr struct KernelSum : ScalarField { static constexpr std::string_view name = "kernel_sum", unit = "1/m^dim"; static constexpr bool derived = true; } kernel_sum{};
inline constexpr struct PressureSum : ScalarField { static constexpr std::string_view name = "pressure_sum", unit = "Pa/m^dim"; static constexpr bool derived = true; } pressure_sum{};
// clang-format on

/// Extrapolation (Adami, Hu & Adams 2012, eq. 27, numerator): sum_f (p_f + rho_f (g - a_w) . x_wf) W_wf.
/// docs/models/boundaries.md (3).
/// \tparam Moves  the markers carry an acceleration a_w; else it is 0
template <int Dim, bool Moves = false>
struct AdamiSums {
    static constexpr auto reads_i = []() {
        if constexpr (Moves) return Fields{acceleration};
        else return Fields<>{};
    }();
    static constexpr Fields reads_j{pressure, density};
    static constexpr Fields adds{pressure_sum, kernel_sum};
    static constexpr Between between{Role::marker, Role::mobile};
    Vec<Dim, double> g; ///< gravity [m/s^2]

    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        auto along = [&](int c) __attribute__((always_inline))
        {
            if constexpr (Moves) return (g[c] - i[acceleration][c]) * ij.x[c];
            else return g[c] * ij.x[c];
        };
        auto gx = along(0);
        for (int c = 1; c < Dim; ++c) gx = gx + along(c);
        i[pressure_sum] += (j[pressure] + j[density] * gx) * ij.w;
        i[kernel_sum] += ij.w;
    }
};

/// p_w = sum / sum_f W_wf, rho_w from it by the equation of state (eqs. 27, 28); a marker that sees next to nothing is at
/// rest pressure. docs/models/boundaries.md (4).
template <class E>
struct AdamiState {
    static constexpr Fields reads{pressure_sum, kernel_sum};
    static constexpr Fields writes{pressure, density};
    static constexpr Between between{Role::marker, Role::any};
    E eos;
    double least_sum;                     ///< kernel sum below which a marker sees nothing [1/m^dim]
    double least;                         ///< lower bound of the pressure [Pa]; -inf: none
    double at_rest = eos.density_of(0.0); ///< of a marker that sees nothing [kg/m^3]

    void operator()(auto& i) const
    {
        const auto sum = i[kernel_sum];
        using V = std::remove_cv_t<decltype(sum)>;
        const auto wet = sum > least_sum;
        if (!any(wet)) { // most markers of a tank that is nearly empty
            i[pressure] = V(0);
            i[density] = V(at_rest);
            return;
        }
        const V seen = max(sum, V(least_sum));
        const V p = where(wet, max(i[pressure_sum] / seen, V(least)), V(0));
        i[pressure] = p;
        i[density] = eos.density_of(p);
    }
};

namespace detail {
template <class T>
concept GivesDensity = requires(T const t)
{
    t.density_of(1.0);
};
template <class Terms>
inline constexpr bool any_gives_density = false;
template <class... T>
inline constexpr bool any_gives_density<std::tuple<T...>> = (GivesDensity<T> || ...);
} // namespace detail

/// State of wall markers by extrapolation.
struct Adami {
    static constexpr const char* name = "adami";
    static constexpr Fields fields{density, pressure};
    bool suction = true; ///< false: wall pressure is cut at 0, so that a wall can push but not pull

    /// \tparam Moves  whether the markers carry an acceleration
    template <bool Moves = false, class P>
    [[nodiscard]] auto terms(P const& physics) const
    {
        static_assert(detail::any_gives_density<typename P::Terms>,
                      "spate: Adami needs an equation of state in the model, such as Tait{.rho0, .c0}");
        constexpr int dim = P::dim;
        auto const& eos = equation_of_state(physics);
        auto const& kernel = physics.interaction.kernel;
        using E = std::remove_cvref_t<decltype(eos)>;
        const double none = -std::numeric_limits<double>::max();
        return std::tuple{AdamiSums<dim, Moves>{gravity_of(physics)},
                          AdamiState<E>{eos, 1e-6 * kernel.sigma() * kernel.f(0.0), suction ? none : 0.0}};
    }
};

} // namespace spate
