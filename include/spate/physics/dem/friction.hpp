// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Friction of a contact: a tangential spring that slides at the limit of Coulomb.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/term.hpp"
#include "spate/physics/dem/dissipation.hpp"
#include "spate/physics/dem/normal_law.hpp"
#include "spate/physics/dem/sliding.hpp"

namespace spate {

/// n x the elongation of the tangential spring: the same seen from either side.
inline constexpr struct TangentialSpring : AxialField {
    static constexpr std::string_view name = "tangential_spring", unit = "m";
} tangential_spring{};

/// Friction on given normal forces: dxi/dt = the slip; G = k_t xi + c_t dxi/dt, at most mu F_n; force n x G, torque a_i G.
/// Docs (12) to (17).
template <class Law, bool Counted = false>
struct FrictionOn {
    static constexpr auto reads = Fields{velocity, angular_velocity, radius, mass} | Law::reads;
    static constexpr auto adds = Fields{acceleration, angular_acceleration} | detail::counted<Counted>();
    static constexpr Fields keeps{tangential_spring};
    static constexpr bool stores_energy = true;
    Law law;
    double mu;    ///< coefficient of friction [-]
    double share; ///< k_t over k_n [-]
    double loss;  ///< c_t over c_n [-]

    [[gnu::always_inline]] void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto k_n = law.spring().stiffness(i, j, ij), k = share * k_n;
        const auto u = slip(i, j, ij);
        const auto xi = turned(ij.n, value(i[tangential_spring])) + i[elapsed] * u;
        const auto s = Sliding(
            mu * law.force(i, j, ij), k * xi, u, [&]() __attribute__((always_inline)) {
                if constexpr (Law::damped) return loss * law.damping(i, j, k_n);
                else return NoDamping{};
            });
        i[tangential_spring] = s.yields * xi;
        push_across(i, ij, s.g);
        detail::lose<Counted>(
            i, ij, [&]() __attribute__((always_inline)) { return s.losses(k, xi, u, i[elapsed]); });
    }
    /// Elastic energy of the tangential spring [J].
    [[nodiscard]] double energy(auto const& i, auto const& j, auto const& ij) const
    {
        return 0.5 * share * law.spring().stiffness(i, j, ij) * value(i[tangential_spring]).squaredNorm();
    }
};

/// Cundall & Strack (1979), on the normal forces of the model.
struct Friction {
    double mu;                  ///< coefficient of friction [-]
    double stiffness = 2.0 / 7; ///< of the tangential spring over that of the normal one [-]; 2/7: equal periods
    double damping = 0.5;       ///< of the tangential dashpot over that of the normal one [-]

    template <class... All>
    auto with(All const&... all) const
    {
        check();
        const auto law = detail::normal_law(all...);
        return FrictionOn<std::remove_cv_t<decltype(law)>, counts_losses<All...>>{law, mu, stiffness, damping};
    }
    [[gnu::cold]] void check() const
    {
        require_non_negative("Friction.mu", mu, "-");
        require_positive("Friction.stiffness", stiffness, "-");
        require_non_negative("Friction.damping", damping, "-");
    }
};

} // namespace spate
