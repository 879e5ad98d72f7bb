// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A physics: an interaction and the terms that act through it, put together from plain values.
#pragma once

#include "spate/core/particles.hpp"
#include "spate/core/term.hpp"
#include "spate/physics/transport.hpp"

#include <tuple>

namespace spate {

// clang-format off
template <class I>
concept Interaction = requires(I const i) {
    { I::dim } -> std::convertible_to<int>;
    { I::reads };                                 // fields of both sides that the geometry of a pair needs
    { i.range() } -> std::convertible_to<double>; // no pair beyond [m]
    { i.length() } -> std::convertible_to<double>; // length of the time-step criteria [m]
    i.check();
};
// clang-format on

namespace detail {
template <class T>
inline constexpr bool is_uniform = false;
template <class F>
inline constexpr bool is_uniform<Uniform<F>> = true;

template <class T>
constexpr auto uniform_field(Uniform<T> const*)
{
    return Fields<T>{};
}
template <class T>
constexpr auto uniform_field(T const*)
{
    return Fields<>{};
}

/// All but the Uniform entries; what says `terms(interaction)` stands for those terms.
template <class I>
auto only_terms(I const& interaction, auto const&... t)
{
    return std::tuple_cat([&](auto const& x) {
        if constexpr (is_uniform<std::remove_cvref_t<decltype(x)>>) return std::tuple<>{};
        else if constexpr (requires { x.terms(interaction); }) return x.terms(interaction);
        else return std::tuple{x};
    }(t)...);
}
/// With the particles' own velocity, where a term corrects the velocity that positions follow.
template <class... T>
auto with_own_velocity(std::tuple<T...> terms)
{
    if constexpr ((decltype(adds<T>())::template contains<TransportVelocity> || ... || false))
        return std::tuple_cat(terms, std::tuple{OwnVelocity{}});
    else return terms;
}
template <class Tuple>
void each_in(Tuple& t, auto&& f) // quicker to compile than std::apply
{
    [&]<std::size_t... k>(std::index_sequence<k...>) { (f(std::get<k>(t)), ...); }
    (std::make_index_sequence<std::tuple_size_v<std::remove_const_t<Tuple>>>{});
}
} // namespace detail

/// \tparam I  the interaction    \tparam U  the uniform fields    \tparam T  the terms
template <class I, class U, class... T>
struct Physics {
    static_assert(Interaction<I>,
                  "spate: the first argument of a physics is an interaction, such as Smoothing or Discs");
    static_assert((Term<T> && ...),
                  "spate: a term is called with one particle, `void operator()(auto& i) const`, or with "
                  "a pair, `void operator()(auto& i, auto const& j, auto const& ij) const`");
    static constexpr int dim = I::dim;
    using Terms = std::tuple<T...>;
    static constexpr std::remove_cv_t<U> uniform{};

    I interaction;
    Terms terms;
    Record<dim, double, std::remove_cv_t<U>> uniforms{}; ///< their values

    /// Whether a part leaves something to the spacing of the particles: it says `open()`, and takes it by
    /// `complete(spacing)`, a term by `complete(spacing, interaction)`.
    [[nodiscard]] bool open() const
    {
        bool any = false;
        auto ask = [&](auto const& part) {
            if constexpr (requires { part.open(); }) any = any || part.open();
        };
        ask(interaction);
        detail::each_in(terms, ask);
        return any;
    }
    /// Itself with what was left to the spacing [m]; what was given stays.
    [[nodiscard]] Physics at(double spacing) const
    {
        Physics p = *this;
        auto complete = [](auto& part, auto const&... known) {
            if constexpr (requires { part.open(); })
                if (part.open()) part.complete(known...);
        };
        complete(p.interaction, spacing);
        std::apply([&](auto&... t) { (complete(t, spacing, p.interaction), ...); }, p.terms);
        return p;
    }
    /// Throws BadInput for the first parameter out of range.
    [[gnu::cold]] void check() const
    {
        interaction.check();
        detail::each_in(terms, [](auto const& t) {
            if constexpr (requires { t.check(); }) t.check();
        });
    }
};

/// Puts an interaction and terms together; `Uniform{mass, 0.1}` among them makes a field uniform.
template <class I, class... A>
auto physics(I interaction, A... a)
{
    constexpr auto uniform = (Fields<>{} | ... | detail::uniform_field(static_cast<A const*>(nullptr)));
    return [&]<class... T>(std::tuple<T...> terms) {
        Physics<I, Set<uniform>, T...> p{interaction, terms, {}};
        auto set = [&](auto const& x) {
            if constexpr (detail::is_uniform<std::remove_cvref_t<decltype(x)>>) p.uniforms[x.field] = x.value;
        };
        (set(a), ...);
        return p;
    }(detail::with_own_velocity(detail::only_terms(interaction, a...)));
}

} // namespace spate
