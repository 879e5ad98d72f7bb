// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The work that contacts lose, counted by particle: only where a model names Dissipation.
#pragma once

#include "spate/core/fields.hpp"
#include "spate/physics/dem/contact.hpp"

#include <tuple>

namespace spate {

/// Named in a model: dashpots and friction count what they lose. Docs (24) to (26).
struct Dissipation {
    static auto terms(auto const&) { return std::tuple<>{}; } // the others do it
};
template <class... T>
inline constexpr bool counts_losses = (std::same_as<T, Dissipation> || ...);

namespace detail {
template <bool Counted>
constexpr auto counted()
{
    if constexpr (Counted) return Fields{dissipation_rate};
    else return Fields<>{};
}
/// Half of a loss of the pair [W].
template <bool Counted, class C>
[[gnu::always_inline]] inline void lose(auto& i, C const&, auto const& power)
{
    if constexpr (Counted) i[dissipation_rate] += C::share * power();
}
} // namespace detail

} // namespace spate
