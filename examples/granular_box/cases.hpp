// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The cases of the granular box: what acts between grains, where they start, and what walls them in.
///        examples/run.sh chooses one, and the walls of the seed.
#pragma once

#include <cmath>
#include <numbers>
#include <tuple>

#include <spate/io/start_csv.hpp>
#include <spate/io/start_lammps.hpp>
#include <spate/spate.hpp>

#include "granular_box/start.hpp"
#include "support/options.hpp"

#ifndef SPATE_GRAIN_WALLS
#define SPATE_GRAIN_WALLS Elastic
#endif
#ifndef SPATE_GRAIN_CASE
#define SPATE_GRAIN_CASE Seed
#endif

namespace granular {

/// What the command line may change.
struct Numbers {
    double particles, fraction = 0.3, radius = 0.01, mass = 0.1, stiffness = 1e5; // -, -, m, kg, N/m: of the seed deck
    double restitution = 0.7, friction = 0.5, tilt = 0;                           // -, -, degrees
    std::string start = {};

    void options(example::CommandLine& line, bool rough)
    {
        line.number("--particles", particles, "how many", "N");
        line.number("--radius", radius, "of a grain", "m");
        line.number("--mass", mass, "of a grain", "kg");
        line.number("--stiffness", stiffness, "of a contact", "N/m");
        line.text("--start", start, "x, y[, z], vx, vy[, vz] of each grain, or a data file of LAMMPS", "FILE");
        if (!rough) line.number("--fraction", fraction, "of the area that discs cover", "-");
        if (rough) line.number("--restitution", restitution, "of an impact", "-");
        if (rough) line.number("--friction", friction, "coefficient", "-");
        if (rough) line.number("--tilt", tilt, "of gravity towards x", "degrees");
    }
    void check() const
    {
        spate::require_positive("stiffness", stiffness, "N/m");
        spate::require_positive("mass", mass, "kg");
        spate::require_positive("radius", radius, "m");
        spate::require(restitution >= 0 && restitution <= 1, "restitution", restitution, "0 to 1 [-]");
        spate::require_non_negative("friction", friction, "-");
        spate::require(std::abs(tilt) <= 90, "tilt", tilt, "-90 to 90 degrees");
    }
    /// Of a file, if one is named.
    template <int Dim>
    [[nodiscard]] Start<Dim> from_file() const
    {
        const bool table = start.size() > 4 && start.substr(start.size() - 4) == ".csv";
        return table ? spate::io::start_csv<Dim>(start) : spate::io::start_lammps<Dim>(start);
    }
    template <int Dim>
    [[nodiscard]] spate::Gravity<Dim> gravity() const
    {
        spate::Gravity<Dim> down{};
        const double angle = tilt * std::numbers::pi / 180;
        down.g[0] = 9.81 * std::sin(angle), down.g[Dim - 1] = -9.81 * std::cos(angle);
        return down;
    }
};

struct Elastic {
    static auto with(auto const&...) { return spate::open(spate::nowhere); } // faces are mirrors unless they are named
};
struct Spring {
    static auto with(auto const&... term) { return spate::contact(term...); }
};

/// Discs of the seed deck: no friction, no loss, no gravity.
struct Seed {
    static constexpr int dim = 2;
    static constexpr bool rough = false;
    inline static const Numbers numbers{.particles = 262144};
    inline static const example::Options defaults{
        .until = std::numeric_limits<double>::infinity(), .steps = 2000, .history_every = 0.002};

    static Start<2> start(Numbers const& n, std::uint64_t seed)
    {
        if (n.start.empty()) return scattered(std::size_t(n.particles), n.radius, n.fraction, 0.5, seed);
        auto s = n.from_file<2>();
        if (!s.box) s.box = square(s.size(), n.radius, n.fraction);
        return s;
    }
    static auto contact(Numbers const& n) { return std::tuple{spate::LinearSpring{.k = n.stiffness}}; }
    static auto forces(Numbers const&) { return std::tuple<>{}; }
    static auto walls(auto const&... term) { return std::tuple{SPATE_GRAIN_WALLS::with(term...)}; }
};
/// Rough grains under gravity between walls that are as rough.
template <int Dim>
struct Rough {
    static constexpr int dim = Dim;
    static constexpr bool rough = true;
    static auto contact(Numbers const& n)
    {
        return std::tuple{spate::LinearSpring{.k = n.stiffness}, spate::Dashpot{.e = n.restitution},
                          spate::Friction{.mu = n.friction}};
    }
    static auto forces(Numbers const& n) { return std::tuple{n.gravity<Dim>()}; }
    static auto walls(auto const&... term) { return std::tuple{spate::contact(term...), spate::open(spate::top)}; }
};
/// A stack of discs, as high as wide, that falls into a heap and rests.
struct Pile : Rough<2> {
    inline static const Numbers numbers{.particles = 4000, .restitution = 0.3};
    inline static const example::Options defaults{.until = 3, .history_every = 0.01};
    static Start<2> start(Numbers const& n, std::uint64_t seed)
    {
        if (!n.start.empty()) return n.from_file<2>();
        const double wide = 2 * n.radius * std::sqrt(n.particles), floor = 5 * wide;
        const spate::Box<2> stack{{2 * wide, 0}, {3 * wide, wide}};
        auto s = stacked<2>(std::size_t(n.particles), stack, n.radius, 0.05, seed);
        s.box = spate::Box<2>{{0, 0}, {floor, 1.5 * wide}};
        return s;
    }
};
/// A bed of spheres that gravity, tilted by 30 degrees, sets in flow: 0.86 m wide at 100,000 of them.
struct Flow3d : Rough<3> {
    inline static const Numbers numbers{.particles = 100000, .tilt = 30};
    inline static const example::Options defaults{
        .until = std::numeric_limits<double>::infinity(), .steps = 2000, .history_every = 0.01};
    static Start<3> start(Numbers const& n, std::uint64_t seed)
    {
        if (!n.start.empty()) return n.from_file<3>();
        const double wide = 86 * n.radius * std::cbrt(n.particles / 1e5);
        auto s = stacked<3>(std::size_t(n.particles), {{0, 0, 0}, {wide, wide, wide}}, n.radius, 0.5, seed);
        s.box = spate::Box<3>{{0, 0, 0}, {wide, wide, 1.5 * wide}};
        return s;
    }
};
using Case = SPATE_GRAIN_CASE;

} // namespace granular
