// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Largest values over particles: what the time step, the neighbour lists and the watch ask of a state.
#pragma once

#include "spate/core/fields.hpp"
#include "spate/core/pack.hpp"
#include "spate/core/particles.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace spate {

/// Largest values over the mobile particles; NaN-safe by `poison`.
struct Extremes {
    double speed = 0;                                                         ///< max |v| [m/s]
    double acceleration = 0;                                                  ///< max |a| [m/s^2]
    double moved = 0;                                                         ///< max |x - x_build| [m]
    std::array<double, 3> least_move = ends(1), most_move = ends(-1);         ///< of x - x_build by component [m]
    std::array<double, 3> least_velocity = ends(1), most_velocity = ends(-1); ///< by component [m/s]
    static constexpr std::array<double, 3> ends(int sign)
    {
        const double far = sign * std::numeric_limits<double>::max();
        return {far, far, far};
    }
    double least_density = std::numeric_limits<double>::infinity(), most_density = 0; ///< [kg/m^3]

    double wall_moved = 0; ///< max |x - x_build| of markers that move [m]
    double wall_speed = 0; ///< max |v| of them [m/s]

    double poison = 0; ///< 0, or NaN as soon as an evolving field or an acceleration is not finite

    /// The same of particles that have not moved since the lists were built.
    [[nodiscard]] Extremes unmoved() const
    {
        Extremes e = *this;
        e.moved = e.wall_moved = 0, e.least_move = {}, e.most_move = {};
        return e;
    }
    void operator|=(Extremes const& b)
    {
        speed = std::max(speed, b.speed);
        acceleration = std::max(acceleration, b.acceleration);
        moved = std::max(moved, b.moved);
        for (std::size_t c = 0; c < 3; ++c) {
            least_move[c] = std::min(least_move[c], b.least_move[c]);
            most_move[c] = std::max(most_move[c], b.most_move[c]);
            least_velocity[c] = std::min(least_velocity[c], b.least_velocity[c]);
            most_velocity[c] = std::max(most_velocity[c], b.most_velocity[c]);
        }
        least_density = std::min(least_density, b.least_density);
        most_density = std::max(most_density, b.most_density);
        wall_moved = std::max(wall_moved, b.wall_moved);
        wall_speed = std::max(wall_speed, b.wall_speed);
        poison += b.poison;
    }
};

/// The same lane by lane, as they are gathered.
template <class V, int dim>
struct LaneExtremes {
    using T = scalar_t<V>;
    static constexpr T far = std::numeric_limits<T>::max();
    Vec<dim, V> least_x = all(far), most_x = all(-far), least_v = all(far), most_v = all(-far);
    V v2{0}, a2{0}, x2{0}, least_density{far}, most_density{0}, poison{0};

    static Vec<dim, V> all(T value)
    {
        Vec<dim, V> a;
        for (int c = 0; c < dim; ++c) a[c] = V(value);
        return a;
    }
    /// Particles first to last.
    /// \tparam with_acceleration  whether anyone asks for max |a|    \param evolving  fields that must be finite
    template <bool with_acceleration, class Q>
    void add(Q const& p, std::size_t first, std::size_t last, auto evolving)
    {
        constexpr auto W = std::size_t(width<V>);
        for (; first + W <= last; first += W)
            add<with_acceleration, Q>(evolving, [&](auto f) { return p.template load_at<V>(f, first); });
        if (first == last) return;
        std::int32_t at[W]; // the last again: neither padding nor what is another task's has a say
        for (std::size_t l = 0; l < W; ++l) at[l] = std::int32_t(std::min(l, last - first - 1));
        add<with_acceleration, Q>(evolving, [&]<class F>(F f) {
            if constexpr (Set<Q::uniform>::template contains<F>) return p.template load_at<V>(f, first);
            else return p.template record_of<V>(Fields{f}, std::int32_t(first), at)[f];
        });
    }
    void operator|=(LaneExtremes const& b)
    {
        x2 = max(b.x2, x2), v2 = max(b.v2, v2), a2 = max(b.a2, a2);
        for (int c = 0; c < dim; ++c) {
            least_x[c] = min(b.least_x[c], least_x[c]), most_x[c] = max(b.most_x[c], most_x[c]);
            least_v[c] = min(b.least_v[c], least_v[c]), most_v[c] = max(b.most_v[c], most_v[c]);
        }
        least_density = min(b.least_density, least_density), most_density = max(b.most_density, most_density);
        poison += b.poison;
    }
    /// Of all lanes.
    [[nodiscard]] Extremes over_lanes() const
    {
        Extremes e;
        e.speed = std::sqrt(double(largest(v2)));
        e.acceleration = std::sqrt(double(largest(a2)));
        e.moved = std::sqrt(double(largest(x2)));
        for (int c = 0; c < dim; ++c) {
            const auto k = std::size_t(c);
            e.least_move[k] = -double(largest(V(V(0) - least_x[c])));
            e.most_move[k] = double(largest(most_x[c]));
            e.least_velocity[k] = -double(largest(V(V(0) - least_v[c])));
            e.most_velocity[k] = double(largest(most_v[c]));
        }
        e.least_density = -double(largest(V(V(0) - least_density)));
        e.most_density = double(largest(most_density));
        alignas(64) T lane[std::size_t(width<V>)];
        store(lane, poison);
        for (const T of_lane : lane) e.poison += double(of_lane);
        return e;
    }

private:
    /// One pack. \param of  field -> value
    template <bool with_acceleration, class Q>
    [[gnu::always_inline]] void add(auto evolving, auto const& of)
    {
        const auto v = of(velocity), moved = of(position) - of(build_position);
        const V d2 = moved.squaredNorm(), s2 = v.squaredNorm();
        x2 = max(d2, x2), v2 = max(s2, v2);
        for (int c = 0; c < dim; ++c) {
            least_x[c] = min(moved[c], least_x[c]), most_x[c] = max(moved[c], most_x[c]);
            least_v[c] = min(v[c], least_v[c]), most_v[c] = max(v[c], most_v[c]);
        }
        poison += V(0) * (d2 + s2);
        if constexpr (with_acceleration && Q::template has<Acceleration>) {
            const V n2 = of(acceleration).squaredNorm();
            a2 = max(n2, a2), poison += V(0) * n2;
        }
        for_each(evolving - Fields{position, velocity, density}, [&](auto f) {
            const auto value = of(f);
            if constexpr (decltype(f)::rank == 0) poison += V(0) * value;
            else poison += V(0) * value.squaredNorm();
        });
        if constexpr (Q::template has<Density>) {
            const V rho = of(density);
            least_density = min(rho, least_density), most_density = max(rho, most_density), poison += V(0) * rho;
        }
    }
};

} // namespace spate
