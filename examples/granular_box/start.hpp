// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Where the grains of the box are at the start: scattered over a lattice, or read from a file.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <spate/core/box.hpp>
#include <spate/io/start.hpp>

#include "granular_box/dice.hpp"

namespace granular {

using spate::io::Start;

/// A square in which n discs of a radius [m] cover a fraction of the area.
inline spate::Box<2> square(std::size_t n, double radius, double fraction)
{
    spate::require(fraction > 0 && std::isfinite(fraction), "fraction", fraction, "above 0, and what can be packed");
    const double L = std::sqrt(double(n) * std::numbers::pi * radius * radius / fraction);
    return {{0, 0}, {L, L}};
}

/// n discs of a radius [m] and a speed [m/s] in directions at random: on a square lattice below a fraction of 0.6, above it on
/// sites of a triangular one that are chosen at random; jittered by what leaves them apart. With 262,144 discs and seed 12345
/// this is the start on which other codes have been timed.
inline Start<2> scattered(std::size_t n, double radius, double fraction, double speed, std::uint64_t seed)
{
    spate::require(n >= 1 && n <= 1u << 30, "particles", double(n), "1 to 1073741824");
    Start<2> s;
    s.box = square(n, radius, fraction);
    const double L = s.box->hi[0];
    Dice dice(seed);
    s.x.reserve(n), s.v.reserve(n);
    double free = 0; // between two neighbours [m]
    if (fraction < 0.6) {
        const auto edge = std::size_t(std::ceil(std::sqrt(double(n))));
        const double a = L / double(edge);
        free = 0.45 * (a - 2 * radius);
        for (std::size_t k = 0; k < n; ++k) s.x.push_back({(double(k / edge) + 0.5) * a, (double(k % edge) + 0.5) * a});
    }
    else {
        std::size_t rows = 0, columns = 0; // as far apart as can be
        double apart = 0, dx = 0, dy = 0;
        const double edge = std::sqrt(double(n));
        for (auto ny = std::size_t(std::max(1.0, 400 / 512.0 * edge)), end = std::size_t(700 / 512.0 * edge) + 2;
             ny < end; ++ny) {
            const std::size_t nx = (n + ny - 1) / ny;
            const double x = L / (double(nx) + 0.5), y = L / (double(ny) + 0.1), d = std::min(x, std::hypot(x / 2, y));
            if (d > apart) apart = d, columns = nx, rows = ny, dx = x, dy = y;
        }
        free = 0.2 * (apart - 2 * radius);
        auto site = dice.permutation(std::uint32_t(rows * columns));
        site.resize(n);
        std::sort(site.begin(), site.end());
        for (const auto k : site) {
            const std::size_t i = k / rows, j = k % rows;
            s.x.push_back({(double(i) + 0.5 + 0.5 * double(j % 2)) * dx, (double(j) + 0.55) * dy});
        }
    }
    spate::require(
        free > 0, "fraction", fraction,
        "what can be packed without overlaps: below 0.78 on the square lattice that is used up to 0.6, and below "
        "0.9 on the triangular one, less in a small box");
    for (int c = 0; c < 2; ++c)
        for (auto& x : s.x) x[c] += free * dice.uniform(-1, 1) * 0.7;
    for (std::size_t k = 0; k < n; ++k) {
        const double angle = dice.uniform(0, 2 * std::numbers::pi);
        s.v.push_back({speed * std::cos(angle), speed * std::sin(angle)});
    }
    return s;
}

/// n grains on a square or cubic lattice that fills a box of a width from the floor up, jittered; at rest but for a little
/// speed [m/s].
template <int Dim>
Start<Dim> stacked(std::size_t n, spate::Box<Dim> const& stack, double radius, double speed, std::uint64_t seed)
{
    spate::require(n >= 1 && n <= 1u << 30, "particles", double(n), "1 to 1073741824");
    Start<Dim> s;
    Dice dice(seed);
    std::size_t along[std::size_t(Dim)];
    double a = 0; // spacing [m]
    for (int c = 0; c + 1 < Dim; ++c) {
        along[c] = std::size_t(std::max(1.0, std::floor(stack.size()[c] / (2.15 * radius))));
        a = stack.size()[c] / double(along[c]);
    }
    for (std::size_t k = 0; k < n; ++k) {
        spate::Vec<Dim, double> x, v;
        std::size_t rest = k;
        for (int c = 0; c < Dim; ++c) {
            const std::size_t i = c + 1 < Dim ? rest % along[c] : rest;
            if (c + 1 < Dim) rest /= along[c];
            x[c] = stack.lo[c] + (double(i) + 0.5) * a + 0.45 * (a - 2 * radius) * dice.uniform(-1, 1);
            v[c] = speed * dice.uniform(-1, 1);
        }
        s.x.push_back(x), s.v.push_back(v);
    }
    return s;
}

} // namespace granular
