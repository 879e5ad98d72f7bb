// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief How a fluid meets a wall of markers along it: which velocity of the markers the terms of the model see.
#pragma once

#include "spate/boundary/adami.hpp"
#include "spate/core/fields.hpp"
#include "spate/core/term.hpp"

#include <tuple>

namespace spate {

/// Viscous terms see the fluid's velocity mirrored at the wall's (Adami, Hu & Adams 2012, eq. 23).
inline constexpr struct NoSlip {
} no_slip{};
/// Viscous terms do not see the wall.
inline constexpr struct FreeSlip {
} free_slip{};

// clang-format off
inline constexpr struct VelocitySum : VectorField { static constexpr std::string_view name = "velocity_sum", unit = "m/s/m^dim"; static constexpr bool derived = true; } velocity_sum{};
/// Of a marker: the velocity that makes the mean of it and of the fluid before it the wall's.
inline constexpr struct MirroredVelocity : VectorField { static constexpr std::string_view name = "mirrored_velocity", unit = "m/s"; static constexpr bool derived = true; } mirrored_velocity{};
// clang-format on

/// sum_f W_wf, where the state of the markers does not already need it.
struct KernelSums {
    static constexpr Fields adds{kernel_sum};
    static constexpr Between between{Role::marker, Role::mobile};
    void operator()(auto& i, auto const&, auto const& ij) const { i[kernel_sum] += ij.w; }
};
/// sum_f v_f W_wf.
struct MirrorSums {
    static constexpr Fields reads_j{velocity};
    static constexpr Fields adds{velocity_sum};
    static constexpr Between between{Role::marker, Role::mobile};
    void operator()(auto& i, auto const& j, auto const& ij) const { i[velocity_sum] += ij.w * j[velocity]; }
};
/// 2 v_w - sum_f v_f W_wf / sum_f W_wf (Adami, Hu & Adams 2012, eqs. 22, 23); that of the wall where it sees nothing.
/// docs/models/boundaries.md (6).
struct Mirror {
    static constexpr Fields reads{velocity_sum, kernel_sum, velocity};
    static constexpr Fields writes{mirrored_velocity};
    static constexpr Between between{Role::marker, Role::any};
    double least_sum; ///< kernel sum below which a marker sees nothing [1/m^dim]

    void operator()(auto& i) const
    {
        const auto sum = i[kernel_sum];
        using V = std::remove_cv_t<decltype(sum)>;
        const auto mean = (1 / max(sum, V(least_sum))) * i[velocity_sum];
        const auto v = i[velocity];
        i[mirrored_velocity] = where(sum > least_sum, v + (v - mean), v);
    }
};

namespace detail {
template <class T>
inline constexpr bool is_viscous = requires
{
    requires T::viscous;
};
/// A pair term of mobile targets that reads the velocity of markers.
template <class T>
constexpr bool sees_velocity_of_markers()
{
    if constexpr (PairTerm<T>)
        return between<T>().source != Role::mobile && between<T>().target != Role::marker &&
               decltype(reads_j<T>())::template contains<Velocity>;
    else return false;
}
/// T without the markers as sources.
template <class T>
struct AmongMobile : T {
    static constexpr Between between{spate::between<T>().target, Role::mobile};
};
/// j, whose velocity is the mirrored one.
template <class J>
struct Mirrored {
    J const& j;
    template <Field F>
    [[gnu::always_inline]] decltype(auto) operator[](F f) const
    {
        if constexpr (std::same_as<F, Velocity>) return j[mirrored_velocity];
        else return j[f];
    }
};
/// T on mobile targets with markers as sources, which show their mirrored velocity.
template <class T>
struct AtWall {
    static constexpr auto reads_i = spate::reads_i<T>();
    static constexpr auto reads_j = (spate::reads_j<T>() - Fields{velocity}) | Fields{mirrored_velocity};
    static constexpr auto adds = spate::adds<T>();
    static constexpr Between between{Role::mobile, Role::marker};
    T term;

    [[gnu::always_inline]] void operator()(auto& i, auto const& j, auto const& ij) const
    {
        term(i, Mirrored<std::remove_cvref_t<decltype(j)>>{j}, ij);
    }
};
template <class Terms>
inline constexpr bool any_viscous = false;
template <class... T>
inline constexpr bool any_viscous<std::tuple<T...>> = (is_viscous<T> || ...);
template <class Terms>
inline constexpr bool sum_kernel = false;
template <class... T>
inline constexpr bool sum_kernel<std::tuple<T...>> = (decltype(adds<T>())::template contains<KernelSum> || ...);
} // namespace detail

/// What the terms of a model see of the markers' velocity.
/// \tparam Slip  void: the markers' own velocity; NoSlip, FreeSlip    \tparam Mirrors  every term sees the mirrored one
template <class Slip, bool Mirrors>
struct Tangential {
    template <class T>
    static constexpr bool unseen = std::same_as<Slip, FreeSlip>&& detail::is_viscous<T>&&
    detail::sees_velocity_of_markers<T>();
    template <class T>
    static constexpr bool mirrored = !unseen<T> && (Mirrors || (std::same_as<Slip, NoSlip> && detail::is_viscous<T>)) &&
                                     detail::sees_velocity_of_markers<T>();
    static constexpr bool mirrors = Mirrors || std::same_as<Slip, NoSlip>;

    /// The terms of the model, those that see markers in another way without the markers; as many as there were.
    template <class... T>
    static auto own(std::tuple<T...> const& terms)
    {
        auto one = []<class X>(X const& t) {
            if constexpr (unseen<X> || mirrored<X>) return detail::AmongMobile<X>{t};
            else return t;
        };
        return std::apply([&](auto const&... t) { return std::tuple{one(t)...}; }, terms);
    }
    /// The terms that they have become at the wall, and what makes the mirrored velocity.
    /// \param state  the terms that make the state of the markers
    template <class... T, class State>
    static auto at_wall(std::tuple<T...> const& terms, State const&, double least_sum)
    {
        if constexpr (!mirrors) return std::tuple<>{};
        else {
            auto one = []<class X>(X const& t) {
                if constexpr (mirrored<X>) return std::tuple{detail::AtWall<X>{t}};
                else return std::tuple<>{};
            };
            auto seen = std::apply([&](auto const&... t) { return std::tuple_cat(one(t)...); }, terms);
            if constexpr (detail::sum_kernel<State>)
                return std::tuple_cat(std::tuple{MirrorSums{}, Mirror{least_sum}}, seen);
            else return std::tuple_cat(std::tuple{KernelSums{}, MirrorSums{}, Mirror{least_sum}}, seen);
        }
    }
};

} // namespace spate
