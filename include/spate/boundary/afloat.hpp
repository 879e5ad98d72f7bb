// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What a boundary of markers does because some of its obstacles float: the forces on their markers and contacts
/// become forces on bodies, and markers follow them. Not the bodies themselves: those are boundary/bodies.hpp.
#pragma once

#include "spate/boundary/bodies.hpp"
#include "spate/boundary/parts.hpp"
#include "spate/boundary/reaction.hpp"

namespace spate {

/// Where bodies are: the box and its edges, and the motion of each part of the walls.
template <int Dim, class Motions>
struct Surroundings {
    Box<Dim> const& box;
    Edges<Dim> const& edges;
    Motions const& motion; ///< by part
};

template <int Dim, class Parts>
class Afloat {
    using Wall = detail::Wall<Dim, Parts>;
    using Point = Vec<Dim, double>;

public:
    static constexpr int count = Wall::floating;
    using Sums = typename Bodies<Dim, count>::Sums;

    /// \param tie  to the surface of a solid, that belongs to it [m]    \param lattice  calls f(x) for each point in the box
    [[gnu::cold]] void weigh(Parts const& parts, double spacing, double tie, auto const& lattice)
    {
        spacing_ = spacing, tie_ = tie;
        std::array<std::vector<Point>, std::size_t(1 + Wall::obstacles)> points;
        lattice([&](Point const& x) {
            int of = 0; // the first solid that holds the point
            detail::each_obstacle(parts, [&](int part, auto const& o) {
                if (of == 0 && o.solid.distance(x) <= tie) of = part;
            });
            points[std::size_t(of)].push_back(x);
        });
        int next = 0;
        number_.fill(-1);
        detail::each_obstacle(parts, [&]<class O>(int of, O const& o) {
            if constexpr (detail::floats<O>) {
                o.law.check();
                auto const& mine = points[std::size_t(of)];
                bodies_[next] = detail::body_of(o.law, mine, spacing);
                for (auto const& x : mine)
                    farthest_ = std::max(farthest_, std::sqrt((x - bodies_[next].centre).squaredNorm()));
                number_[std::size_t(of)] = next++;
            }
        });
    }
    auto& bodies() { return bodies_; }
    auto const& bodies() const { return bodies_; }

    /// The motions of the bodies become those of their states.
    void turn(auto& motion) const
    {
        for (std::size_t of = 0; of < number_.size(); ++of)
            if (number_[of] >= 0) motion[of] = bodies_[number_[of]].rigid();
    }
    /// Adds the forces on markers first to last.
    void add_push(Sums& sums, auto const& markers, std::size_t first, std::size_t last, Parts const& parts,
                  auto const& around) const
    {
        for (std::size_t i = first; i < last; ++i) {
            const auto of = std::size_t(markers.at(part, i));
            const int k = number_[of];
            if (k < 0) continue;
            const Point x0 = markers.at(rest_position, i);
            bodies_.add(sums, k, around.motion[of].position_of(x0), markers.at(push, i));
            detail::each_obstacle(parts, [&]<class O>(int mine, O const& o) {
                if constexpr (detail::floats<O>)
                    if (std::size_t(mine) == of && o.law.contact.k > 0 && at_surface(o.solid, x0))
                        touch(mine, o.law.contact, x0, parts, around, [&](int q, Point const& x, Point const& force) {
                            if (const int b = number_[std::size_t(q)]; b >= 0) bodies_.add(sums, b, x, force);
                        });
            });
        }
    }
    /// Puts markers first to last where their bodies are. \param nearest  the same vector, less whole periods
    void carry(auto& markers, std::size_t first, std::size_t last, auto const& motion, auto const& nearest) const
    {
        for (std::size_t i = first; i < last; ++i) {
            const auto of = std::size_t(markers.at(part, i));
            if (number_[of] < 0) continue;
            const Point x0 = markers.at(rest_position, i), x = markers.at(position, i);
            markers.put(position, i, x + nearest(motion[of].position_of(x0) - x));
            markers.put(velocity, i, motion[of].velocity_of(x0));
        }
    }
    /// Largest acceleration of a marker of a body [m/s^2].
    [[nodiscard]] double acceleration() const { return bodies_.acceleration(farthest_); }
    /// 1/(largest step at C = 1) of the body that answers fastest [1/s]. \param place  calls f(x, part) for each marker
    [[gnu::cold]] [[nodiscard]] double rate(Parts const& parts, auto const& interaction, double rho0, double c0,
                                            double nu, auto const& place) const
    {
        std::array<std::vector<Point>, std::size_t(1 + Wall::obstacles)> markers;
        place([&](Point const& x, int of) { markers[std::size_t(of)].push_back(x); });
        double most = 0;
        detail::each_obstacle(parts, [&]<class O>(int of, O const& o) {
            if constexpr (detail::floats<O>) {
                auto const& mine = markers[std::size_t(of)];
                auto const& body = bodies_[number_[std::size_t(of)]];
                const auto inside = [&](Point const& x) { return o.solid.distance(x) <= tie_; };
                const BodyRates r = rates_of_body<Dim>(body, mine, inside, interaction, spacing_, rho0, c0, nu);
                double skin = 0;
                for (auto const& x : mine) skin += at_surface(o.solid, x);
                most = std::max(most, r.with_contacts(skin, o.law.contact, body.mass).rate());
            }
        });
        return most;
    }

private:
    [[nodiscard]] bool at_surface(auto const& solid, Point const& x0) const { return solid.distance(x0) > -spacing_; }
    /// f(part, place, force) for both sides of each contact of a marker with the lining and other solids.
    void touch(int of, BodyContact const& law, Point const& x0, Parts const& parts, auto const& around,
               auto const& f) const
    {
        auto const& mine = around.motion[std::size_t(of)];
        const Point x = mine.position_of(x0), v = mine.velocity_of(x0);
        auto meet = [&](int q, double distance, Point const& n, Point const& there) {
            const double overlap = spacing_ / 2 - distance;
            if (!(overlap > 0)) return;
            const double parting = n.dot(v - around.motion[std::size_t(q)].velocity_of(there));
            const Point force = std::max(0.0, law.k * overlap - law.c * parting) * n;
            f(of, x, force), f(q, x, -force);
        };
        auto const& lining = around.motion[0];
        const Point at = lining.rest_of(x);
        for (int c = 0; c < Dim; ++c)
            for (const bool upper : {false, true}) {
                if (around.edges.at(c, upper) != Edge::wall) continue;
                Point n{};
                n[c] = upper ? -1 : 1;
                meet(0, upper ? around.box.hi[c] - at[c] : at[c] - around.box.lo[c], lining.turn * n, at);
            }
        detail::each_obstacle(parts, [&](int q, auto const& o) {
            if (q == of) return;
            auto const& other = around.motion[std::size_t(q)];
            const Point there = other.rest_of(x);
            const double distance = o.solid.distance(there);
            if (distance < spacing_ / 2) meet(q, distance, other.turn * normal_of(o.solid, there), there);
        });
    }
    /// Out of a solid, by differences of its distance; none where no point of the surface is nearest.
    [[nodiscard]] Point normal_of(auto const& solid, Point const& x) const
    {
        const double step = 1e-3 * spacing_;
        Point n{};
        for (int c = 0; c < Dim; ++c) {
            Point up = x, down = x;
            up[c] += step, down[c] -= step;
            n[c] = solid.distance(up) - solid.distance(down);
        }
        const double length = std::sqrt(n.squaredNorm());
        return length > 0 ? (1 / length) * n : n;
    }

    Bodies<Dim, count> bodies_;
    std::array<int, std::size_t(1 + Wall::obstacles)> number_{}; ///< of the body of a part, -1: none
    double farthest_ = 0;                                        ///< point of a body from its centre [m]
    double spacing_ = 0, tie_ = 0;                               ///< [m]
};
/// Nothing floats.
struct Aground {};
template <int Dim, class Parts>
using AfloatIfAny = std::conditional_t<(detail::Wall<Dim, Parts>::floating > 0), Afloat<Dim, Parts>, Aground>;

} // namespace spate
