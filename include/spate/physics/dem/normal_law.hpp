// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The terms of a model that push along the normal of a contact, taken together: what limits friction, and what a
/// dashpot or a tangential spring takes its stiffness from.
#pragma once

#include "spate/core/term.hpp"

#include <tuple>

namespace spate {

/// A term with force(i, j, ij) [N] along n; a spring also has stiffness(i, j, ij) [N/m], a dashpot damping(i, j, ij) [N s/m].
template <class T>
inline constexpr bool is_normal = requires
{
    requires T::normal;
};

template <class... T>
struct NormalLaw {
    static constexpr auto reads = (Fields<>{} | ... | (reads_i<T>() | reads_j<T>()));
    std::tuple<T...> terms;

    [[gnu::always_inline]] auto force(auto const& i, auto const& j, auto const& ij) const
    {
        return std::apply(
            [&](auto const&... t) __attribute__((always_inline)) { return (t.force(i, j, ij) + ...); }, terms);
    }
    auto const& spring() const { return std::get<0>(terms); }
    static constexpr bool damped = (requires { T::dashpot; } || ...);
    /// Of the dashpot [N s/m].
    [[gnu::always_inline]] auto damping(auto const& i, auto const& j, auto const& ij) const requires(damped)
    {
        return std::get<1>(terms).damping(i, j, ij);
    }
};

namespace detail {
/// A term of a contact completed by the other terms of its model.
template <class T, class... All>
auto completed(T const& t, All const&... all)
{
    if constexpr (requires { t.with(all...); }) return t.with(all...);
    else return t;
}
/// The spring of a model.
template <class... All>
constexpr int springs = (0 + ... + int(is_normal<All> && requires { All::stores_energy; }));
template <class First, class... Rest>
auto const& spring_of(First const& first, Rest const&... rest)
{
    if constexpr (is_normal<First> && requires { First::stores_energy; }) return first;
    else return spring_of(rest...);
}
template <class T, class... All>
auto other_normal(T const& t, All const&... all)
{
    if constexpr (is_normal<T> && !requires { T::stores_energy; }) return std::tuple{completed(t, all...)};
    else return std::tuple<>{};
}
/// Spring, dashpot and whatever else is normal, completed.
template <class... All>
auto normal_law(All const&... all)
{
    static_assert(springs<All...> == 1,
                  "spate: a dashpot and friction take their stiffness from the spring of the model; "
                  "name one, LinearSpring or Hertz, in dem(...)");
    return [&]<class... T>(std::tuple<T...> terms) {
        return NormalLaw<T...>{terms};
    }(std::tuple_cat(std::tuple{spring_of(all...)}, other_normal(all, all...)...));
}
} // namespace detail

} // namespace spate
