// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Sets of fields, written as values and known as types: Fields{mass, density} is Fields<Mass, Density>.
/// | & - <= are union, intersection, difference, subset; all of it at compile time.
#pragma once

#include "spate/core/field.hpp"

#include <array>
#include <string>

namespace spate {

template <class... F>
struct Fields {
    static constexpr std::size_t size = sizeof...(F);
    template <class G>
    static constexpr bool contains = (std::same_as<F, std::remove_cv_t<G>> || ...);
    constexpr Fields() = default;
    constexpr explicit Fields(F...) requires(size > 0) {}
};

namespace detail {
template <bool Keep, class F>
constexpr auto kept(F f)
{
    if constexpr (Keep) return Fields<F>{f};
    else return Fields<>{};
}
} // namespace detail

template <class... F>
constexpr auto operator|(Fields<F...> a, Fields<>)
{
    return a;
}
template <class... F, class G, class... R>
constexpr auto operator|(Fields<F...> a, Fields<G, R...>)
{
    if constexpr (Fields<F...>::template contains<G>) return a | Fields<R...>{};
    else return Fields<F..., G>{} | Fields<R...>{};
}
template <class... F, class... G>
constexpr auto operator&(Fields<F...>, Fields<G...>)
{
    return (Fields<>{} | ... | detail::kept<Fields<G...>::template contains<F>>(F{}));
}
template <class... F, class... G>
constexpr auto operator-(Fields<F...>, Fields<G...>)
{
    return (Fields<>{} | ... | detail::kept<!Fields<G...>::template contains<F>>(F{}));
}
/// Subset.
template <class... F, class... G>
constexpr bool operator<=(Fields<F...>, Fields<G...>)
{
    return (Fields<G...>::template contains<F> && ...);
}
template <class... F>
[[gnu::always_inline]] constexpr void for_each(Fields<F...>, auto&& f)
{
    (f(F{}), ...);
}
/// The type of a set given as a value.
template <auto S>
using Set = std::remove_cvref_t<decltype(S)>;

/// {"mass", "density"}: what a test or a file prints.
template <class... F>
constexpr auto names(Fields<F...>)
{
    return std::array<std::string_view, sizeof...(F)>{F::name...};
}
template <class... F>
std::string to_string(Fields<F...> set)
{
    std::string text;
    for (auto name : names(set)) {
        if (!text.empty()) text += ' ';
        text += name;
    }
    return text;
}

/// The field by which F evolves in a species that carries the set S: Fields{} or one field.
template <class F, class S>
constexpr auto rate_in(S carried)
{
    constexpr auto first = []<class... R>(Fields<R...>) {
        auto pick = [](auto self, auto set) {
            if constexpr (decltype(set)::size == 0) return Fields<>{};
            else
                return [&]<class G, class... Q>(Fields<G, Q...>) {
                    if constexpr (S::template contains<G>) return Fields<G>{};
                    else return self(self, Fields<Q...>{});
                }(set);
        };
        return pick(pick, Fields<R...>{});
    };
    (void)carried;
    return first(typename F::rates{});
}
/// The fields of the set S that evolve: those whose rate S carries too.
template <class... F>
constexpr auto evolving(Fields<F...> carried)
{
    return (Fields<>{} | ... | detail::kept<(decltype(rate_in<F>(carried))::size > 0)>(F{}));
}
/// Those of one kind.
template <Kind kind, class... F>
constexpr auto of_kind(Fields<F...>)
{
    return (Fields<>{} | ... | detail::kept<F::kind == kind>(F{}));
}

} // namespace spate
