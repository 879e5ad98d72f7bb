// SPDX-License-Identifier: BSD-3-Clause
#include "dam_break/column.hpp"

#include <algorithm>

#include <unistd.h>

#include <spate/core/errors.hpp>

namespace {

/// x along, y across, z up in 3D; x and z in 2D.
template <int Dim>
spate::Box<Dim> box_of(double x, double y, double z)
{
    if constexpr (Dim == 3) return {{0, 0, 0}, {x, y, z}};
    else return {{0, 0}, {x, z}};
}

/// Water and three layers of wall around the tank, about.
template <int Dim>
double markers(Column<Dim> const& c)
{
    double water = 1, tank = 1, all = 1;
    for (int k = 0; k < Dim; ++k) {
        water *= c.water.size()[k] / c.spacing;
        tank *= c.tank.size()[k] / c.spacing;
        all *= c.tank.size()[k] / c.spacing + 6;
    }
    return water + all - tank;
}

/// The seed's 139,332 markers: x = 3.2, y = 2.4 (up) and z = 0.2 m with three layers on all six walls, as its code lays
/// them: water to half of the length and of the height.
template <int Dim>
Column<Dim> seed()
{
    // c0 = 25 m/s is ten times 2.5 m/s.
    return {.tank = box_of<Dim>(3.08, 0.08, 2.28),
            .water = box_of<Dim>(1.54, 0.08, 1.14),
            .spacing = 0.02,
            .alpha = 0.1,
            .mu = 1,
            .g = 1,
            .fastest = 2.5,
            .smoothing = 1,
            .open = spate::nowhere};
}
/// SPHERIC test 2 (Kleefsman et al. 2005): water on the right runs against a box. Both are of whole spacings: the length of
/// the water is rounded up, its depth down. The crest of the jet up the left wall, at 0.84 s, would go over the wall by a
/// millimetre or two: a lid keeps it in.
void spheric2(Column<3>& c)
{
    const double dx = c.spacing, x = 3.22 - dx * std::ceil(1.228 / dx - 1e-6), z = dx * std::floor(0.55 / dx + 1e-6);
    c.water = {{x, 0, 0}, {3.22, 1, z}};
    c.open = spate::nowhere;
    c.box = {{0.6635, 0.2955, 0}, {0.8245, 0.6985, 0.161}};
}

/// Where the experiments measured, and the foot of the tank.
template <int Dim>
void measure(std::string const& name, Column<Dim>& c)
{
    const double L = c.tank.hi[0];
    auto at = [&](double x, double z) { // along and up, in the middle across
        spate::Vec<Dim, double> p = 0.5 * c.tank.hi;
        p[0] = x, p[Dim - 1] = z;
        return p;
    };
    auto sensor = [&](char const* label, spate::Vec<Dim, double> const& x) {
        c.sensors.push_back({label, spate::pressure, x});
    };
    auto gauge = [&](char const* label, double x) { c.gauges.push_back({label, at(x, 0), c.spacing}); };
    if (name == "lobovsky") { // Lobovsky et al. 2014
        sensor("p_s1", at(L, 0.003)), sensor("p_s2", at(L, 0.015));
        sensor("p_s3", at(L, 0.03)), sensor("p_s4", at(L, 0.08));
        gauge("h1", 0.3), gauge("h2", 0.865), gauge("h3", 1.114), gauge("h4", 1.3625);
    }
    else if (name == "obstacle") { // Kleefsman et al. 2005; in the middle of the box across
        const char* names[] = {"p1", "p2", "p3", "p4", "p5", "p6", "p7", "p8"};
        for (int k = 0; k < 8; ++k) {
            const double s = 0.021 + 0.04 * (k % 4); // from the edge: up on its face, then along its top
            sensor(names[k], k < 4 ? at(0.8245, s) : at(0.8245 - s, 0.161));
        }
        gauge("h_x0496", 0.496), gauge("h_x0992", 0.992), gauge("h_x1488", 1.488), gauge("h_x2638", 2.638);
    }
    else sensor("p_bed", at(0, 0)), sensor("p_wall", at(L, 0)), gauge("depth_left", 0);
}

} // namespace

template <int Dim>
Column<Dim> column(std::string const& name, double spacing)
{
    constexpr double H = 0.6; // [m]
    double unit = H / 4;      // every edge of both boxes is a multiple of it [m]
    Column<Dim> c{box_of<Dim>(4 * H, H / 4, 2 * H), box_of<Dim>(H / 2, H / 4, H), Dim == 3 ? H / 32 : H / 80, 0.02};
    if (name != "default" && name != "lobovsky" && (name == "2d") != (Dim == 2))
        throw spate::BadInput("case", name,
                              Dim == 2 ? "default, lobovsky or 2d with --dim 2"
                                       : "default, big, small, seed, lobovsky or obstacle with --dim 3");
    if (name == "big" || name == "small")
        c = {box_of<Dim>(1, 0.4, 0.5), box_of<Dim>(0.5, 0.4, 0.4), name == "big" ? 0.01 : 0.025, 0.1}, unit = 0.1;
    if (name == "2d") c = {box_of<Dim>(4, 0, 2), box_of<Dim>(2, 0, 1), 0.008, 0.1}, unit = 1;
    if (name == "seed") c = seed<Dim>(), unit = 0.02;
    if (name == "lobovsky")
        c = {box_of<Dim>(1.61, 0.15, 0.6), box_of<Dim>(0.6, 0.15, 0.3), Dim == 3 ? 0.01 : 0.0025, 0.02}, unit = 0.01;
    if (name == "obstacle") c = {box_of<Dim>(3.22, 1, 1), box_of<Dim>(1.22, 1, 0.54), 0.02, 0.02}, unit = 0.02;
    if (spacing != 0) {
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
    }
    if constexpr (Dim == 3)
        if (name == "obstacle") spheric2(c), c.fastest = std::sqrt(2 * c.g * c.water.hi[2]);
    measure(name, c);
    return c;
}
template Column<2> column<2>(std::string const&, double);
template Column<3> column<3>(std::string const&, double);
