// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Where a solid is nearest to a point: distance and normal, over scalars and packs. What grains touch.
#pragma once

#include "spate/boundary/solid/combined.hpp"
#include "spate/boundary/solid/cylinder.hpp"
#include "spate/boundary/solid/half_space.hpp"
#include "spate/boundary/solid/sphere.hpp"

namespace spate {

template <int Dim, class V>
struct Foot {
    Vec<Dim, V> n; ///< unit normal, out of the solid
    V distance;    ///< of the point from the surface [m], negative within
};

template <class V, int Dim>
[[gnu::always_inline]] inline Foot<Dim, V> foot(HalfSpace<Dim> const& s, Vec<Dim, V> const& x)
{
    const Vec<Dim, double> n = (1 / std::sqrt(s.normal.squaredNorm())) * s.normal;
    Foot<Dim, V> f;
    f.n = broadcast<V>(n);
    f.distance = (x - broadcast<V>(s.point)).dot(f.n);
    return f;
}
template <class V, int Dim>
[[gnu::always_inline]] inline Foot<Dim, V> foot(Sphere<Dim> const& s, Vec<Dim, V> const& x)
{
    const Vec<Dim, V> y = x - broadcast<V>(s.centre);
    const V r = max(sqrt(y.squaredNorm()), V(1e-30)); // at the centre no direction is nearest
    Foot<Dim, V> f;
    f.n = (1 / r) * y;
    f.distance = r - s.radius;
    return f;
}
/// Side and ends: beyond an edge the edge is nearest, within the nearer of the two.
template <class V>
[[gnu::always_inline]] inline Foot<3, V> foot(Cylinder const& s, Vec<3, V> const& x)
{
    Vec<3, V> y = x - broadcast<V>(s.foot);
    const V z = y[s.axis] - s.height / 2, along = abs(z) - s.height / 2;
    y[s.axis] = V(0);
    const V r = max(sqrt(y.squaredNorm()), V(1e-30)), across = r - s.radius;
    const V a = max(along, V(0)), b = max(across, V(0)), out = sqrt(a * a + b * b);
    const auto outside = out > V(0), end = along > across;
    const V safe = where(outside, out, V(1));
    const V by_end = where(outside, a / safe, where(end, V(1), V(0)));
    const V by_side = where(outside, b / safe, where(end, V(0), V(1)));
    Foot<3, V> f;
    f.n = (by_side / r) * y;
    f.n[s.axis] = where(z > V(0), by_end, V(-1) * by_end);
    f.distance = where(outside, out, max(along, across));
    return f;
}
template <class V, class A, int Dim>
[[gnu::always_inline]] inline Foot<Dim, V> foot(InsideOut<A> const& s, Vec<Dim, V> const& x)
{
    Foot<Dim, V> f = foot<V>(s.a, x);
    f.n = V(-1) * f.n;
    f.distance = V(-1) * f.distance;
    return f;
}

} // namespace spate
