// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A spring and a dashpot that slide at a limit: what they push with across a contact.
#pragma once

#include "spate/core/vec.hpp"

namespace spate {

struct NoDamping {};

/// k xi + c u, and where it is beyond the limit both alike less: the spring keeps what it holds.
template <class V, class G, class C>
struct Sliding {
    V yields; ///< 1 below the limit; else the limit over what spring and dashpot would push with [-]
    G g;      ///< what they push with [N]
    [[no_unique_address]] C c;

    /// \param spring  k xi [N]    \param u  slip [m/s]    \param damping  gives c [N s/m], or NoDamping
    [[gnu::always_inline]] Sliding(V const& at_most, G const& spring, G const& u, auto const& damping) : c(damping())
    {
        const V limit = max(at_most, V(0));
        G trial = spring;
        if constexpr (!std::same_as<C, NoDamping>) trial += c * u;
        const V g2 = trial.squaredNorm();
        yields = where(g2 > limit * limit, limit * (sqrt(g2) * (1 / g2)), V(1)); // limit/|G|, with less to wait for
        g = yields * trial;
    }
    /// What the dashpot takes, and what slides of a spring of stiffness k and elongation xi within a time [W].
    [[gnu::always_inline]] V losses(V const& k, G const& xi, G const& u, V const& time) const
    {
        V power = 0.5 * k * (1 - yields * yields) * xi.squaredNorm() / max(time, 1e-300);
        if constexpr (!std::same_as<C, NoDamping>) power += yields * c * u.squaredNorm();
        return power;
    }
};
template <class V, class G, class D>
Sliding(V, G, G, D) -> Sliding<V, G, std::remove_cvref_t<decltype(std::declval<D const&>()())>>;

} // namespace spate
