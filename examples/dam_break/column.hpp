// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The boxes of the dam break: the column of Martin & Moyce, and those on which other codes have been timed.
#pragma once

#include <cmath>
#include <string>

#include <unistd.h>

#include <spate/core/box.hpp>

/// A column of water in the left corner of a tank; the first axis is along, the last one up.
template <int Dim>
struct Column {
    spate::Box<Dim> tank, water;
    double spacing; ///< of the particles [m]
    double alpha;   ///< of the artificial viscosity [-]

    [[nodiscard]] double height() const { return water.hi[Dim - 1]; } // [m]
    /// A point x along and z up, in the middle across.
    [[nodiscard]] spate::Vec<Dim, double> at(double x, double z) const
    {
        auto p = 0.5 * tank.hi;
        p[0] = x, p[Dim - 1] = z;
        return p;
    }
};

/// x along, y across, z up in 3D; x and z in 2D.
template <int Dim>
spate::Box<Dim> box_of(double x, double y, double z)
{
    if constexpr (Dim == 3) return {{0, 0, 0}, {x, y, z}};
    else return {{0, 0}, {x, z}};
}

/// Water and three layers of wall around the tank, about.
template <int Dim>
[[gnu::cold]] double markers(Column<Dim> const& c)
{
    double water = 1, tank = 1, all = 1;
    for (int k = 0; k < Dim; ++k) {
        water *= c.water.size()[k] / c.spacing;
        tank *= c.tank.size()[k] / c.spacing;
        all *= c.tank.size()[k] / c.spacing + 6;
    }
    return water + all - tank;
}

/// \param name     default, big, small (3D) or 2d (2D)
/// \param spacing  0: that of the case; else one that divides its boxes [m]
template <int Dim>
[[gnu::cold]] Column<Dim> column(std::string const& name, double spacing)
{
    constexpr double H = 0.6; // [m]
    double unit = H / 4;      // every edge of both boxes is a multiple of it [m]
    Column<Dim> c{box_of<Dim>(4 * H, H / 4, 2 * H), box_of<Dim>(H / 2, H / 4, H), Dim == 3 ? H / 32 : H / 80, 0.02};
    if (name != "default" && (name == "2d") != (Dim == 2))
        throw spate::BadInput("case", name,
                              Dim == 2 ? "default or 2d with --dim 2" : "default, big or small with --dim 3");
    if (name == "big" || name == "small")
        c = {box_of<Dim>(1, 0.4, 0.5), box_of<Dim>(0.5, 0.4, 0.4), name == "big" ? 0.01 : 0.025, 0.1}, unit = 0.1;
    if (name == "2d") c = {box_of<Dim>(4, 0, 2), box_of<Dim>(2, 0, 1), 0.008, 0.1}, unit = 1;
    if (spacing == 0) return c;
    spate::require_positive("spacing", spacing, "m");
    const double n = std::max(1.0, std::round(unit / spacing));
    spate::require(std::abs(unit / spacing - n) < 1e-6 * n, "spacing", spacing,
                   spate::text(unit) + " m over a whole number, so that it divides the boxes; the nearest is " +
                       spate::text(unit / n) + " m");
    c.spacing = unit / n;
    const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE)); // [B]
    spate::require(500 * markers(c) <= memory, "spacing", spacing, // bytes of a marker, lists included
                   "one whose " + spate::text(markers(c)) + " particles fit in " + spate::text(memory / 1e9) +
                       " GB of memory");
    return c;
}
