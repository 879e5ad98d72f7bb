// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Friction of Hertzian contacts: a tangential force that grows with the slip, and slides at the limit of Coulomb.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/term.hpp"
#include "spate/physics/dem/dissipation.hpp"
#include "spate/physics/dem/friction.hpp"
#include "spate/physics/dem/hertz.hpp"
#include "spate/physics/dem/normal_law.hpp"
#include "spate/physics/dem/sliding.hpp"

namespace spate {

/// n x the elastic tangential force: the same seen from either side.
inline constexpr struct TangentialForce : AxialField {
    static constexpr std::string_view name = "tangential_force", unit = "N";
} tangential_force{};

/// On given normal forces: G = T + c_t u, at most mu F_n. Docs (22), (23).
/// \tparam Kept  the force, dT = S_t u dt, or the elongation, T = S_t xi with dxi = u dt; S_t = 8 G* sqrt(R_ij overlap)
template <class Law, Field Kept>
struct MindlinOn {
    static constexpr auto reads = Fields{velocity, angular_velocity, radius, mass} | Law::reads;
    static constexpr Fields adds{acceleration, angular_acceleration};
    static constexpr Fields keeps{Kept{}};
    Law law;
    double mu; ///< coefficient of friction [-]

    [[gnu::always_inline]] void operator()(auto& i, auto const& j, auto const& ij) const
    {
        constexpr bool keeps_force = std::same_as<Kept, TangentialForce>;
        const auto k = law.spring().stiffness_across(i, j, ij);
        const auto u = slip(i, j, ij);
        auto kept = turned(ij.n, value(i[Kept{}]));
        if constexpr (keeps_force) kept += (k * i[elapsed]) * u;
        else kept += i[elapsed] * u;
        auto spring = kept;
        if constexpr (!keeps_force) spring = k * kept;
        const auto s = Sliding(
            mu * law.force(i, j, ij), spring, u, [&]() __attribute__((always_inline)) {
                if constexpr (Law::damped) return law.damping(i, j, ij, k);
                else return NoDamping{};
            });
        i[Kept{}] = s.yields * kept;
        push_across(i, ij, s.g);
    }
};

/// Mindlin's stiffness without slip in the contact.
template <Field Kept>
struct MindlinFriction {
    double mu; ///< coefficient of friction [-]

    template <class... All>
    auto with(All const&... all) const
    {
        check();
        static_assert(std::same_as<std::remove_cvref_t<decltype(detail::spring_of(all...))>, Hertz>,
                      "spate: Mindlin is the friction of Hertz; with LinearSpring name Friction");
        static_assert(!counts_losses<All...>,
                      "spate: the tangential force of Mindlin has no energy, so that no loss can be "
                      "counted; leave Dissipation out, or name LinearSpring and Friction");
        require_positive("Hertz.shear", detail::spring_of(all...).shear, "Pa");
        const auto law = detail::normal_law(all...);
        return MindlinOn<std::remove_cv_t<decltype(law)>, Kept>{law, mu};
    }
    [[gnu::cold]] void check() const { require_non_negative("Mindlin.mu", mu, "-"); }
};
/// Keeps the force, after Di Renzo & Di Maio (2004): slip is pushed back with the stiffness of when it came.
using Mindlin = MindlinFriction<TangentialForce>;
/// Keeps the elongation, after Tsuji, Tanaka & Ishida (1992): all of it is pushed back with the stiffness of now.
using MindlinSpring = MindlinFriction<TangentialSpring>;

} // namespace spate
