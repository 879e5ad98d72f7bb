// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Walls that grains touch: any contact term between a particle and a surface of infinite mass, as one particle
/// term; faces of a box or the surface of a solid, at rest or moving by a law.
#pragma once

#include "spate/boundary/motion.hpp"
#include "spate/boundary/solid/foot.hpp"
#include "spate/core/box.hpp"
#include "spate/core/term.hpp"

#include <limits>
#include <tuple>

namespace spate {

/// Faces of a box, as planes that look inwards. What is kept of a contact is kept by axis: no grain touches both ends of one.
template <int Dim>
struct Planes {
    static constexpr int slots = Dim; ///< places where something may be kept of a contact
    Box<Dim> box;
    std::array<bool, std::size_t(2 * Dim)> on{}; ///< by 2 axis + upper

    void check(double range) const
    {
        for (int c = 0; c < Dim; ++c)
            require(!on[std::size_t(2 * c)] || !on[std::size_t(2 * c + 1)] || box.size()[c] >= 2 * range,
                    along_axis("Walls.box length", c), box.size()[c],
                    "at least twice the diameter of the largest grain between two walls of contact");
    }
    /// f(slot, foot) for each plane that any lane may touch; few do.
    template <class V>
    [[gnu::always_inline]] void touched(Vec<Dim, V> const& x, V const& reach, auto const& f) const
    {
        constexpr double none = std::numeric_limits<double>::infinity();
        V least(none);
        for (int c = 0; c < Dim; ++c) {
            const V lo(on[std::size_t(2 * c)] ? box.lo[c] : -none), hi(on[std::size_t(2 * c + 1)] ? box.hi[c] : none);
            least = min(least, min(x[c] - lo, hi - x[c]));
        }
        if (__builtin_expect(!spate::any(least < reach), 1)) return;
        auto along = [&]<int c>(std::integral_constant<int, c> slot) __attribute__((always_inline))
        {
            for (int upper = 0; upper < 2; ++upper) {
                if (!on[std::size_t(2 * c + upper)]) continue;
                const V d = upper != 0 ? V(box.hi[c] - x[c]) : V(x[c] - box.lo[c]);
                if (!spate::any(d < reach)) continue;
                Foot<Dim, V> at;
                for (int k = 0; k < Dim; ++k) at.n[k] = V(k != c ? 0 : upper != 0 ? -1 : 1);
                at.distance = d;
                f(slot, at);
            }
        };
        along(std::integral_constant<int, 0>{});
        if constexpr (Dim > 1) along(std::integral_constant<int, 1>{});
        if constexpr (Dim > 2) along(std::integral_constant<int, 2>{});
    }
};
/// The surface of a solid.
template <class S>
struct Surface {
    static constexpr int slots = 1;
    S solid;

    void check(double) const { solid.check(); }
    template <class V, int Dim>
    [[gnu::always_inline]] void touched(Vec<Dim, V> const& x, V const& reach, auto const& f) const
    {
        const Foot<Dim, V> at = foot<V>(solid, x);
        if (spate::any(at.distance < reach)) f(std::integral_constant<int, 0>{}, at);
    }
};

/// What a term keeps of the contact of a particle with a wall: a field of the particle, one a place where walls are touched.
template <Field F, int place>
struct KeptAtWall
    : std::conditional_t<F::axial, AxialField, std::conditional_t<F::rank != 0, VectorField, ScalarField>> {
private:
    static constexpr auto letters = [] {
        constexpr std::string_view at = "_at_wall_";
        std::array<char, F::name.size() + at.size() + 2> all{};
        std::size_t n = 0;
        for (char c : F::name) all[n++] = c;
        for (char c : at) all[n++] = c;
        all[n++] = char('0' + place / 10), all[n++] = char('0' + place % 10);
        return all;
    }();

public:
    static constexpr std::string_view name{letters.data(), letters.size()}, unit = F::unit;
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
template <class T, class I, class M, class K>
struct SeenAtWall {
    I& i;
    M mask;
    K& kept;
    template <Field F>
    [[gnu::always_inline]] decltype(auto) operator[](F f) const
    {
        if constexpr (decltype(spate::adds<T>())::template contains<F>) return AddedAtWall<I, F, M>{i, mask};
        else if constexpr (decltype(spate::keeps<T>())::template contains<F>)
            return Masked<M, std::remove_cvref_t<decltype(kept[f])>>{mask, kept[f]};
        else if constexpr (std::same_as<F, Elapsed>) return (kept.elapsed);
        else return i[f];
    }
};
/// A contact with a wall: the point of contact is on its surface.
template <class C>
struct ContactAtWall : C {
    static constexpr double share = 1;
};
} // namespace detail

/// Contact with a wall, as with a grain at rest or moving with it: m_j and R_j beyond all others, so that m_ij = m_i.
/// \tparam I  the interaction    \tparam S  Planes or Surface    \tparam M  law of motion, or Still
/// \tparam first  number of its first place for what is kept    \tparam T  the terms
template <class I, class S, class M, int first, class... T>
struct WallContact {
    static constexpr int dim = I::dim;
    static constexpr auto keeps_of_contact = (Fields<>{} | ... | spate::keeps<T>());
    static constexpr auto writes = []<int... k, class... F>(std::integer_sequence<int, k...>, Fields<F...>)
    {
        auto at = []<int place>(std::integral_constant<int, place>) {
            return Fields<KeptAtWall<F, first + place>...>{};
        };
        return (Fields<>{} | ... | at(std::integral_constant<int, k>{}));
    }
    (std::make_integer_sequence<int, S::slots>{}, keeps_of_contact);
    static constexpr auto reads = (I::reads | ... | spate::reads_i<T>()) | Fields{position, radius} | writes;
    static constexpr auto adds = (Fields<>{} | ... | spate::adds<T>());
    static constexpr Between between{Role::mobile, Role::any};
    static constexpr bool pushes = true, moves = !std::same_as<M, Still>, keeps_any = keeps_of_contact.size > 0;

    I interaction;
    S surface;
    M law;
    std::tuple<T...> terms;
    Rigid<dim> now{};
    double elapsed = 0, reach = 1; ///< of what is kept: to the state of the sweep [s], and beyond it in times of that
    bool keep = false;             ///< else it is only shown

    [[gnu::cold]] void check() const
    {
        surface.check(interaction.range());
        each_term([](auto const& t) {
            if constexpr (requires { t.check(); }) t.check();
        });
    }
    void move_to(double t) requires(moves) { now = law(t); }
    void carry(double time, bool keeps_it, double how_far) { elapsed = time, keep = keeps_it, reach = how_far; }
    /// Of a contact with the wall; m is the mass of the grain [kg]: a term is asked for two equal masses of which the
    /// reduced one is that.
    [[nodiscard]] double contact_frequency(double m) const
    {
        double most = 0;
        each_term([&](auto const& t) {
            if constexpr (requires { t.contact_frequency(m); }) most = std::max(most, t.contact_frequency(2 * m));
        });
        return most;
    }
    /// Elastic energy that the particle has stored in the wall [J].
    [[nodiscard]] double wall_energy(auto const& i) const
    {
        double sum = 0;
        each_contact<double>(i, [&](auto, auto const&, auto const& ij) {
            each_term([&](auto const& t) {
                if constexpr (requires { t.energy(ij); }) sum += t.energy(ij);
            });
        });
        return sum;
    }
    void operator()(auto& i) const
    {
        using In = std::remove_reference_t<decltype(i)>;
        using V = std::remove_cvref_t<decltype(i[radius])>;
        using Kept = Record<dim, V, std::remove_cv_t<decltype(keeps_of_contact)>>;
        struct Seen : Kept {
            V elapsed;
        };
        std::array<Kept, std::size_t(S::slots)> after;
        if constexpr (keeps_any)
            for (auto& k : after) clear(k); // what is not touched is forgotten
        each_contact<V>(
            i, [&](auto slot, auto const& j, auto const& ij) __attribute__((always_inline)) {
                using Mask = std::remove_cvref_t<decltype(ij.mask)>;
                Seen kept;
                kept.elapsed = V(elapsed);
                each_kept<slot()>([&](auto f, auto at) { kept[f] = was(i, at); });
                each_term([&]<class X>(X const& t) __attribute__((always_inline)) {
                    const detail::SeenAtWall<X, In, Mask, Seen> seen{i, ij.mask, kept};
                    t(seen, j, ij);
                });
                each_kept<slot()>([&](auto f, auto at) {
                    const auto old = was(i, at);
                    auto& value = after[std::size_t(slot())][f];
                    value = where(ij.mask, old + V(reach) * (kept[f] - old), value);
                });
            });
        if constexpr (keeps_any && !requires { In::only_shown; })
            store(i, after, std::make_integer_sequence<int, S::slots>{});
    }

private:
    static constexpr auto of_wall = (I::reads | ... | spate::reads_j<T>()) | Fields{position};

    [[gnu::always_inline]] void each_term(auto const& f) const
    {
        std::apply(
            [&](auto const&... t) __attribute__((always_inline)) { (f(t), ...); }, terms);
    }
    /// f(field of the contact, field of the particle) for all that is kept at a place.
    template <int slot>
    [[gnu::always_inline]] static void each_kept(auto const& f)
    {
        for_each(
            keeps_of_contact, [&]<class F>(F field)
                                  __attribute__((always_inline)) { f(field, KeptAtWall<F, first + slot>{}); });
    }
    /// What was kept: of a field that the term reads and sets the value before.
    template <class F>
    [[gnu::always_inline]] static auto was(auto const& i, F f)
    {
        if constexpr (requires { i.record[f]; }) return i.record[f];
        else {
            using V = std::remove_cvref_t<decltype(i[radius])>;
            return Value<F, dim, V>(i[f]);
        }
    }
    template <int... slot>
    [[gnu::always_inline]] void store(auto& i, auto const& after, std::integer_sequence<int, slot...>) const
    {
        auto one = [&]<int k>(std::integral_constant<int, k>) __attribute__((always_inline))
        {
            each_kept<k>([&](auto f, auto at) { i[at] = keep ? after[std::size_t(k)][f] : was(i, at); });
        };
        (one(std::integral_constant<int, slot>{}), ...);
    }
    /// f(slot, j, ij) for each contact: j as the terms see the wall, ij as the interaction sees a grain like i behind it.
    template <class V>
    [[gnu::always_inline]] void each_contact(auto const& i, auto const& f) const
    {
        const Vec<dim, V> x = i[position];
        const V r = i[radius];
        surface.touched(
            at_rest<V>(x), r, [&](auto slot, Foot<dim, V> at) __attribute__((always_inline)) {
                if constexpr (moves) at.n = turned<V>(at.n);
                constexpr double endless = 1e30; // beside any grain, in float too
                Record<dim, V, std::remove_cv_t<decltype(of_wall)>> behind;
                clear(behind);
                behind[position] = x - (at.distance + r) * at.n;
                if constexpr (moves && decltype(behind)::template has<Velocity>)
                    behind[velocity] = velocity_at<V>(x - at.distance * at.n);
                auto wall = behind;
                if constexpr (decltype(behind)::template has<Radius>) behind[radius] = r, wall[radius] = V(endless);
                if constexpr (decltype(behind)::template has<Mass>) wall[mass] = V(endless);
                const auto pair = interaction.template pair<V>(i, behind);
                const detail::ContactAtWall<std::remove_cv_t<decltype(pair)>> ij{pair};
                if (spate::any(ij.mask)) f(slot, wall, ij);
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
/// What a term takes from the others (a dashpot the stiffness of the spring) it takes here.
template <class T, class... All>
constexpr auto with_others(T const& t, All const&... all)
{
    if constexpr (requires { t.with(all...); }) return t.with(all...);
    else return t;
}
template <class... T>
constexpr auto with_each_other(std::tuple<T...> const& terms)
{
    auto complete = [&](auto const& t) {
        return std::apply([&](auto const&... all) { return with_others(t, all...); }, terms);
    };
    return std::apply([&](auto const&... t) { return std::tuple{complete(t)...}; }, terms);
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
    }(detail::with_each_other(detail::picked_of<detail::IsTerm>(a...)));
}

} // namespace spate
