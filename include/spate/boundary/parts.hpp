// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The options of a wall of markers: which of them are parts of the wall, and what they say together.
#pragma once

#include "spate/boundary/floating.hpp"
#include "spate/boundary/layers.hpp"
#include "spate/boundary/lid.hpp"
#include "spate/boundary/obstacle.hpp"
#include "spate/boundary/slip.hpp"
#include "spate/core/box.hpp"
#include "spate/core/fields.hpp"

#include <tuple>

namespace spate {

namespace detail {
template <class O, int Dim>
concept EdgeOption = requires(Edges<Dim> e, O const o)
{
    apply(e, o);
};
template <class O>
inline constexpr bool is_lid = false;
template <int Dim>
inline constexpr bool is_lid<Lid<Dim>> = true;
template <class O>
inline constexpr bool is_moving = false;
template <class M>
inline constexpr bool is_moving<Moving<M>> = true;
template <class O>
inline constexpr bool is_obstacle = false;
template <class S, class M>
inline constexpr bool is_obstacle<Obstacle<S, M>> = true;
template <class O>
inline constexpr bool has_law = is_moving<O>;
template <class S, class M>
inline constexpr bool has_law<Obstacle<S, M>> = !std::same_as<M, Still>;
template <class O, int Dim>
inline constexpr bool fits = true;
template <int Other, int Dim>
inline constexpr bool fits<Lid<Other>, Dim> = Other == Dim;
template <class M, int Dim>
inline constexpr bool fits<Moving<M>, Dim> = Motion<M, Dim>;
template <class S, class M, int Dim>
inline constexpr bool fits<Obstacle<S, M>, Dim> = Solid<S, Dim> &&
                                                  (std::same_as<M, Still> || Motion<M, Dim> || is_floating<M>);
template <class S, int Other, int Dim>
inline constexpr bool fits<Obstacle<S, Floating<Other>>, Dim> = Solid<S, Dim>&& Other == Dim;
template <class O>
inline constexpr bool floats = false;
template <class S, int Dim>
inline constexpr bool floats<Obstacle<S, Floating<Dim>>> = true;

/// The options that are parts of the wall, not edges.
template <int Dim, class... O>
auto parts_of(O const&... o)
{
    return std::tuple_cat([](auto const& x) {
        if constexpr (EdgeOption<std::remove_cvref_t<decltype(x)>, Dim>) return std::tuple<>{};
        else return std::tuple{x};
    }(o)...);
}
template <int Dim, class... O>
using PartsOf = decltype(parts_of<Dim>(std::declval<O const&>()...));

/// What a list of parts says, as constants.
template <int Dim, class Parts>
struct Wall;
template <int Dim, class... O>
struct Wall<Dim, std::tuple<O...>> {
    static_assert(((std::same_as<O, NoSlip> || std::same_as<O, FreeSlip> || is_lid<O> || is_moving<O> ||
                    is_obstacle<O> || std::same_as<O, Layers>)&&...),
                  "spate: Bce takes open, periodic, layers, no_slip, free_slip, lid, moving and obstacle as options");
    static_assert((fits<O, Dim> && ...),
                  "spate: a lid, a solid or a law of motion has another number of dimensions than the box of the Bce");
    static constexpr bool no_slip = (std::same_as<O, NoSlip> || ...), free_slip = (std::same_as<O, FreeSlip> || ...);
    static_assert(!(no_slip && free_slip), "spate: walls are no_slip or free_slip; leave one of them out");
    static_assert((int(is_moving<O>) + ... + 0) <= 1, "spate: the walls move by one law; leave one of them out");
    static constexpr bool slides = (is_lid<O> || ...), moves = (has_law<O> || ...);
    static_assert(!(slides && free_slip),
                  "spate: a lid drives nothing where walls are free_slip; take no_slip, or no lid");
    static constexpr int obstacles = (int(is_obstacle<O>) + ... + 0), floating = (int(floats<O>) + ... + 0);
    using Slip = std::conditional_t<no_slip, NoSlip, std::conditional_t<free_slip, FreeSlip, void>>;
};
/// f(part, obstacle) for each obstacle: 1, 2, ...
void each_obstacle(auto const& parts, auto const& f)
{
    [[maybe_unused]] int part = 0;
    auto one = [&]<class O>(O const& o) {
        if constexpr (is_obstacle<O>) f(++part, o);
    };
    std::apply([&](auto const&... o) { (one(o), ...); }, parts);
}
template <bool Keep, class S>
constexpr auto only_if(S set)
{
    if constexpr (Keep) return set;
    else return Fields<>{};
}
} // namespace detail

} // namespace spate
