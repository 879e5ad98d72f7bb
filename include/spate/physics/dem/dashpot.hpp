// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Damping along the normal of a contact, from the coefficient of restitution.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/term.hpp"
#include "spate/physics/dem/dissipation.hpp"
#include "spate/physics/dem/normal_law.hpp"
#include "spate/physics/dem/restitution.hpp"

namespace spate {

/// What a contact does where spring and dashpot together would pull.
enum class Tail {
    pulls, ///< it pulls until the overlap is zero
    cut    ///< it does not: the force is never below zero
};

/// The dashpot of a given spring: m_i dv_i/dt = -c (v_ij . n) n, c = 2 zeta sqrt(k m_ij). Docs (9) to (11).
template <class Spring, bool Counted = false>
struct DashpotOn {
    static constexpr auto reads = Fields{velocity, mass} | reads_i<Spring>() | reads_j<Spring>();
    static constexpr auto adds = Fields{acceleration} | detail::counted<Counted>();
    static constexpr bool normal = true, dashpot = true;
    Spring spring;
    double zeta = 0; ///< damping over the critical [-]
    Tail tail;

    /// c [N s/m].
    [[gnu::always_inline]] auto damping(auto const& i, auto const& j, auto const& ij) const
    {
        return damping(i, j, ij, spring.stiffness(i, j, ij));
    }
    /// Of a spring of another stiffness beside it.
    [[gnu::always_inline]] auto damping(auto const& i, auto const& j, auto const&, auto const& stiffness) const
    {
        return 2 * zeta * sqrt(stiffness * reduced(i[mass], j[mass]));
    }
    [[gnu::always_inline]] auto force(auto const& i, auto const& j, auto const& ij) const
    {
        using V = typename std::remove_cvref_t<decltype(ij)>::value;
        const V f = V(0) - damping(i, j, ij) * parting(i, j, ij);
        return tail == Tail::pulls ? f : V(max(f, V(0) - spring.force(i, j, ij)));
    }
    [[gnu::always_inline]] void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto f = force(i, j, ij);
        i[acceleration] += (1 / i[mass] * f) * ij.n;
        detail::lose<Counted>(
            i, ij, [&]() __attribute__((always_inline)) { return (0 - f) * parting(i, j, ij); });
    }
};

/// Dashpot with the coefficient of restitution e of a binary collision (Schwager & Poeschel 2007); its stiffness is
/// that of the model's spring.
struct Dashpot {
    static constexpr bool normal = true;
    double e;                ///< coefficient of restitution [-]
    Tail tail = Tail::pulls; ///< e is met either way

    template <class... All>
    auto with(All const&... all) const
    {
        check();
        auto const& spring = detail::spring_of(all...);
        using Spring = std::remove_cvref_t<decltype(spring)>;
        const double zeta = tail == Tail::pulls ? spring.damping(e) : spring.damping_without_pull(e);
        return DashpotOn<Spring, counts_losses<All...>>{spring, zeta, tail};
    }
    [[gnu::cold]] void check() const
    {
        require(e >= 0 && e <= 1, "Dashpot.e", e, "0 to 1 [-]");
        require(e > 0 || tail == Tail::pulls, "Dashpot.e", e,
                "above 0 where the tail is cut [-]: there is always a rebound");
    }
};

} // namespace spate
