// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The bodies of a boundary that move by the forces on them: sums of forces that do not depend on their order, and
/// what bounds the step.
#pragma once

#include "spate/boundary/floating.hpp"
#include "spate/core/reduction.hpp"

#include <algorithm>
#include <map>
#include <vector>

namespace spate {

template <int Dim, int N>
class Bodies {
    static constexpr int axes = Body<Dim>::axes, each = Dim + axes;
    using Point = Vec<Dim, double>;

public:
    static constexpr int count = N;
    /// Of forces and of their moments.
    using Sums = std::array<ExactSum, std::size_t(N* each)>;

    Body<Dim>& operator[](int k) { return now_[std::size_t(k)]; }
    Body<Dim> const& operator[](int k) const { return now_[std::size_t(k)]; }

    void add(Sums& sums, int k, Point const& place, Point const& force) const
    {
        const auto moment = cross(place - (*this)[k].place(), force);
        for (int c = 0; c < Dim; ++c) sums[std::size_t(k * each + c)].add(force[c]);
        for (int c = 0; c < axes; ++c) sums[std::size_t(k * each + Dim + c)].add(moment[c]);
    }
    void push(Sums const& sums, Point const& g)
    {
        for (int k = 0; k < N; ++k) {
            Point force{};
            typename Body<Dim>::Axial moment{};
            for (int c = 0; c < Dim; ++c) force[c] = sums[std::size_t(k * each + c)].value();
            for (int c = 0; c < axes; ++c) moment[c] = sums[std::size_t(k * each + Dim + c)].value();
            (*this)[k].push(force, moment, g);
        }
    }
    /// Fields of a set by their rates, as an integrator asks for them.
    template <bool from_start, class... F>
    void advance(Fields<F...>, double dt)
    {
        using Set = Fields<F...>;
        for (std::size_t k = 0; k < std::size_t(N); ++k) {
            if constexpr (Set::template contains<Position>) {
                if constexpr (from_start) now_[k].drift(kept_[k], dt);
                else now_[k].drift(dt);
            }
            if constexpr (Set::template contains<Velocity>) now_[k].kick(from_start ? kept_[k] : now_[k].state, dt);
        }
    }
    void keep()
    {
        for (std::size_t k = 0; k < std::size_t(N); ++k) kept_[k] = now_[k].state;
    }
    void restore()
    {
        for (std::size_t k = 0; k < std::size_t(N); ++k) now_[k].state = kept_[k];
    }
    /// Largest acceleration of a point within `radius` of a centre [m/s^2].
    [[nodiscard]] double acceleration(double radius) const
    {
        double most = 0;
        for (auto const& b : now_) {
            const auto turning = b.inverse_inertia * b.torque;
            most = std::max(most, std::sqrt(b.acceleration.squaredNorm()) +
                                      radius * (std::sqrt(turning.squaredNorm()) + b.spin().squaredNorm()));
        }
        return most;
    }

private:
    std::array<Body<Dim>, std::size_t(N)> now_{};
    std::array<typename Body<Dim>::State, std::size_t(N)> kept_{};
};

/// How fast a body answers to what holds it, in a fluid that stands still on the lattice around it.
struct BodyRates {
    double frequency = 0; ///< against the compression of the fluid and of contacts [1/s]
    double decay = 0;     ///< by viscosity and by the damping of contacts [1/s]

    /// With contacts of so many markers.
    [[nodiscard]] BodyRates with_contacts(double markers, BodyContact const& of, double mass) const
    {
        return {std::sqrt(frequency * frequency + markers * of.k / mass), decay + markers * of.c / mass};
    }
    /// 1/(largest step at C = 1) [1/s]: C is omega dt of a spring, half of dt times a decay.
    [[nodiscard]] double rate() const { return std::max(frequency, decay / 2); }
};
/// K = 2 rho c^2 V sum_f S_f S_f, S_f = sum_w V grad W_fw, and with the arms of the markers for turning; D = 4 nu rho V^2
/// sum_f sum_w (-x . grad W)/r^2. docs/models/boundaries.md (15).
/// \param markers  of the body    \param inside  whether a point of the lattice is in its solid
template <int Dim, class I>
[[gnu::cold]] BodyRates rates_of_body(Body<Dim> const& body, std::vector<Vec<Dim, double>> const& markers,
                                      auto const& inside, I const& interaction, double spacing, double rho, double c,
                                      double nu)
{
    struct At {
        Vec<Dim, double> x;
        Vec<Dim, double> const& operator[](Position) const { return x; }
    };
    struct Sums {
        Vec<Dim, double> push{};
        typename Body<Dim>::Axial turn{};
    };
    const double V = std::pow(spacing, Dim), range = interaction.range();
    const int reach = int(std::ceil(range / spacing));
    std::map<std::array<long, std::size_t(Dim)>, Sums> fluid;
    double shear = 0, turned = 0;
    int near = 1;
    for (int d = 0; d < Dim; ++d) near *= 2 * reach + 1;
    for (auto const& w : markers)
        for (int k = 0; k < near; ++k) {
            std::array<long, std::size_t(Dim)> at{};
            Vec<Dim, double> f = w;
            for (int d = 0, rest = k; d < Dim; ++d, rest /= 2 * reach + 1) {
                f[d] += (rest % (2 * reach + 1) - reach) * spacing;
                at[std::size_t(d)] = std::lround((f[d] - markers.front()[d]) / spacing);
            }
            if (!((f - w).squaredNorm() < range * range) || inside(f)) continue;
            const auto ij = interaction.template pair<double>(At{f}, At{w});
            Vec<Dim, double> grad{};
            for (int d = 0; d < Dim; ++d) grad[d] = V * ij.grad_w[d];
            const auto arm = w - body.centre;
            auto& s = fluid[at];
            s.push += grad, s.turn += cross(arm, grad);
            const double dent = -V * grad.dot(ij.x) / ij.r2;
            shear += dent, turned += dent * arm.squaredNorm();
        }
    Vec<Dim, double> K{};
    typename Body<Dim>::Axial turning{};
    for (auto const& [at, s] : fluid) {
        for (int d = 0; d < Dim; ++d) K[d] += s.push[d] * s.push[d];
        for (int d = 0; d < Body<Dim>::axes; ++d) turning[d] += s.turn[d] * s.turn[d];
    }
    const double stiff = 2 * rho * c * c * V, viscous = 4 * nu * rho;
    double omega2 = 0, decay = viscous * shear / body.mass;
    for (int d = 0; d < Dim; ++d) omega2 = std::max(omega2, stiff * K[d] / body.mass);
    for (int d = 0; d < Body<Dim>::axes; ++d) {
        const double over_I = body.inverse_inertia[std::size_t(d)][d];
        omega2 = std::max(omega2, stiff * turning[d] * over_I), decay = std::max(decay, viscous * turned * over_I);
    }
    return {std::sqrt(omega2), decay};
}

} // namespace spate
