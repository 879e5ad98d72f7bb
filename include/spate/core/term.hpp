// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A term: one addend of the equations. It declares what it touches and touches nothing else; the compiler checks.
///
/// A particle term is called with one particle, a pair term with target i, source j and what the interaction knows of
/// the pair: `void operator()(auto& i, auto const& j, auto const& ij) const`. A pair term changes i only.
///   reads    fields of i and of j        reads_i, reads_j   of one side only
///   writes   fields it sets (particle terms)        adds    fields it adds to
///   between  which species meet (default: any)      self    true: also i with itself
///   when     every evaluation (default), before or after a step, each n steps (member `every`)
///   keeps    memory of a pair, private to the term, born zero with the contact; i[elapsed] is how old it is
#pragma once

#include "spate/core/record.hpp"

namespace spate {

namespace detail {
// clang-format off
template <class T> constexpr auto reads_both() { if constexpr (requires { T::reads; }) return T::reads; else return Fields<>{}; }
template <class T> constexpr auto only_i() { if constexpr (requires { T::reads_i; }) return T::reads_i; else return Fields<>{}; }
template <class T> constexpr auto only_j() { if constexpr (requires { T::reads_j; }) return T::reads_j; else return Fields<>{}; }
// clang-format on
struct Any {};
} // namespace detail

template <class T>
constexpr auto reads_i()
{
    return detail::reads_both<T>() | detail::only_i<T>();
}
template <class T>
constexpr auto reads_j()
{
    return detail::reads_both<T>() | detail::only_j<T>();
}
template <class T>
constexpr auto writes()
{
    if constexpr (requires { T::writes; }) return T::writes;
    else return Fields<>{};
}
template <class T>
constexpr auto adds()
{
    if constexpr (requires { T::adds; }) return T::adds;
    else return Fields<>{};
}
template <class T>
constexpr auto keeps()
{
    if constexpr (requires { T::keeps; }) return T::keeps;
    else return Fields<>{};
}
template <class T>
inline constexpr bool has_self = requires
{
    requires T::self;
};

/// Whether a term knows the elastic energy of a contact: energy(ij), or energy(i, j, ij).
template <class T>
inline constexpr bool stores_energy = requires
{
    requires T::stores_energy;
};

/// The part a species plays: mobile ones obey the equations of motion, markers belong to a boundary.
enum class Role { any, mobile, marker };
/// Target <- source.
struct Between {
    Role target = Role::any, source = Role::any;
};
template <class T>
constexpr Between between()
{
    if constexpr (requires { T::between; }) return T::between;
    else return {};
}
enum class When { evaluation, before_step, after_step };
template <class T>
constexpr When when()
{
    if constexpr (requires { T::when; }) return T::when;
    else return When::evaluation;
}

template <class T>
concept PairTerm = requires(T const t, detail::Any& a)
{
    t(a, a, a);
};
template <class T>
concept ParticleTerm = requires(T const t, detail::Any& a)
{
    t(a);
};
template <class T>
concept Term = PairTerm<T> || ParticleTerm<T>;

/// A field of which only the lanes of a mask change.
template <class M, class X>
struct Masked {
    M m;
    X& x;
    [[gnu::always_inline]] void operator+=(X const& y) const { x = where(m, x + y, x); }
    [[gnu::always_inline]] void operator-=(X const& y) const { x = where(m, x - y, x); }
    template <class Y>
    [[gnu::always_inline]] void operator=(Y const& y) const
    {
        x = where(m, X(y), x);
    }
    [[gnu::always_inline]] operator X const&() const { return x; }
    [[gnu::always_inline]] friend X operator+(Masked const& a, X const& b) { return a.x + b; }
    [[gnu::always_inline]] friend X operator-(Masked const& a, X const& b) { return a.x - b; }
    template <class Y>
    [[gnu::always_inline]] friend auto operator*(Y const& y, Masked const& a)
    {
        return y * a.x;
    }
};
/// The value of a field that a term may also change.
template <class M, class X>
[[gnu::always_inline]] inline X const& value(Masked<M, X> const& field)
{
    return field.x;
}
template <class X>
[[gnu::always_inline]] inline X const& value(X const& field)
{
    return field;
}
/// No mask: every lane counts.
struct Always {};

/// One particle as one term may see it: reads what it declares, adds to what it declares; nothing else exists.
template <class Readable, class Addable, class R, class U, class S, class M = Always, class H = void>
struct View {
    R const& record;
    U const& uniform;
    S* sums;
    [[no_unique_address]] M mask;
    H* kept = nullptr;

    template <Field F>
    [[gnu::always_inline]] decltype(auto) operator[](F f) const
    {
        constexpr bool adds_to = Addable::template contains<F> && !std::is_void_v<S>;
        constexpr bool keeps_it = []() {
            if constexpr (std::is_void_v<H>) return false;
            else return H::template has<F>;
        }();
        constexpr bool read = Readable::template contains<F>;
        if constexpr (std::same_as<F, Elapsed> && !std::is_void_v<H>) return (kept->elapsed);
        else if constexpr (adds_to) return slot(*sums, f);
        else if constexpr (keeps_it) return slot(*kept, f);
        else if constexpr (read && R::template has<F>) return (record[f]);
        else if constexpr (read && U::template has<F>) return (uniform[f]);
        else if constexpr (std::is_void_v<S>)
            static_assert(read && !read,
                          "spate: the term uses a field of j that it does not declare; name it in reads or "
                          "reads_j, for an interaction in its reads; a pair term changes i only");
        else
            static_assert(read && !read, "spate: the term uses a field that it does not declare; name it in the term's "
                                         "reads, writes, adds or keeps");
    }

private:
    template <class A, class F>
    [[gnu::always_inline]] decltype(auto) slot(A& record_of_sums, F f) const
    {
        if constexpr (std::same_as<M, Always>) return (record_of_sums[f]);
        else return Masked<M, std::remove_reference_t<decltype(record_of_sums[f])>>{mask, record_of_sums[f]};
    }
};

/// Fields that a particle term may touch, one block of width<V> particles: loads what it reads, stores what it writes.
template <class V, class T, class P>
struct ParticleView {
    P& particles;
    std::size_t i;

    /// A field that the term sets or adds to.
    template <Field F>
    struct Reference {
        P& particles;
        std::size_t i;
        using X = Value<F, P::dim, V>;
        [[gnu::always_inline]] operator X() const { return particles.template load_at<V>(F{}, i); }
        [[gnu::always_inline]] void operator=(X const& v) const { particles.template store_at<V>(F{}, i, v); }
        template <class Y>
        [[gnu::always_inline]] friend auto operator*(Y const& y, Reference const& r)
        {
            return y * X(r);
        }
        template <class Y>
        [[gnu::always_inline]] friend auto operator+(Reference const& r, Y const& y)
        {
            return X(r) + y;
        }
        template <class Y>
        [[gnu::always_inline]] friend auto operator-(Reference const& r, Y const& y)
        {
            return X(r) - y;
        }
        template <class Y>
        [[gnu::always_inline]] void operator+=(Y const& v) const
        {
            X x = particles.template load_at<V>(F{}, i);
            x += v;
            particles.template store_at<V>(F{}, i, x);
        }
        template <class Y>
        [[gnu::always_inline]] void operator-=(Y const& v) const
        {
            X x = particles.template load_at<V>(F{}, i);
            x -= v;
            particles.template store_at<V>(F{}, i, x);
        }
    };
    template <Field F>
    [[gnu::always_inline]] decltype(auto) operator[](F f) const
    {
        if constexpr (writes<T>().template contains<F> || adds<T>().template contains<F>)
            return Reference<F>{particles, i};
        else {
            static_assert(reads_i<T>().template contains<F>,
                          "spate: the term uses a field that it does not declare; name it in the term's reads, writes, "
                          "adds or keeps");
            return read(f);
        }
    }

private:
    template <Field F>
    [[gnu::always_inline]] Value<F, P::dim, V> const read(F f) const // const: what is only read can't be assigned to
    {
        return particles.template load_at<V>(f, i);
    }
};

} // namespace spate
