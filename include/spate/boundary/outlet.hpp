// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Where particles leave during a run. Not a wall, not an open end: those stop nobody, and let nobody go.
#pragma once

#include "spate/boundary/solid/half_space.hpp"
#include "spate/boundary/solid/solid.hpp"
#include "spate/core/box.hpp"
#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"

#include <cstdint>

namespace spate {

struct OutletOptions {
    int every = 10; ///< steps between two looks; where somebody leaves, lists are built anew
};

/// All that lies beyond a face of a box: `Outlet(beyond(tank, right))`.
template <int Dim>
HalfSpace<Dim> beyond(Box<Dim> const& box, Face face)
{
    const int axis = axis_of<Dim>(face);
    HalfSpace<Dim> half{face.upper ? box.hi : box.lo, {}};
    half.normal[axis] = face.upper ? -1 : 1;
    return half;
}

/// Given to run: before each `every`th step the particles whose centres are in the region are removed. The scene counts
/// what they take along; ids are not given again. docs/models/boundaries.md, Outlets and pours.
/// \tparam Region  a solid
template <class Region>
class Outlet {
public:
    explicit Outlet(Region region, OutletOptions options = {}) : region_(region), options_(options) {}

    void begin(auto& scene)
    {
        static_assert(
            Solid<Region, std::remove_cvref_t<decltype(scene)>::dim>,
            "spate: the region of an Outlet is a solid of the scene's dimension, such as a Box or beyond(box, right)");
        require(options_.every >= 1, "OutletOptions.every", options_.every, "1 or above [steps]");
        if constexpr (requires { region_.check(); }) region_.check();
    }
    void before_step(auto& scene)
    {
        if (scene.steps() % options_.every != 0) return;
        auto const& grid = scene.system().grid();
        const auto gone = scene.remove([&](auto const& p, std::size_t i) {
            auto x = p.at(position, i);
            for (int c = 0; c < p.dim; ++c) x[c] = grid.wrapped(c, x[c]);
            return region_.distance(x) < 0;
        });
        particles_ += gone.particles, mass_ += gone.mass;
    }
    void step(auto&) {}
    void end(auto&) {}

    /// How many have left here, and their mass [kg].
    [[nodiscard]] std::int64_t particles() const { return particles_; }
    [[nodiscard]] double mass() const { return mass_; }

    /// f(name, number) for what a run that goes on must know: see io/resume.hpp.
    void notes(auto const& f) { f("outlet_particles", particles_), f("outlet_mass", mass_); }

private:
    Region region_;
    OutletOptions options_;
    std::int64_t particles_ = 0;
    double mass_ = 0;
};

} // namespace spate
