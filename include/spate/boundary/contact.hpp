// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Walls that grains touch: any contact term between a particle and a surface of infinite mass, as one particle
/// term; faces of a box or the surface of a solid, at rest or moving by a law.
#pragma once

#include "spate/boundary/motion.hpp"
#include "spate/boundary/solid/foot.hpp"
#include "spate/core/box.hpp"
#include "spate/core/term.hpp"

#include <tuple>

namespace spate {

/// Faces of a box, as planes that look inwards.
template <int Dim>
struct Planes {
    Box<Dim> box;
    std::array<bool, std::size_t(2 * Dim)> on{}; ///< by 2 axis + upper

    void check() const {}
    /// f(foot) for each plane that any lane may touch.
    template <class V>
    [[gnu::always_inline]] void touched(Vec<Dim, V> const& x, V const& reach, auto const& f) const
    {
        for (int c = 0; c < Dim; ++c)
            for (int upper = 0; upper < 2; ++upper) {
                if (!on[std::size_t(2 * c + upper)]) continue;
                const V d = upper != 0 ? V(box.hi[c] - x[c]) : V(x[c] - box.lo[c]);
                if (!spate::any(d < reach)) continue;
                Foot<Dim, V> at;
                for (int k = 0; k < Dim; ++k) at.n[k] = V(k != c ? 0 : upper != 0 ? -1 : 1);
                at.distance = d;
                f(at);
            }
    }
};
/// The surface of a solid.
template <class S>
struct Surface {
    S solid;

    void check() const { solid.check(); }
    template <class V, int Dim>
    [[gnu::always_inline]] void touched(Vec<Dim, V> const& x, V const& reach, auto const& f) const
    {
        const Foot<Dim, V> at = foot<V>(solid, x);
        if (spate::any(at.distance < reach)) f(at);
    }
};

namespace detail {
/// A field to which a contact term adds, only in the lanes that touch.
template <class I, class F, class M>
struct AddedAtWall {
    I& i;
    M mask;
    template <class X>
    [[gnu::always_inline]] void operator+=(X const& y) const
    {
        i[F{}] += where(mask, y, zero<X>());
    }
    template <class X>
    [[gnu::always_inline]] void operator-=(X const& y) const
    {
        i[F{}] -= where(mask, y, zero<X>());
    }

private:
    template <class X>
    [[gnu::always_inline]] static X zero()
    {
        X x;
        if constexpr (F::rank == 0) x = X(0);
        else
            for (auto& component : x.c) component = std::remove_cvref_t<decltype(component)>(0);
        return x;
    }
};
/// The particle as a contact term of a wall sees it.
template <class T, class I, class M>
struct SeenAtWall {
    I& i;
    M mask;
    template <Field F>
    [[gnu::always_inline]] decltype(auto) operator[](F f) const
    {
        if constexpr (decltype(spate::adds<T>())::template contains<F>) return AddedAtWall<I, F, M>{i, mask};
        else return i[f];
    }
};
} // namespace detail

/// Contact with a wall, as with a grain at rest or moving with it: m_j and R_j beyond all others (numerics: m_eff = m_i).
/// \tparam I  the interaction    \tparam S  Planes or Surface    \tparam M  law of motion, or Still    \tparam T  the terms
template <class I, class S, class M, class... T>
struct WallContact {
    static constexpr int dim = I::dim;
    static constexpr auto reads = (I::reads | ... | spate::reads_i<T>()) | Fields{position, radius};
    static constexpr auto adds = (Fields<>{} | ... | spate::adds<T>());
    static constexpr Between between{Role::mobile, Role::any};
    static constexpr bool pushes = true, moves = !std::same_as<M, Still>;

    I interaction;
    S surface;
    M law;
    std::tuple<T...> terms;
    Rigid<dim> now{};

    [[gnu::cold]] void check() const
    {
        surface.check();
        detail_each([](auto const& t) {
            if constexpr (requires { t.check(); }) t.check();
        });
    }
    void move_to(double t) requires(moves) { now = law(t); }
    /// Of a contact with the wall; m is the mass of the grain [kg]: a term is asked for two equal masses of which the
    /// reduced one is that.
    [[nodiscard]] double contact_frequency(double m) const
    {
        double most = 0;
        detail_each([&](auto const& t) {
            if constexpr (requires { t.contact_frequency(m); }) most = std::max(most, t.contact_frequency(2 * m));
        });
        return most;
    }
    /// Elastic energy that the particle has stored in the wall [J].
    [[nodiscard]] double wall_energy(auto const& i) const
    {
        double sum = 0;
        each_contact<double>(i, [&](auto const&, auto const& ij) {
            detail_each([&](auto const& t) {
                if constexpr (requires { t.energy(ij); }) sum += t.energy(ij);
            });
        });
        return sum;
    }
    void operator()(auto& i) const
    {
        using V = std::remove_cvref_t<decltype(i[radius])>;
        each_contact<V>(
            i, [&](auto const& j, auto const& ij) __attribute__((always_inline)) {
                detail_each([&]<class X>(X const& t) __attribute__((always_inline)) {
                    using Mask = std::remove_cvref_t<decltype(ij.mask)>;
                    const detail::SeenAtWall<X, std::remove_reference_t<decltype(i)>, Mask> seen{i, ij.mask};
                    t(seen, j, ij);
                });
            });
    }

private:
    static constexpr auto of_wall = (I::reads | ... | spate::reads_j<T>()) | Fields{position};

    [[gnu::always_inline]] void detail_each(auto const& f) const
    {
        std::apply(
            [&](auto const&... t) __attribute__((always_inline)) { (f(t), ...); }, terms);
    }
    /// f(j, ij) for each contact: j as the terms see the wall, ij as the interaction sees a grain like i behind the surface.
    template <class V>
    [[gnu::always_inline]] void each_contact(auto const& i, auto const& f) const
    {
        const Vec<dim, V> x = i[position];
        const V r = i[radius];
        surface.touched(
            at_rest<V>(x), r, [&](Foot<dim, V> at) __attribute__((always_inline)) {
                if constexpr (moves) at.n = turned<V>(at.n);
                constexpr double endless = 1e30;
                Record<dim, V, std::remove_cv_t<decltype(of_wall)>> behind;
                clear(behind);
                behind[position] = x - (at.distance + r) * at.n;
                if constexpr (moves && decltype(behind)::template has<Velocity>)
                    behind[velocity] = velocity_at<V>(x - at.distance * at.n);
                auto wall = behind;
                if constexpr (decltype(behind)::template has<Radius>) behind[radius] = r, wall[radius] = V(endless);
                if constexpr (decltype(behind)::template has<Mass>) wall[mass] = V(endless);
                const auto ij = interaction.template pair<V>(i, behind);
                if (spate::any(ij.mask)) f(wall, ij);
            });
    }
    template <class V>
    [[gnu::always_inline]] Vec<dim, V> at_rest(Vec<dim, V> const& x) const
    {
        if constexpr (moves) {
            const Vec<dim, V> y = x - broadcast<V>(now.centre + now.shift);
            Vec<dim, V> back = broadcast<V>(now.centre);
            for (int c = 0; c < dim; ++c) back += y[c] * broadcast<V>(now.turn[std::size_t(c)]);
            return back;
        }
        else return x;
    }
    template <class V>
    [[gnu::always_inline]] Vec<dim, V> turned(Vec<dim, V> const& n) const
    {
        Vec<dim, V> y;
        for (int c = 0; c < dim; ++c) y[c] = broadcast<V>(now.turn[std::size_t(c)]).dot(n);
        return y;
    }
    template <class V>
    [[gnu::always_inline]] Vec<dim, V> velocity_at(Vec<dim, V> const& x) const
    {
        const Vec<dim, V> y = at_rest<V>(x) - broadcast<V>(now.centre);
        Vec<dim, V> v = broadcast<V>(now.velocity);
        for (int c = 0; c < dim; ++c) v[c] += broadcast<V>(now.turn_rate[std::size_t(c)]).dot(y);
        return v;
    }
};

/// Option of Walls: `contact(LinearSpring{.k = 1e5})` on all faces that are walls, `contact(left, right, term...)` on some,
/// `contact(inside_out(Cylinder{...}), law, term...)` on the surface of a solid.
template <std::size_t N, class S, class M, class... T>
struct ContactPart {
    std::array<Face, N> faces; ///< none, and no solid: all that no other part names
    S solid;
    M law;
    std::tuple<T...> terms;
};

namespace detail {
template <class X>
inline constexpr bool is_face = std::same_as<X, Face>;
template <class X>
inline constexpr bool is_solid = requires(X const x)
{
    x.check();
}
&&(
    requires(X const x, Vec<1, double> y) { x.distance(y); } ||
    requires(X const x, Vec<2, double> y) { x.distance(y); } ||
    requires(X const x, Vec<3, double> y) { x.distance(y); });
template <class X>
inline constexpr bool is_law = requires(X const x)
{
    x(1.0);
};

/// Those of the arguments whose type `Is` picks.
template <template <class> class Is, class... A>
constexpr auto picked_of(A const&... a)
{
    return std::tuple_cat([](auto const& x) {
        if constexpr (Is<std::remove_cvref_t<decltype(x)>>::value) return std::tuple{x};
        else return std::tuple<>{};
    }(a)...);
}
template <class X>
struct IsFace : std::bool_constant<is_face<X>> {};
template <class X>
struct IsSolid : std::bool_constant<is_solid<X>> {};
template <class X>
struct IsLaw : std::bool_constant<is_law<X>> {};
template <class X>
struct IsTerm : std::bool_constant<!is_face<X> && !is_solid<X> && !is_law<X>> {};
/// The only one of a list, or what stands for none.
template <class None, class... X>
constexpr auto only(std::tuple<X...> const& t, None none)
{
    static_assert(sizeof...(X) <= 1,
                  "spate: a contact is with one solid, moving by one law; write one contact for each");
    if constexpr (sizeof...(X) == 1) return std::get<0>(t);
    else return none;
}
} // namespace detail

/// No solid: faces of the box.
struct NoSolid {};

template <class... A>
constexpr auto contact(A... a)
{
    const auto faces = detail::picked_of<detail::IsFace>(a...);
    const auto solid = detail::only(detail::picked_of<detail::IsSolid>(a...), NoSolid{});
    const auto law = detail::only(detail::picked_of<detail::IsLaw>(a...), Still{});
    using S = std::remove_cv_t<decltype(solid)>;
    using M = std::remove_cv_t<decltype(law)>;
    constexpr std::size_t N = std::tuple_size_v<std::remove_cv_t<decltype(faces)>>;
    static_assert(N == 0 || std::same_as<S, NoSolid>, "spate: a contact is with faces of the box or with a solid");
    return [&]<class... T>(std::tuple<T...> const& terms) {
        static_assert(sizeof...(T) > 0 && (PairTerm<T> && ...),
                      "spate: contact takes faces or a solid, a law of motion, and contact terms such as LinearSpring");
        ContactPart<N, S, M, T...> part{{}, solid, law, terms};
        std::apply([&](auto... f) { part.faces = std::array<Face, N>{f...}; }, faces);
        return part;
    }(detail::picked_of<detail::IsTerm>(a...));
}

} // namespace spate
