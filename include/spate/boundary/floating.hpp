// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The law of a solid that moves by the forces on it, and what is known of it at the start.
#pragma once

#include "spate/boundary/body.hpp"
#include "spate/boundary/obstacle.hpp"

#include <optional>
#include <vector>

namespace spate {

/// What a marker on the surface of a body feels of a wall or of another solid that is nearer than half a spacing:
/// max(0, k overlap - c v_n) along the normal. docs/models/boundaries.md (14).
struct BodyContact {
    double k = 0; ///< stiffness of a marker [N/m]; 0: there are no contacts
    double c = 0; ///< damping of a marker [N s/m]
};

/// Law of an obstacle: `obstacle(Box<2>{...}, Floating<2>{.density = 500})`. The body is all points of the walls' lattice in the
/// solid, each a cube of the density, unless mass, centre or inertia say otherwise.
template <int Dim>
struct Floating {
    static_assert(Dim >= 2, "spate: nothing floats on a line");
    using Spin = std::conditional_t<Dim == 3, Vec<3, double>, double>;
    using Inertia = std::conditional_t<Dim == 3, Matrix<3>, double>;

    double density = 0;                       ///< [kg/m^3]; 0: mass is given
    double mass = 0;                          ///< [kg], in the plane of a metre of it; 0: density is given
    Vec<Dim, double> velocity{};              ///< of the centre, at the start [m/s]
    Spin spin{};                              ///< at the start [rad/s]
    std::optional<Vec<Dim, double>> centre{}; ///< of mass [m]; else that of the points
    std::optional<Inertia> inertia{}; ///< about the centre [kg m^2]; infinite: it does not turn; else of the points
    Vec<Dim, double> load{};          ///< a force on the centre that never changes, beside gravity [N]
    BodyContact contact{};

    void check() const
    {
        require((density > 0) != (mass > 0) && std::isfinite(density + mass), "Floating.density", density,
                "above 0 [kg/m^3], or Floating.mass above 0 [kg], and not both");
        require_non_negative("Floating.contact.k", contact.k, "N/m");
        require_non_negative("Floating.contact.c", contact.c, "N s/m");
    }
};

namespace detail {
template <class M>
inline constexpr bool is_floating = false;
template <int Dim>
inline constexpr bool is_floating<Floating<Dim>> = true;

inline Matrix<1> inverse(double m) { return {Vec<1, double>{{1 / m}}}; }
/// Of a symmetric positive matrix; infinite on the diagonal: 0 there.
inline Matrix<3> inverse(Matrix<3> const& m)
{
    if (std::isinf(m[0][0])) return {};
    const Vec<3, double> a = cross(m[1], m[2]), b = cross(m[2], m[0]), c = cross(m[0], m[1]);
    const double d = 1 / m[0].dot(a);
    Matrix<3> n{};
    for (int k = 0; k < 3; ++k) n[std::size_t(k)] = d * Vec<3, double>{{a[k], b[k], c[k]}};
    return n;
}
/// Momentum of a spin.
inline Vec<1, double> momentum_of(double spin, double inertia) { return {{spin == 0 ? 0 : spin * inertia}}; }
inline Vec<3, double> momentum_of(Vec<3, double> const& spin, Matrix<3> const& inertia)
{
    return spin.squaredNorm() == 0 ? spin : inertia * spin;
}

/// The body at the start. \param points  of the lattice in it    \param edge  of their cubes [m]
template <int Dim>
[[gnu::cold]] Body<Dim> body_of(Floating<Dim> const& f, std::vector<Vec<Dim, double>> const& points, double edge)
{
    require(!points.empty(), "points of the lattice in a solid that floats", 0,
            "1 or more: it is too small, or outside");
    const double n = double(points.size());
    Body<Dim> body;
    body.mass = f.mass > 0 ? f.mass : f.density * n * std::pow(edge, Dim);
    for (auto const& x : points) body.centre += (1 / n) * x;
    if (f.centre) body.centre = *f.centre;
    typename Floating<Dim>::Inertia I{};
    for (auto const& x : points) {
        const auto r = x - body.centre;
        const double m = body.mass / n, own = edge * edge / 6; // of a square or a cube about its centre
        if constexpr (Dim == 2) I += m * (r.squaredNorm() + own);
        else
            for (int i = 0; i < 3; ++i)
                for (int k = 0; k < 3; ++k)
                    I[std::size_t(i)][k] += m * ((i == k ? r.squaredNorm() + own : 0) - r[i] * r[k]);
    }
    if (f.inertia) I = *f.inertia;
    body.inverse_inertia = inverse(I);
    body.load = f.load;
    body.state.velocity = f.velocity;
    body.state.angular_momentum = momentum_of(f.spin, I);
    return body;
}
} // namespace detail

} // namespace spate
