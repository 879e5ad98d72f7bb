// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The terms of a model that push along the normal of a contact, taken together: what limits friction, and what a
/// dashpot or a tangential spring takes its stiffness from.
#pragma once

#include "spate/core/term.hpp"
#include "spate/physics/dem/contact.hpp"

#include <tuple>

namespace spate {

/// A term with force(i, j, ij) [N] along n. A spring has stiffness(i, j, ij) [N/m] and stores energy; a dashpot has
/// damping(i, j, ij) [N s/m].
template <class T>
inline constexpr bool is_normal = requires
{
    requires T::normal;
};
template <class T>
inline constexpr bool is_spring = is_normal<T>&& requires
{
    requires T::stores_energy;
};

template <class T>
inline constexpr bool is_dashpot = requires
{
    requires T::dashpot;
};

/// A spring, then the other normal terms.
template <class... T>
struct NormalLaw {
    static constexpr auto reads = (Fields<>{} | ... | (reads_i<T>() | reads_j<T>()));
    static constexpr bool damped = (false || ... || is_dashpot<T>);
    std::tuple<T...> terms;

    auto const& spring() const { return std::get<0>(terms); }
    [[gnu::always_inline]] auto force(auto const& i, auto const& j, auto const& ij) const
    {
        return [&]<std::size_t... t>(std::index_sequence<t...>) __attribute__((always_inline))
        {
            return (std::get<t>(terms).force(i, j, ij) + ...);
        }
        (std::make_index_sequence<sizeof...(T)>{});
    }
    /// Of the dashpot; or of one like it for a spring of another stiffness [N s/m].
    [[gnu::always_inline]] auto damping(auto const&... of) const requires(damped)
    {
        constexpr std::size_t at = [] {
            std::size_t k = 0, found = 0;
            ((found = is_dashpot<T> ? k : found, ++k), ...);
            return found;
        }();
        return std::get<at>(terms).damping(of...);
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
template <class First, class... Rest>
auto const& first_spring(First const& first, Rest const&... rest)
{
    if constexpr (is_spring<First>) return first;
    else return first_spring(rest...);
}
template <class... All>
auto const& spring_of(All const&... all)
{
    static_assert((0 + ... + int(is_spring<All>)) == 1,
                  "spate: a dashpot and friction take their stiffness from the spring of the model; name one, "
                  "LinearSpring or Hertz, in dem(...)");
    return first_spring(all...);
}
template <class T, class... All>
auto other_normal(T const& t, All const&... all)
{
    if constexpr (is_normal<T> && !is_spring<T>) return std::tuple{completed(t, all...)};
    else return std::tuple<>{};
}
template <class... T>
auto law_of(std::tuple<T...> terms)
{
    return NormalLaw<T...>{terms};
}
/// The normal terms of a model, completed.
template <class... All>
auto normal_law(All const&... all)
{
    return law_of(std::tuple_cat(std::tuple{spring_of(all...)}, other_normal(all, all...)...));
}
} // namespace detail

} // namespace spate
