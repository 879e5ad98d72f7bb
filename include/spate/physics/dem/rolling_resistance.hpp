// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Resistance to rolling: a spring on the rolling displacement that yields at a limit.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/term.hpp"
#include "spate/physics/dem/dissipation.hpp"
#include "spate/physics/dem/normal_law.hpp"
#include "spate/physics/dem/sliding.hpp"

namespace spate {

/// The rolling displacement of i on j, by the right-hand rule: opposite seen from the other side.
inline constexpr struct RollingSpring : AxialField {
    static constexpr std::string_view name = "rolling_spring", unit = "m";
} rolling_spring{};

/// On given normal forces: drho/dt = R_ij (omega_i - omega_j) across n; Q = k_r rho + c_r drho/dt, at most mu_r F_n; torque
/// -R_ij Q. Docs (18) to (20).
template <class Law, bool Counted = false>
struct RollingResistanceOn {
    static constexpr auto reads = Fields{velocity, angular_velocity, radius, mass} | Law::reads;
    static constexpr auto adds = Fields{angular_acceleration} | detail::counted<Counted>();
    static constexpr Fields keeps{rolling_spring};
    static constexpr bool stores_energy = true;
    Law law;
    double mu;    ///< coefficient of rolling friction [-]
    double share; ///< k_r over k_n [-]
    double loss;  ///< c_r over c_n [-]

    template <class C>
    [[gnu::always_inline]] void operator()(auto& i, auto const& j, C const& ij) const
    {
        const auto k_n = law.spring().stiffness(i, j, ij), k = share * k_n, r = reduced(i[radius], j[radius]);
        const auto u = r * across(ij.n, i[angular_velocity] - j[angular_velocity]);
        const auto rho = turned(ij.n, value(i[rolling_spring])) + i[elapsed] * u;
        const auto s = Sliding(
            mu * law.force(i, j, ij), k * rho, u, [&]() __attribute__((always_inline)) {
                if constexpr (Law::damped) return loss * law.damping(i, j, k_n);
                else return NoDamping{};
            });
        i[rolling_spring] = s.yields * rho;
        i[angular_acceleration] -= (r / (inertia<C::dim> * i[mass] * i[radius] * i[radius])) * s.g;
        detail::lose<Counted>(
            i, ij, [&]() __attribute__((always_inline)) { return s.losses(k, rho, u, i[elapsed]); });
    }
    /// Elastic energy of the rolling spring [J].
    [[nodiscard]] double energy(auto const& i, auto const& j, auto const& ij) const
    {
        return 0.5 * share * law.spring().stiffness(i, j, ij) * value(i[rolling_spring]).squaredNorm();
    }
};

/// Luding (2008), on the normal forces of the model.
struct RollingResistance {
    double mu;                  ///< coefficient of rolling friction: the limit of the torque over R_ij F_n [-]
    double stiffness = 2.0 / 7; ///< of the rolling spring over that of the normal one [-]
    double damping = 0.5;       ///< of the rolling dashpot over that of the normal one [-]

    template <class... All>
    auto with(All const&... all) const
    {
        check();
        const auto law = detail::normal_law(all...);
        return RollingResistanceOn<std::remove_cv_t<decltype(law)>, counts_losses<All...>>{law, mu, stiffness, damping};
    }
    [[gnu::cold]] void check() const
    {
        require_non_negative("RollingResistance.mu", mu, "-");
        require_positive("RollingResistance.stiffness", stiffness, "-");
        require_non_negative("RollingResistance.damping", damping, "-");
    }
};

} // namespace spate
