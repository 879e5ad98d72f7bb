// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Solids of solids. The distance is exact near each surface and a lower bound away from them.
#pragma once

#include "spate/core/vec.hpp"

#include <algorithm>

namespace spate {

namespace detail {
template <class... Solid>
void check_solids(Solid const&... solid)
{
    auto one = [](auto const& s) {
        if constexpr (requires { s.check(); }) s.check();
    };
    (one(solid), ...);
}
} // namespace detail

template <class A, class B>
struct Union {
    A a;
    B b;
    void check() const { detail::check_solids(a, b); }
    template <int Dim>
    [[nodiscard]] double distance(Vec<Dim, double> const& x) const
    {
        return std::min(a.distance(x), b.distance(x));
    }
};
template <class A, class B>
struct Intersection {
    A a;
    B b;
    void check() const { detail::check_solids(a, b); }
    template <int Dim>
    [[nodiscard]] double distance(Vec<Dim, double> const& x) const
    {
        return std::max(a.distance(x), b.distance(x));
    }
};
template <class A>
struct InsideOut {
    A a;
    void check() const { detail::check_solids(a); }
    template <int Dim>
    [[nodiscard]] double distance(Vec<Dim, double> const& x) const
    {
        return -a.distance(x);
    }
};
/// What is in a or in b.
template <class A, class B>
Union<A, B> unite(A a, B b)
{
    return {a, b};
}
/// What is in a and in b.
template <class A, class B>
Intersection<A, B> intersect(A a, B b)
{
    return {a, b};
}
/// All but a: a vessel of its shape.
template <class A>
InsideOut<A> inside_out(A a)
{
    return {a};
}
/// What is in a and not in b.
template <class A, class B>
Intersection<A, InsideOut<B>> subtract(A a, B b)
{
    return {a, {b}};
}

} // namespace spate
