// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Walls of markers (boundary condition enforcing): layers of particles on the lattice of the fluid's spacing,
/// a species of their own that others see and that sees others only.
#pragma once

#include "spate/boundary/afloat.hpp"
#include "spate/boundary/parts.hpp"
#include "spate/boundary/periodic.hpp"
#include "spate/core/box.hpp"
#include "spate/core/fields.hpp"

#include <cmath>
#include <optional>

namespace spate {

/// A box lined with markers, and solids of markers in it: `Bce tank(Box<3>{...}, dx, Adami{}, open(top))`. Faces may be
/// open, axes periodic. Layers lie at 1/2, 3/2, ... spacings outside the faces, as many as the range needs, or as `layers`
/// asks for; the markers of a solid are the points of the same lattice in it, as deep.
/// \tparam State  how the markers get density and pressure: ByContinuity, Adami or Extrapolated
/// \tparam Parts  options other than open and periodic: layers, no_slip, free_slip, lid, moving, obstacle
template <int Dim, class State, class Parts = std::tuple<>>
class Bce {
    using Wall = detail::Wall<Dim, Parts>;
    static constexpr bool mirrors = []() {
        if constexpr (requires { State::mirrors; }) return bool(State::mirrors);
        else return false;
    }();
    static_assert(
        !(mirrors && (Wall::no_slip || Wall::free_slip)),
        "spate: Extrapolated mirrors the velocity in all terms; leave no_slip and free_slip out, or take Adami");
    using Along = Tangential<typename Wall::Slip, mirrors>;

public:
    static constexpr bool markers = true;
    static constexpr bool moves = Wall::moves;                  ///< markers follow a law
    static constexpr bool floats = Wall::floating > 0;          ///< some follow the forces on them
    static constexpr bool has_velocity = moves || Wall::slides; ///< they have velocities of their own
    /// Of the markers: no array.
    static constexpr auto uniform = Fields{mass} | detail::only_if<!has_velocity>(Fields{velocity});
    static constexpr auto state = State::fields | detail::only_if<has_velocity>(Fields{velocity}) |
                                  detail::only_if<moves>(Fields{acceleration, rest_position, part, build_position});
    static constexpr auto given = detail::only_if<moves>(Fields{acceleration});
    static constexpr auto forces = detail::only_if<floats>(Fields{push}); ///< that bodies move by

    template <class... Options>
    [[gnu::cold]] Bce(Box<Dim> box, double spacing, State how, Options... options)
        : box_(box), spacing_(spacing), how_(how), edges_(Edge::wall), parts_(detail::parts_of<Dim>(options...))
    {
        [[maybe_unused]] auto edge = [&]<class O>(O const& o) {
            if constexpr (detail::EdgeOption<O, Dim>) apply(edges_, o);
        };
        (edge(options), ...);
        [[maybe_unused]] auto at_least = [&]<class O>(O const& o) {
            if constexpr (std::same_as<O, Layers>) least_layers_ = o.least;
        };
        (at_least(options), ...);
        require_positive("Bce.spacing", spacing, "m");
        for (int c = 0; c < Dim; ++c) {
            const std::string length = along_axis("Bce.box length", c);
            require_positive(length, box.size()[c], "m");
            const double n = box.size()[c] / spacing;
            require(n > 1 - 1e-6, "Bce.spacing", spacing, "at most the box length " + text(box.size()[c]) + " m");
            require(n < 1e9, "Bce.spacing", spacing, "at least a billionth of the box length");
            require(std::abs(n - std::round(n)) < 1e-6 * n, length, box.size()[c],
                    "a whole number of spacings; the nearest is " + text(std::round(n) * spacing) +
                        " m, or take spacing " + text(box.size()[c] / std::round(n)) + " m");
        }
        each_lid([&](auto const& lid) {
            const int axis = axis_of<Dim>(lid.face);
            if (edges_.at(axis, lid.face.upper) != Edge::wall)
                throw BadInput("the face of a lid", "open or periodic", "a wall");
            require(lid.velocity[axis] == 0, along_axis("lid velocity", axis), lid.velocity[axis],
                    "0 [m/s]: a lid slides in its own plane");
        });
        if constexpr (floats) {
            Vec<Dim, double> x{};
            afloat_.weigh(parts_, spacing_, tie(),
                          [&](auto const& f) { place_axis<Dim - 1>(0, x, true, [&](bool) { f(x); }); });
            afloat_.turn(rigid_);
        }
    }
    /// The terms of the physics as far as they do not see walls in a way of their own.
    template <class Terms>
    [[nodiscard]] auto own(Terms const& terms) const
    {
        return Along::own(terms);
    }
    template <class P>
    [[nodiscard]] auto terms(P const& physics) const
    {
        static_assert(!Wall::no_slip || detail::any_viscous<typename P::Terms>,
                      "spate: no_slip acts in viscous terms, and the model has none; add LaminarViscosity{.mu}");
        auto made = how_.template terms<moves>(physics);
        if constexpr (Along::mirrors) {
            auto const& kernel = physics.interaction.kernel;
            auto seen = Along::at_wall(physics.terms, made, 1e-6 * kernel.sigma() * kernel.f(0.0));
            return with_reactions(physics, std::tuple_cat(std::move(made), std::move(seen)));
        }
        else return with_reactions(physics, std::move(made));
    }
    template <int>
    [[nodiscard]] Edges<Dim> const& edges() const
    {
        return edges_;
    }
    template <int>
    [[nodiscard]] std::optional<Box<Dim>> box() const
    {
        return box_;
    }
    [[nodiscard]] double spacing() const { return spacing_; }
    [[nodiscard]] int layers(double range) const
    {
        return std::max(least_layers_, int(std::ceil(range / spacing_ - 1e-9)));
    }
    [[nodiscard]] double thickness(double range) const { return layers(range) * spacing_; }
    void check(double reach) const
    {
        constexpr double most = 64; // layers of markers
        require(!(reach > most * spacing_), "Bce.spacing", spacing_,
                "at least " + text(reach / most) + " m, a 64th of the reach of the neighbour lists");
        Periodic<Dim>::check_periodic(box_, edges_, reach);
    }

    /// f(x) or f(x, part) for each marker, at rest, of walls that cover `range`.
    void place(double range, auto const& f) const
    {
        auto give = [&](Vec<Dim, double> const& x, int part) {
            if constexpr (requires { f(x, part); }) f(x, part);
            else f(x);
        };
        Vec<Dim, double> x{};
        place_axis<Dim - 1>(layers(range), x, true, [&](bool in) {
            if (!in) return give(x, 0);
            int of = 0; // the first solid that holds the point
            each_obstacle([&](int part, auto const& o) {
                if (of > 0) return;
                const double d = o.solid.distance(x);
                if (d > tie()) return;
                of = part;
                if (d > -thickness(range)) give(x, part);
            });
        });
    }
    /// Whether a solid covers x: no place for a particle. A point of the lattice on a surface belongs to the solid.
    [[nodiscard]] bool covers(Vec<Dim, double> const& x) const
    {
        bool is = false;
        each_obstacle([&](int part, auto const& o) {
            is = is || o.solid.distance(rigid_[std::size_t(part)].rest_of(x)) <= tie();
        });
        return is;
    }
    /// The largest distance of x beyond a wall face or into a solid [m]; 0 or less: inside.
    template <int>
    [[nodiscard]] double beyond(Vec<Dim, double> const& x) const
    {
        return std::max(beyond_faces(x), into_solids(x));
    }
    /// Whether x has passed the first layer of markers: half a spacing beyond a face; on the lattice, that of a solid lies up
    /// to a spacing deep.
    [[nodiscard]] bool passed(Vec<Dim, double> const& x) const
    {
        return beyond_faces(x) > spacing_ / 2 || into_solids(x) > spacing_;
    }

    // ---- walls that move
    using Motions = std::array<Rigid<Dim>, std::size_t(1 + Wall::obstacles)>; ///< by part
    /// The motion of each part at a time.
    [[nodiscard]] Motions motions(double t) const
    {
        Motions m{};
        std::apply([&](auto const&... o) { (lining_law(o, m[0], t), ...); }, parts_);
        each_obstacle([&](int part, auto const& o) {
            auto& mine = m[std::size_t(part)];
            if constexpr (requires { o.law(t); }) mine = o.law(t);
            else if constexpr (detail::floats<std::remove_cvref_t<decltype(o)>>) mine = rigid_[std::size_t(part)];
            else mine = m[0];
        });
        return m;
    }
    /// From now on the walls are where they are at time t.
    void move_to(double t)
    {
        if constexpr (floats) turn_bodies();
        rigid_ = motions(t);
    }
    /// The velocity of a marker within the plane of its face.
    [[nodiscard]] Vec<Dim, double> sliding(Vec<Dim, double> const& x0) const
    {
        Vec<Dim, double> v{};
        each_lid([&](auto const& lid) {
            const int c = axis_of<Dim>(lid.face);
            if (lid.face.upper ? x0[c] > box_.hi[c] : x0[c] < box_.lo[c]) v += lid.velocity;
        });
        return v;
    }

    // ---- walls that float
    auto& bodies() requires(floats) { return afloat_.bodies(); }
    auto const& bodies() const requires(floats) { return afloat_.bodies(); }
    /// Adds the forces on markers first to last to those on their bodies.
    void add_push(auto& sums, auto const& markers, std::size_t first, std::size_t last) const
    {
        afloat_.add_push(sums, markers, first, last, parts_, Surroundings<Dim, Motions>{box_, edges_, rigid_});
    }
    /// The bodies are where their states say.
    void turn_bodies() { afloat_.turn(rigid_); }
    /// ... and so are markers first to last. \param nearest  the same vector, less whole periods
    void carry(auto& markers, std::size_t first, std::size_t last, auto const& nearest) const
    {
        afloat_.carry(markers, first, last, rigid_, nearest);
    }
    /// Largest acceleration of a marker of a body [m/s^2].
    [[nodiscard]] double body_acceleration() const { return afloat_.acceleration(); }
    /// 1/(largest step at C = 1) of the body that answers fastest [1/s].
    [[gnu::cold]] [[nodiscard]] double body_rate(auto const& interaction, double rho0, double c0, double nu) const
    {
        return afloat_.rate(parts_, interaction, rho0, c0, nu, [&](auto const& f) { place(interaction.range(), f); });
    }
    /// f(name, number) for all that the motion of the bodies depends on.
    template <class Self>
    [[gnu::cold]] static void numbers_of(Self& self, auto const& f)
    {
        for (int k = 0; k < Wall::floating; ++k)
            self.bodies()[k].each_number(
                [&](std::string const& what, auto& value) { f("body " + std::to_string(k) + " " + what, value); });
    }

private:
    [[nodiscard]] double tie() const { return 1e-9 * spacing_; }
    template <class P, class Made>
    auto with_reactions([[maybe_unused]] P const& physics, Made made) const
    {
        if constexpr (floats) {
            auto reactions = detail::reactions_of(std::tuple_cat(own(physics.terms), made));
            return std::tuple_cat(std::move(made), std::move(reactions));
        }
        else return made;
    }
    [[nodiscard]] double beyond_faces(Vec<Dim, double> const& x) const
    {
        double far = -std::numeric_limits<double>::infinity();
        const Vec<Dim, double> at = moves ? rigid_[0].rest_of(x) : x;
        for (int c = 0; c < Dim; ++c) {
            if (edges_.at(c, false) == Edge::wall) far = std::max(far, box_.lo[c] - at[c]);
            if (edges_.at(c, true) == Edge::wall) far = std::max(far, at[c] - box_.hi[c]);
        }
        return far;
    }
    [[nodiscard]] double into_solids(Vec<Dim, double> const& x) const
    {
        double deep = -std::numeric_limits<double>::infinity();
        each_obstacle([&](int part, auto const& o) {
            deep = std::max(deep, -o.solid.distance(moves ? rigid_[std::size_t(part)].rest_of(x) : x));
        });
        return deep;
    }
    template <int c>
    [[gnu::cold]] void place_axis(int layers, Vec<Dim, double>& x, bool inside, auto const& f) const
    {
        const int n = int(std::round(box_.size()[c] / spacing_));
        const int first = edges_.at(c, false) == Edge::wall ? -layers : 0;
        const int last = edges_.at(c, true) == Edge::wall ? n + layers : n;
        for (int k = first; k < last; ++k) {
            x[c] = box_.lo[c] + (k + 0.5) * spacing_;
            const bool in = inside && k >= 0 && k < n;
            if constexpr (c > 0) place_axis<c - 1>(layers, x, in, f);
            else f(in);
        }
    }
    template <class O>
    static void lining_law([[maybe_unused]] O const& o, [[maybe_unused]] Rigid<Dim>& m, [[maybe_unused]] double t)
    {
        if constexpr (detail::is_moving<O>) m = o.law(t);
    }
    void each_obstacle(auto const& f) const { detail::each_obstacle(parts_, f); }
    void each_lid(auto const& f) const
    {
        auto one = [&]<class O>(O const& o) {
            if constexpr (detail::is_lid<O>) f(o);
        };
        std::apply([&](auto const&... o) { (one(o), ...); }, parts_);
    }

    Box<Dim> box_;
    double spacing_;
    State how_;
    Edges<Dim> edges_;
    int least_layers_ = 1;
    [[no_unique_address]] Parts parts_;
    Motions rigid_{};
    [[no_unique_address]] AfloatIfAny<Dim, Parts> afloat_{};
};
template <int Dim, class State, class... Options>
Bce(Box<Dim>, double, State, Options...) -> Bce<Dim, State, detail::PartsOf<Dim, Options...>>;

} // namespace spate
