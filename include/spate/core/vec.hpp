// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A vector of 1 to 3 components over a scalar or a pack, of the interface and inside terms.
/// No expression templates: `auto` is safe.
#pragma once

#include "spate/core/pack.hpp"

namespace spate {

template <int Dim, class V>
struct Along;

template <int Dim, class V>
struct Vec {
    static_assert(Dim >= 1 && Dim <= 3, "spate: space has 1, 2 or 3 dimensions");
    V c[std::size_t(Dim)];

    [[gnu::always_inline]] V& operator[](int k) { return c[k]; }
    [[gnu::always_inline]] V const& operator[](int k) const { return c[k]; }

    [[gnu::always_inline]] V dot(Vec const& b) const
    {
        if constexpr (Dim == 1) return c[0] * b.c[0];
        else if constexpr (Dim == 2) return c[0] * b.c[0] + c[1] * b.c[1];
        else return c[0] * b.c[0] + c[1] * b.c[1] + c[2] * b.c[2];
    }
    [[gnu::always_inline]] V dot(Along<Dim, V> const& b) const { return b.dot(*this); }
    [[gnu::always_inline]] V squaredNorm() const { return dot(*this); }

    // Written out, not looped: g++ then splits the vector into registers at once.
    [[gnu::always_inline]] friend Vec operator+(Vec const& a, Vec const& b)
    {
        if constexpr (Dim == 1) return {{a.c[0] + b.c[0]}};
        else if constexpr (Dim == 2) return {{a.c[0] + b.c[0], a.c[1] + b.c[1]}};
        else return {{a.c[0] + b.c[0], a.c[1] + b.c[1], a.c[2] + b.c[2]}};
    }
    [[gnu::always_inline]] friend Vec operator-(Vec const& a, Vec const& b)
    {
        if constexpr (Dim == 1) return {{a.c[0] - b.c[0]}};
        else if constexpr (Dim == 2) return {{a.c[0] - b.c[0], a.c[1] - b.c[1]}};
        else return {{a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2]}};
    }
    [[gnu::always_inline]] friend Vec operator-(Vec const& a) { return V(-1) * a; }
    [[gnu::always_inline]] friend Vec operator*(V const& s, Vec const& a)
    {
        if constexpr (Dim == 1) return {{s * a.c[0]}};
        else if constexpr (Dim == 2) return {{s * a.c[0], s * a.c[1]}};
        else return {{s * a.c[0], s * a.c[1], s * a.c[2]}};
    }
    [[gnu::always_inline]] friend Vec operator*(Vec const& a, V const& s) { return s * a; }
    [[gnu::always_inline]] Vec& operator+=(Vec const& b) { return *this = *this + b; }
    [[gnu::always_inline]] Vec& operator-=(Vec const& b) { return *this = *this - b; }
    template <class U>
    requires(std::same_as<U, Vec>) void operator=(U const&) const { detail::only_read<U>(); }
    void operator+=(Vec const&) const { detail::only_read<V>(); }
    void operator-=(Vec const&) const { detail::only_read<V>(); }
    /// A constant vector, the same in all lanes.
    template <class U>
    requires(!std::same_as<U, V> && std::is_arithmetic_v<U>) [[gnu::always_inline]] Vec&
    operator+=(Vec<Dim, U> const& b)
    {
        for (int k = 0; k < Dim; ++k) c[k] += V(b.c[k]);
        return *this;
    }
    bool operator==(Vec const&) const = default;
};

/// A vector along a given one, F x: what the gradient of a radial function is. Kept apart, so that F and x . b are each
/// computed once however many terms use them.
template <int Dim, class V>
struct Along {
    V F;
    Vec<Dim, V> x;

    [[gnu::always_inline]] V operator[](int k) const { return F * x[k]; }
    [[gnu::always_inline]] V dot(Vec<Dim, V> const& b) const { return F * b.dot(x); }
    /// s F x, not yet multiplied out; x is the gradient's, which outlives a term.
    struct Scaled {
        V F;
        Vec<Dim, V> const& x;
        [[gnu::always_inline]] V operator[](int k) const { return F * x[k]; }
        [[gnu::always_inline]] V dot(Vec<Dim, V> const& b) const { return F * b.dot(x); }
        [[gnu::always_inline]] operator Vec<Dim, V>() const { return F * x; }
        [[gnu::always_inline]] friend Scaled operator*(V const& s, Scaled const& a) { return {s * a.F, a.x}; }
    };
    [[gnu::always_inline]] friend Scaled operator*(V const& s, Along const& a) { return {s * a.F, a.x}; }
    [[gnu::always_inline]] friend Scaled operator*(Along const& a, V const& s) { return s * a; }
};

/// a x b; in a plane what is axial has one component, along the normal of the plane.
template <class V>
[[gnu::always_inline]] inline Vec<3, V> cross(Vec<3, V> const& a, Vec<3, V> const& b)
{
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}
template <class V>
[[gnu::always_inline]] inline Vec<1, V> cross(Vec<2, V> const& a, Vec<2, V> const& b)
{
    return {{a[0] * b[1] - a[1] * b[0]}};
}
template <class V>
[[gnu::always_inline]] inline Vec<2, V> cross(Vec<2, V> const& a, Vec<1, V> const& axial)
{
    return {{a[1] * axial[0], -(a[0] * axial[0])}};
}

/// The same vector in all lanes.
template <class V, int Dim, class T>
[[gnu::always_inline]] inline Vec<Dim, V> broadcast(Vec<Dim, T> const& a)
{
    Vec<Dim, V> v;
    for (int k = 0; k < Dim; ++k) v.c[k] = V(a.c[k]);
    return v;
}
template <class M, int Dim, class V>
[[gnu::always_inline]] inline Vec<Dim, V> where(M m, Vec<Dim, V> a, Vec<Dim, V> const& b)
{
    for (int k = 0; k < Dim; ++k) a.c[k] = where(m, a.c[k], b.c[k]);
    return a;
}

} // namespace spate
