// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The model of a weakly compressible fluid: a kernel and its terms; mass is uniform, and what a term leaves
/// open (speed of sound, reference density, gravity) comes from the equation of state and from Gravity.
#pragma once

#include "spate/physics/gravity.hpp"
#include "spate/physics/physics.hpp"
#include "spate/physics/smoothing.hpp"
#include "spate/physics/sph/artificial_viscosity.hpp"
#include "spate/physics/sph/consistent_shifting.hpp"
#include "spate/physics/sph/continuity.hpp"
#include "spate/physics/sph/corrected_viscosity.hpp"
#include "spate/physics/sph/density_diffusion.hpp"
#include "spate/physics/sph/density_reinit.hpp"
#include "spate/physics/sph/gradient_correction.hpp"
#include "spate/physics/sph/laminar_viscosity.hpp"
#include "spate/physics/sph/linear_eos.hpp"
#include "spate/physics/sph/monaghan_cleary.hpp"
#include "spate/physics/sph/pressure_force.hpp"
#include "spate/physics/sph/shifting.hpp"
#include "spate/physics/sph/sigma_continuity.hpp"
#include "spate/physics/sph/sigma_pressure.hpp"
#include "spate/physics/sph/species_viscosity.hpp"
#include "spate/physics/sph/summation_density.hpp"
#include "spate/physics/sph/tait.hpp"
#include "spate/physics/sph/tensile_correction.hpp"
#include "spate/physics/sph/variable_viscosity.hpp"
#include "spate/physics/sph/xsph.hpp"

namespace spate {

namespace detail {
/// The first of the terms that satisfies a predicate on its type.
template <class Pick, class First, class... Rest>
constexpr auto const& first_of(Pick pick, First const& first, Rest const&... rest)
{
    if constexpr (pick.template operator()<First>()) return first;
    else return first_of(pick, rest...);
}
inline constexpr auto is_eos = []<class T>() { return EquationOfState<T>; };

template <int Dim>
struct ModelConstants {
    double rho0 = from_model, c0 = from_model, curvature = 0;
    Vec<Dim, double> g{};
};
template <int Dim, class... T>
ModelConstants<Dim> constants_of(T const&... term)
{
    ModelConstants<Dim> m;
    auto look = [&]<class X>(X const& t) {
        if constexpr (EquationOfState<X>) {
            m.rho0 = t.rho0, m.c0 = t.c0;
            if constexpr (requires { X::gamma; }) m.curvature = X::gamma - 1;
        }
        if constexpr (std::same_as<X, Gravity<Dim>>) m.g += t.g;
    };
    (look(term), ...);
    return m;
}
/// A term with what it left open filled in.
template <int Dim, class X>
auto completed(X t, ModelConstants<Dim> const& m)
{
    if constexpr (std::same_as<X, DensityDiffusion>)
        return Fourtakas<Dim>{.delta = t.delta, .c0 = m.c0, .rho0 = m.rho0, .g = m.g, .curvature = m.curvature};
    else {
        if constexpr (!EquationOfState<X>) {
            if constexpr (requires { t.c0; }) t.c0 = std::isnan(t.c0) ? m.c0 : t.c0;
            if constexpr (requires { t.rho0; }) t.rho0 = std::isnan(t.rho0) ? m.rho0 : t.rho0;
        }
        return t;
    }
}
template <class F, class Terms>
inline constexpr bool any_adds = false;
template <class F, class... T>
inline constexpr bool any_adds<F, std::tuple<T...>> = (decltype(adds<T>())::template contains<F> || ...);
} // namespace detail

/// Weakly compressible SPH: `wcsph(CubicSpline<3>{.h = 1.2 * dx}, Tait{...}, Continuity<2>{}, ...)`.
/// The particles' mass follows from the reference density and the spacing of the first fill.
template <class K, class... T>
auto wcsph(K kernel, T... term)
{
    static_assert(Kernel<K>,
                  "spate: wcsph takes a kernel first: dim, h, radius, sigma(), f(q), g(q); see kernel/kernel.hpp");
    static_assert((int(EquationOfState<T>) + ... + 0) == 1,
                  "spate: wcsph needs exactly one equation of state; add Tait{.rho0, .c0} or LinearEos{.rho0, .c0}");
    const auto m = detail::constants_of<K::dim>(term...);
    const auto fluid = physics(Smoothing<K>{kernel}, Uniform{mass, 0.0}, detail::completed(term, m)...);
    using Terms = typename std::remove_cv_t<decltype(fluid)>::Terms;
    static_assert(!detail::any_adds<Density, Terms> || !detail::any_adds<DensityRate, Terms>,
                  "spate: density is summed or follows continuity; leave out SummationDensity or the terms that add to "
                  "density_rate");
    return fluid;
}

/// The equation of state among the terms of a physics.
template <class P>
requires requires(P p) { p.terms; }
auto const& equation_of_state(P const& physics)
{
    return std::apply(
        [](auto const&... t) -> auto const& { return detail::first_of(detail::is_eos, t...); }, physics.terms);
}
template <class P>
inline constexpr bool has_equation_of_state = []<class... T>(std::tuple<T...> const*) {
    return (EquationOfState<T> || ...);
}(static_cast<typename P::Terms const*>(nullptr));

/// The sum of the Gravity terms of a physics [m/s^2].
template <class P>
Vec<P::dim, double> gravity_of(P const& physics)
{
    Vec<P::dim, double> g{};
    detail::each_in(physics.terms, [&]<class X>(X const& t) {
        if constexpr (std::same_as<X, Gravity<P::dim>>) g += t.g;
    });
    return g;
}

} // namespace spate
