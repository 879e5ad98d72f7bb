// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Laws of rigid motion, given as functions of time, and what a moving marker carries. A law is called with the
/// time and returns the motion then: a lambda will do.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/field.hpp"

#include <array>
#include <cmath>
#include <concepts>

namespace spate {

// clang-format off
/// Of a moving marker: where it is at rest, and to which part of the wall it belongs: 0 the lining, 1, ... the obstacles.
inline constexpr struct RestPosition : VectorField { static constexpr std::string_view name = "rest_position", unit = "m"; } rest_position{};
inline constexpr struct Part : ScalarField { static constexpr std::string_view name = "part"; } part{};
// clang-format on

template <int Dim>
using Matrix = std::array<Vec<Dim, double>, std::size_t(Dim)>; ///< rows

template <int Dim>
constexpr Matrix<Dim> identity()
{
    Matrix<Dim> m{};
    for (int c = 0; c < Dim; ++c) m[std::size_t(c)][c] = 1;
    return m;
}
template <int Dim>
Vec<Dim, double> operator*(Matrix<Dim> const& m, Vec<Dim, double> const& x)
{
    Vec<Dim, double> y{};
    for (int c = 0; c < Dim; ++c) y[c] = m[std::size_t(c)].dot(x);
    return y;
}

/// A rigid motion at one time: what was at x0 is at centre + shift + turn (x0 - centre).
template <int Dim>
struct Rigid {
    Vec<Dim, double> shift{}, velocity{}, acceleration{}; ///< of the centre [m], [m/s], [m/s^2]
    Vec<Dim, double> centre{};                            ///< of rotation, at rest [m]
    Matrix<Dim> turn = identity<Dim>();                   ///< rotation [-]
    Matrix<Dim> turn_rate{}, turn_rate2{};                ///< its first and second time derivative [1/s], [1/s^2]

    [[nodiscard]] Vec<Dim, double> position_of(Vec<Dim, double> const& x0) const
    {
        return centre + shift + turn * (x0 - centre);
    }
    [[nodiscard]] Vec<Dim, double> velocity_of(Vec<Dim, double> const& x0) const
    {
        return velocity + turn_rate * (x0 - centre);
    }
    [[nodiscard]] Vec<Dim, double> acceleration_of(Vec<Dim, double> const& x0) const
    {
        return acceleration + turn_rate2 * (x0 - centre);
    }
    /// What is at x now was here at rest.
    [[nodiscard]] Vec<Dim, double> rest_of(Vec<Dim, double> const& x) const
    {
        const Vec<Dim, double> y = x - centre - shift;
        Vec<Dim, double> back = centre;
        for (int c = 0; c < Dim; ++c) back += y[c] * turn[std::size_t(c)]; // the transposed matrix is the inverse
        return back;
    }
};

// clang-format off
template <class M, int Dim>
concept Motion = requires(M const m, double t) {
    { m(t) } -> std::same_as<Rigid<Dim>>; // at t [s]; velocity and acceleration are the derivatives
};
// clang-format on

/// shift = v t + a t^2/2.
template <int Dim>
struct Steady {
    Vec<Dim, double> velocity{};     ///< [m/s]
    Vec<Dim, double> acceleration{}; ///< [m/s^2]
    Rigid<Dim> operator()(double t) const
    {
        return {.shift = t * velocity + (t * t / 2) * acceleration,
                .velocity = velocity + t * acceleration,
                .acceleration = acceleration};
    }
};
/// shift = A (sin(omega t + phase) - sin(phase)).
template <int Dim>
struct Oscillation {
    Vec<Dim, double> amplitude; ///< A [m]
    double omega;               ///< [rad/s]
    double phase = 0;           ///< [rad]
    Rigid<Dim> operator()(double t) const
    {
        const double s = std::sin(omega * t + phase), c = std::cos(omega * t + phase);
        return {.shift = (s - std::sin(phase)) * amplitude,
                .velocity = (omega * c) * amplitude,
                .acceleration = (-omega * omega * s) * amplitude};
    }
};
/// Steady rotation about a point, in 3D about an axis through it.
template <int Dim>
struct Rotation {
    static_assert(Dim >= 2, "spate: nothing turns on a line");
    Vec<Dim, double> centre; ///< [m]
    double omega;            ///< [rad/s]; in 2D from x to y
    Vec<3, double> axis{{0, 0, 1}};

    Rigid<Dim> operator()(double t) const
    {
        const double length = std::sqrt(axis.squaredNorm());
        require_positive("Rotation.axis length", length, "-");
        const Vec<3, double> n = (1 / length) * axis;
        const double c = std::cos(omega * t), s = std::sin(omega * t);
        Rigid<Dim> m{.centre = centre};
        for (int i = 0; i < Dim; ++i)
            for (int k = 0; k < Dim; ++k) {
                // Rodrigues: turn = n n^T + cos P + sin K, P = 1 - n n^T, K y = n x y.
                const double nn = Dim == 2 ? 0 : n[i] * n[k], P = double(i == k) - nn, K = cross(n, i, k);
                const auto r = std::size_t(i);
                m.turn[r][k] = nn + c * P + s * K;
                m.turn_rate[r][k] = omega * (c * K - s * P);
                m.turn_rate2[r][k] = -omega * omega * (c * P + s * K);
            }
        return m;
    }

private:
    static double cross(Vec<3, double> const& n, int i, int k)
    {
        if constexpr (Dim == 2) return i == k ? 0 : i == 1 ? 1 : -1;
        else return i == k ? 0 : ((k - i + 3) % 3 == 1 ? -1 : 1) * n[3 - i - k];
    }
};

/// No law of its own.
struct Still {};
/// Option of a boundary of markers: the whole of it moves, obstacles without a law of their own too.
template <class M>
struct Moving {
    M law;
};
template <class M>
Moving<M> moving(M law)
{
    return {law};
}

} // namespace spate
