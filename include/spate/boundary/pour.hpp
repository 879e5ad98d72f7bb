// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Where particles enter during a run: at a rate, at places drawn from a seed and their number alone.
#pragma once

#include "spate/core/box.hpp"
#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/core/ranks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace spate {

template <int Dim>
struct PourOptions {
    double rate;                                                  ///< particles a second [1/s]
    Vec<Dim, double> velocity{};                                  ///< with which they enter [m/s]
    double from = 0;                                              ///< first one [s]
    double until = std::numeric_limits<double>::infinity();       ///< [s]
    std::int64_t most = std::numeric_limits<std::int64_t>::max(); ///< particles in all
    double apart = 0;       ///< least distance to all others [m], where radii do not keep them further apart
    std::uint64_t seed = 0; ///< of the places
    int every = 10;         ///< steps between two looks
    int tries = 20;         ///< places drawn for one particle in a look
};

/// Numbers from 0 to below 1 that depend on the seed and on how often a place was tried, on nothing else.
struct Draw {
    std::uint64_t state;
    std::int64_t number; ///< of the particle, from 0
    double late;         ///< since it was due [s]

    double operator()()
    {
        std::uint64_t z = state += 0x9E3779B97F4A7C15u; // splitmix64 (Steele, Lea & Flood 2014)
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
};

/// Given to run: `Pour(Box<2>{...}, {.rate = 200, .velocity = {0, -1}, .until = 3})`. Particle k is due at from + k / rate
/// and enters before the next `every`th step at which it finds room; those that do not, wait. `give(particles, i, draw)`
/// may set its fields. Nothing of it depends on who computes. docs/models/boundaries.md, Outlets and pours.
template <int Dim, class Give = std::nullptr_t>
class Pour {
public:
    Pour(Box<Dim> region, PourOptions<Dim> options, Give give = {}) : region_(region), options_(options), give_(give) {}

    void begin(auto& scene)
    {
        static_assert(std::remove_cvref_t<decltype(scene)>::dim == Dim,
                      "spate: the region of a Pour has another number of dimensions than the scene");
        auto const& o = options_;
        require_positive("PourOptions.rate", o.rate, "1/s");
        require_finite("PourOptions.from", o.from, "s");
        require(o.until >= o.from, "PourOptions.until", o.until, "from or later [s]");
        require(o.most >= 0, "PourOptions.most", double(o.most), "0 or above");
        require_non_negative("PourOptions.apart", o.apart, "m");
        require(o.every >= 1, "PourOptions.every", o.every, "1 or above [steps]");
        require(o.tries >= 1, "PourOptions.tries", o.tries, "1 or above");
        for (int c = 0; c < Dim; ++c) require_non_negative(along_axis("Pour.region length", c), region_.size()[c], "m");
        for (auto const& corner : {region_.lo, region_.hi}) {
            const double beyond = scene.system().boundary().template beyond<Dim>(corner);
            require(!(beyond > 0), "the distance of Pour.region beyond a wall", beyond, "0: it is inside the walls");
        }
    }
    void before_step(auto& scene)
    {
        if (scene.steps() % options_.every != 0) return;
        const std::int64_t due = due_at(scene.time()) - entered_;
        if (due <= 0) return;
        auto more = scene.newcomers();
        const auto near = all_near(scene);
        for (std::int64_t k = 0; k < due && found_room(scene, near, more); ++k) ++entered_;
        waiting_ = due - std::int64_t(more.size());
        scene.enter(more);
    }
    void step(auto&) {}
    void end(auto&) {}

    /// How many have entered here.
    [[nodiscard]] std::int64_t particles() const { return entered_; }
    /// How many were due at the last look and found no room.
    [[nodiscard]] std::int64_t waiting() const { return waiting_; }

    /// f(name, number) for what a run that goes on must know: see io/resume.hpp.
    void notes(auto const& f) { f("pour_particles", entered_), f("pour_waiting", waiting_), f("pour_tried", tried_); }

private:
    struct Ball {
        Vec<Dim, double> x;
        double r;
    };
    [[nodiscard]] std::int64_t due_at(double t) const
    {
        auto const& o = options_;
        if (t < o.from) return 0;
        constexpr double many = 1e18; // below the largest integer
        const double by_now = std::floor((t - o.from) * o.rate) + 1, in_all = std::ceil((o.until - o.from) * o.rate);
        return std::min(o.most, std::int64_t(std::min({by_now, in_all, many})));
    }
    template <class P>
    static double radius_of([[maybe_unused]] P const& p, [[maybe_unused]] std::size_t i)
    {
        if constexpr (P::template has<Radius>) return p.at(radius, i);
        else return 0;
    }
    static double between(auto const& scene, Vec<Dim, double> const& a, Vec<Dim, double> const& b)
    {
        auto const& grid = scene.system().grid();
        auto x = a - b;
        for (int c = 0; c < Dim; ++c)
            if (grid.periodic(c)) x[c] -= grid.period(c) * std::round(x[c] / grid.period(c));
        return std::sqrt(x.squaredNorm());
    }
    /// Those that one in the region may touch.
    [[nodiscard]] std::vector<Ball> all_near(auto const& scene) const
    {
        auto const& p = scene.particles();
        const double reach = std::max(options_.apart, scene.physics().interaction.range());
        const auto middle = 0.5 * (region_.lo + region_.hi);
        const double far = 0.5 * std::sqrt(region_.size().squaredNorm()) + reach;
        std::vector<Ball> near;
        for (std::size_t i = 0; i < p.size(); ++i)
            if (between(scene, p.at(position, i), middle) <= far) near.push_back({p.at(position, i), radius_of(p, i)});
        return shared(party_of(scene), std::move(near));
    }
    /// Draws places until the newcomer touches nobody; without one it is not among `more`.
    bool found_room(auto& scene, std::vector<Ball> const& near, auto& more)
    {
        for (int k = 0; k < options_.tries; ++k) {
            Draw draw{options_.seed + 0x632BE59BD9B4E019u * std::uint64_t(tried_++), entered_,
                      scene.time() - options_.from - double(entered_) / options_.rate};
            Vec<Dim, double> x;
            for (int c = 0; c < Dim; ++c) x[c] = region_.lo[c] + draw() * region_.size()[c];
            const std::size_t i = scene.append(more, x, options_.velocity);
            if constexpr (!std::same_as<Give, std::nullptr_t>) give_(more, i, draw);
            if (free(scene, near, more, i)) return true;
            more.resize(i);
        }
        return false;
    }
    bool free(auto const& scene, std::vector<Ball> const& near, auto const& more, std::size_t i) const
    {
        const auto x = more.at(position, i);
        const double r = radius_of(more, i);
        const auto clear = [&](Vec<Dim, double> const& y, double r_y) {
            return between(scene, x, y) > std::max(options_.apart, r + r_y);
        };
        const auto edges = scene.system().boundary().template edges<Dim>();
        const double beyond = scene.system().boundary().template beyond<Dim>(x);
        for (Edge e : edges.face)
            if (e == Edge::wall && beyond > -r) return false;
        for (auto const& ball : near)
            if (!clear(ball.x, ball.r)) return false;
        for (std::size_t k = 0; k < i; ++k)
            if (!clear(more.at(position, k), radius_of(more, k))) return false;
        return true;
    }

    Box<Dim> region_;
    PourOptions<Dim> options_;
    Give give_;
    std::int64_t entered_ = 0, waiting_ = 0, tried_ = 0;
};
template <int Dim>
Pour(Box<Dim>, PourOptions<Dim>) -> Pour<Dim>;

} // namespace spate
