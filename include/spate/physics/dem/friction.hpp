// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Friction of a contact: a tangential spring that slides at the limit of Coulomb.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/term.hpp"
#include "spate/physics/dem/contact.hpp"
#include "spate/physics/dem/normal_law.hpp"

namespace spate {

/// n x the elongation of the tangential spring: the same seen from either side.
inline constexpr struct TangentialSpring : AxialField {
    static constexpr std::string_view name = "tangential_spring", unit = "m";
} tangential_spring{};

/// Friction on given normal forces: xi grows by the slip; G = k_t xi + c_t dxi/dt, at most mu F_n; force n x G, torque a_i G.
/// Docs (12) to (17).
template <class Law>
struct FrictionOn {
    static constexpr Fields reads = Fields{velocity, angular_velocity, radius, mass} | Law::reads;
    static constexpr Fields adds{acceleration, angular_acceleration};
    static constexpr Fields keeps{tangential_spring};
    Law law;
    double mu;        ///< coefficient of friction [-]
    double stiffness; ///< k_t over k_n [-]
    double damping;   ///< c_t over c_n [-]

    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        using V = typename std::remove_cvref_t<decltype(ij)>::value;
        const auto u = slip(i, j, ij);
        const V k = stiffness * law.spring().stiffness(i, j, ij);
        const auto xi = turned(ij.n, value(i[tangential_spring])) + i[elapsed] * u;
        const V limit = max(mu * law.force(i, j, ij), V(0));
        auto trial = k * xi, viscous = V(0) * xi;
        if constexpr (Law::damped) viscous = (damping * law.damping(i, j, ij)) * u, trial += viscous;
        const V g2 = trial.squaredNorm();
        const auto slides = g2 > limit * limit;
        const auto g = where(slides, limit / sqrt(g2), V(1)) * trial;
        i[tangential_spring] = where(slides, (1 / k) * (g - viscous), xi);
        push_across(i, ij, g);
    }
};

/// Cundall & Strack (1979); on the normal forces of the model.
struct Friction {
    double mu;                  ///< coefficient of friction [-]
    double stiffness = 2.0 / 7; ///< of the tangential spring over that of the normal one [-]; 2/7: equal periods
    double damping = 0.5;       ///< of the tangential dashpot over that of the normal one [-]

    auto with(auto const&... all) const
    {
        check();
        const auto law = detail::normal_law(all...);
        return FrictionOn<std::remove_cvref_t<decltype(law)>>{law, mu, stiffness, damping};
    }
    [[gnu::cold]] void check() const
    {
        require_non_negative("Friction.mu", mu, "-");
        require_positive("Friction.stiffness", stiffness, "-");
        require_non_negative("Friction.damping", damping, "-");
    }
};

} // namespace spate
