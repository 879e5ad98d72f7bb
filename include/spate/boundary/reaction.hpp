// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The force of the fluid on each marker: every term that accelerates the fluid by a marker, with its sign turned.
#pragma once

#include "spate/core/term.hpp"

#include <tuple>

namespace spate {

/// What the fluid does to a marker.
inline constexpr struct Push : VectorField {
    static constexpr std::string_view name = "push", unit = "N";
    static constexpr bool derived = true;
} push{};

namespace detail {
/// The fluid particle as the target of a term: what the term reads is the particle's, what it adds is ours.
template <class J, class X>
struct Pushed {
    J const& j;
    X& added;
    template <Field F>
    [[gnu::always_inline]] decltype(auto) operator[](F f) const
    {
        if constexpr (std::same_as<F, Acceleration>) return (added);
        else return j[f];
    }
};
/// T on mobile targets by markers, as the markers feel it: -m_f times the acceleration that it gives to f, pair by pair and
/// to the last bit, so that nothing is lost between fluid and wall.
template <class T>
struct Reaction {
    static constexpr auto reads_i = spate::reads_j<T>();
    static constexpr auto reads_j = spate::reads_i<T>() | Fields{mass};
    static constexpr Fields adds{push};
    static constexpr Between between{Role::marker, Role::mobile};
    T term;

    [[gnu::always_inline]] void operator()(auto& i, auto const& j, auto const& ij) const
    {
        auto ji = ij;
        ji.x = -ij.x, ji.grad_w.x = -ij.grad_w.x;
        auto a = ij.x - ij.x; // zero
        const Pushed<std::remove_cvref_t<decltype(j)>, decltype(a)> fluid{j, a};
        term(fluid, i, ji);
        i[push] -= j[mass] * a;
    }
};
template <class T>
constexpr bool accelerates_by_markers()
{
    if constexpr (PairTerm<T>)
        return between<T>().target != Role::marker && between<T>().source != Role::mobile &&
               decltype(spate::adds<T>())::template contains<Acceleration>;
    else return false;
}
/// The reactions of those of the terms that have one.
template <class... T>
auto reactions_of(std::tuple<T...> const& terms)
{
    auto one = []<class X>(X const& t) {
        if constexpr (accelerates_by_markers<X>()) {
            static_assert(decltype(spate::adds<X>())::size == 1,
                          "spate: a body floats on terms that add to the acceleration alone");
            return std::tuple{Reaction<X>{t}};
        }
        else return std::tuple<>{};
    };
    return std::apply([&](auto const&... t) { return std::tuple_cat(one(t)...); }, terms);
}
} // namespace detail

} // namespace spate
