// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What a term sees of a contact, and the motion of two grains at it.
/// One rounding rule: what belongs to a pair is a sum or a product of both sides, or one difference of them, so that the two
/// directed copies of a pair hold equal bits, or opposite ones (docs/decisions/0017).
#pragma once

#include "spate/core/fields.hpp"

namespace spate {

/// A contact of two round grains; of a grain and a wall: share = 1.
template <int Dim, class V, class M>
struct Contact {
    static constexpr int dim = Dim;
    static constexpr double share = 0.5; ///< of the overlap that lies within i [-]
    using value = V;
    Vec<Dim, V> n; ///< unit normal, from j to i
    V overlap;     ///< r_i + r_j - |x_i - x_j| [m], positive in contact
    M mask;        ///< the lanes in contact; the view applies it, terms never see it
};

/// a b/(a + b): of two masses, or radii. A wall is a partner of 1e100.
template <class V>
[[gnu::always_inline]] inline V reduced(V const& a, V const& b)
{
    return a * b / (a + b);
}

/// From the centre of i to the point of contact [m]; both arms together are the distance of the centres.
template <class C>
[[gnu::always_inline]] inline auto arm_of_i(auto const& i, C const& ij)
{
    return i[radius] - C::share * ij.overlap;
}
template <class C>
[[gnu::always_inline]] inline auto arm_of_j(auto const& j, C const& ij)
{
    return j[radius] - (1 - C::share) * ij.overlap;
}

/// The part of what is axial across n.
template <class V>
[[gnu::always_inline]] inline Vec<3, V> across(Vec<3, V> const& n, Vec<3, V> const& axial)
{
    return axial - axial.dot(n) * n;
}
template <class V>
[[gnu::always_inline]] inline Vec<1, V> across(Vec<2, V> const&, Vec<1, V> const& axial)
{
    return axial;
}
/// The same turned into the plane across n, as long as before.
template <class V>
[[gnu::always_inline]] inline Vec<3, V> turned(Vec<3, V> const& n, Vec<3, V> const& axial)
{
    const Vec<3, V> in_plane = across(n, axial);
    const V after = in_plane.squaredNorm(); // no product of both: in float it is 0 for the springs of small grains
    return where(after > 0, sqrt(axial.squaredNorm() / after), V(1)) * in_plane;
}
template <class V>
[[gnu::always_inline]] inline Vec<1, V> turned(Vec<2, V> const&, Vec<1, V> const& axial)
{
    return axial;
}

/// (v_i - v_j) . n: positive when they part [m/s].
[[gnu::always_inline]] inline auto parting(auto const& i, auto const& j, auto const& ij)
{
    return (i[velocity] - j[velocity]).dot(ij.n);
}
/// n x the velocity of i against j at the point of contact [m/s]: the same seen from either side. Docs (13).
[[gnu::always_inline]] inline auto slip(auto const& i, auto const& j, auto const& ij)
{
    const auto spin = arm_of_i(i, ij) * i[angular_velocity] + arm_of_j(j, ij) * j[angular_velocity];
    return cross(ij.n, i[velocity] - j[velocity]) - across(ij.n, spin);
}
/// The force n x G on i at the point of contact, and its torque.
template <class C, class G>
[[gnu::always_inline]] inline void push_across(auto& i, C const& ij, G const& g)
{
    i[acceleration] += (1 / i[mass]) * cross(ij.n, g);
    i[angular_acceleration] += (1 / (inertia<C::dim> * i[mass] * i[radius] * i[radius]) * arm_of_i(i, ij)) * g;
}

} // namespace spate
