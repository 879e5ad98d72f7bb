// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A spring and a dashpot in series with a slider: what they push with across a contact.
#pragma once

#include "spate/core/vec.hpp"

namespace spate {

struct NoDamping {};

/// G = the elastic part + c u, cut to the limit where it is beyond.
template <class G, class V, class C>
struct Sliding {
    decltype(V() < V()) slides; ///< the lanes at the limit
    G g, u;
    [[no_unique_address]] C c;

    /// \param elastic  before the limit [N]    \param u  slip [m/s]    \param damping  gives c [N s/m], or NoDamping
    [[gnu::always_inline]] Sliding(V const& at_most, G const& elastic, G const& slip, auto const& damping)
        : u(slip), c(damping())
    {
        const V limit = max(at_most, V(0));
        G all = elastic;
        if constexpr (!std::same_as<C, NoDamping>) all += c * u;
        const V g2 = all.squaredNorm();
        slides = g2 > limit * limit;
        g = where(slides, limit / sqrt(g2), V(1)) * all;
    }
    /// What of g the spring carries.
    [[gnu::always_inline]] G elastic() const
    {
        if constexpr (std::same_as<C, NoDamping>) return g;
        else return g - c * u;
    }
    /// What the dashpot takes [W].
    [[gnu::always_inline]] V viscous_power() const
    {
        if constexpr (std::same_as<C, NoDamping>) return V(0);
        else return c * u.squaredNorm();
    }
};
template <class V, class G, class D>
Sliding(V, G, G, D) -> Sliding<G, V, std::remove_cvref_t<decltype(std::declval<D const&>()())>>;

} // namespace spate
