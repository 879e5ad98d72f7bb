// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A rigid body that moves by the forces on it: its state, and how it drifts and is kicked. Knows no marker.
#pragma once

#include "spate/boundary/motion.hpp"
#include "spate/core/box.hpp"
#include "spate/core/vec.hpp"

#include <cmath>

namespace spate {

/// How a body is turned: in the plane an angle, in space a unit quaternion.
template <int Dim>
struct Attitude;
template <>
struct Attitude<2> {
    double angle = 0; ///< [rad], from x to y

    void turn(Vec<1, double> const& by) { angle += by[0]; }
    [[nodiscard]] Matrix<2> matrix() const
    {
        const double c = std::cos(angle), s = std::sin(angle);
        return {Vec<2, double>{{c, -s}}, Vec<2, double>{{s, c}}};
    }
    void each(auto const& f) { f("angle", angle); }
};
template <>
struct Attitude<3> {
    double w = 1;
    Vec<3, double> v{};

    /// About the direction of a vector by its length [rad].
    void turn(Vec<3, double> const& by)
    {
        const double half = 0.5 * std::sqrt(by.squaredNorm()), c = std::cos(half);
        const Vec<3, double> n = (half > 0 ? 0.5 * std::sin(half) / half : 0.5) * by;
        const Vec<3, double> u = c * v + w * n + cross(n, v);
        const double s = c * w - n.dot(v), length = std::sqrt(s * s + u.squaredNorm()); // 1, but for rounding
        w = s / length, v = (1 / length) * u;
    }
    [[nodiscard]] Matrix<3> matrix() const
    {
        Matrix<3> m{};
        for (int k = 0; k < 3; ++k) {
            Vec<3, double> e{};
            e[k] = 1;
            const Vec<3, double> column = e + (2 * w) * cross(v, e) + 2.0 * cross(v, cross(v, e));
            for (int i = 0; i < 3; ++i) m[std::size_t(i)][k] = column[i];
        }
        return m;
    }
    void each(auto const& f) { f("turn w", w), f("turn x", v[0]), f("turn y", v[1]), f("turn z", v[2]); }
};

/// A rigid body about its centre of mass: m dv/dt = F + m g, dL/dt = T, dR/dt = omega x R, omega = R I^-1 R^T L.
/// docs/models/boundaries.md (12), (13).
template <int Dim>
class Body {
public:
    static constexpr int axes = Dim == 3 ? 3 : 1; ///< of rotation
    using Point = Vec<Dim, double>;
    using Axial = Vec<axes, double>;
    struct State {
        Point shift{}, velocity{}; ///< of the centre [m], [m/s]
        Attitude<Dim> attitude;
        Axial angular_momentum{}; ///< about the centre [kg m^2/s]
    };

    double mass = 0;                ///< [kg], in the plane of a metre of it
    Point centre{};                 ///< of mass, at rest [m]
    Matrix<axes> inverse_inertia{}; ///< about the centre, of the body not turned [1/(kg m^2)]
    Point load{};                   ///< a force that never changes [N]
    State state;
    Point acceleration{}; ///< [m/s^2]
    Axial torque{};       ///< about the centre [N m]

    [[nodiscard]] Point place() const { return centre + state.shift; }
    [[nodiscard]] Axial spin() const { return spin_at(state.attitude); } ///< [rad/s]
    /// Whether it is somewhere, and squares of what moves it are numbers.
    [[nodiscard]] bool finite() const
    {
        return std::isfinite(state.shift.squaredNorm() + state.velocity.squaredNorm() + spin().squaredNorm() +
                             acceleration.squaredNorm() + torque.squaredNorm());
    }
    /// 1/2 m v^2 + 1/2 omega . L [J].
    [[nodiscard]] double kinetic_energy() const
    {
        return 0.5 * (mass * state.velocity.squaredNorm() + spin().dot(state.angular_momentum));
    }
    [[nodiscard]] Rigid<Dim> rigid() const
    {
        Rigid<Dim> r{.shift = state.shift, .velocity = state.velocity, .centre = centre};
        r.turn = state.attitude.matrix();
        const Axial omega = spin();
        for (int k = 0; k < Dim; ++k) {
            Point e{}; // of the columns of R' = omega x R
            for (int i = 0; i < Dim; ++i) e[i] = r.turn[std::size_t(i)][k];
            const Point rate = -cross(e, omega);
            for (int i = 0; i < Dim; ++i) r.turn_rate[std::size_t(i)][k] = rate[i];
        }
        return r;
    }
    /// The sums of the forces on it, and of their moments about its centre, without weight.
    void push(Point const& force, Axial const& moment, Point const& g)
    {
        acceleration = g + (1 / mass) * (force + load);
        torque = moment;
    }
    /// From a state with the velocity of now.
    void drift(State const& from, double dt)
    {
        state.shift = from.shift + dt * state.velocity;
        const Axial omega = spin();
        state.attitude = from.attitude;
        state.attitude.turn(dt * omega);
    }
    /// From now, with the spin of halfway: it changes as the body turns, even where no torque acts.
    void drift(double dt)
    {
        state.shift += dt * state.velocity;
        Attitude<Dim> half = state.attitude;
        half.turn((0.5 * dt) * spin());
        state.attitude.turn(dt * spin_at(half));
    }
    void kick(State const& from, double dt)
    {
        state.velocity = from.velocity + dt * acceleration;
        state.angular_momentum = from.angular_momentum + dt * torque;
    }
    /// f(name, number) for all that the steps to come depend on.
    void each_number(auto const& f)
    {
        auto vector = [&](char const* name, auto& v) {
            for (int k = 0; k < int(sizeof(v) / sizeof(double)); ++k) f(along_axis(name, k), v[k]);
        };
        vector("shift", state.shift), vector("velocity", state.velocity);
        state.attitude.each(f);
        vector("angular momentum", state.angular_momentum);
        vector("acceleration", acceleration), vector("torque", torque);
    }

private:
    /// R I^-1 R^T L.
    [[nodiscard]] Axial spin_at(Attitude<Dim> const& attitude) const
    {
        if constexpr (Dim == 2) return inverse_inertia * state.angular_momentum;
        else {
            const Matrix<Dim> R = attitude.matrix();
            Axial back{};
            for (int k = 0; k < 3; ++k) back += state.angular_momentum[k] * R[std::size_t(k)];
            return R * (inverse_inertia * back);
        }
    }
};

} // namespace spate
