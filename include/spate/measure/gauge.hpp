// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The height of a free surface over a point.
#pragma once

#include "spate/core/field.hpp"
#include "spate/core/ranks.hpp"
#include "spate/measure/nearest_image.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace spate {

/// How far the highest particle within a smoothing length of the upright line through `foot` is above it, and half a
/// spacing: over a full box, the depth. The last axis is up. 0 where nothing stands there; spray counts as surface.
template <int Dim>
struct Gauge {
    std::string name;
    Vec<Dim, double> foot; ///< [m]
    double spacing;        ///< of the particles [m]

    [[gnu::cold]] double operator()(auto const& scene) const // [m]
    {
        auto const& p = scene.particles();
        const double h = scene.physics().interaction.length();
        double height = 0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            auto x = nearest_image(p.at(position, i) - foot, scene.system().grid());
            const double above = x[Dim - 1] + spacing / 2;
            x[Dim - 1] = 0;
            if (x.squaredNorm() <= h * h) height = std::max(height, above);
        }
        return party_of(scene).all(height, agree::Most{});
    }
};
/// The length along which an upright wire through `foot` is wet, as a resistance gauge reads it: the volume of water over a
/// square of edge 2 `half` about the foot, over its area. The last axis is up; a particle is a cube of its spacing. Spray
/// counts by its volume, where to a Gauge it is surface.
template <int Dim>
struct WettedLength {
    std::string name;
    Vec<Dim, double> foot; ///< [m]
    double half;           ///< of the edge of the square [m]
    double spacing;        ///< of the particles [m]

    [[gnu::cold]] double operator()(auto const& scene) const // [m]
    {
        auto const& p = scene.particles();
        const double edge = 2 * half, volume = std::pow(spacing, Dim) / std::pow(edge, Dim - 1);
        return scene.system().sum([&](std::size_t i) {
            const auto x = nearest_image(p.at(position, i) - foot, scene.system().grid());
            double inside = x[Dim - 1] > 0 ? volume : 0;
            for (int c = 0; c < Dim - 1; ++c) {
                const double in = std::min(x[c] + spacing / 2, half) - std::max(x[c] - spacing / 2, -half);
                inside *= std::max(in, 0.0) / spacing;
            }
            return inside;
        });
    }
};
template <int Dim>
WettedLength(std::string, Vec<Dim, double>, double, double) -> WettedLength<Dim>;
template <int Dim>
WettedLength(char const*, Vec<Dim, double>, double, double) -> WettedLength<Dim>;
template <int Dim>
Gauge(std::string, Vec<Dim, double>, double) -> Gauge<Dim>;
template <int Dim>
Gauge(char const*, Vec<Dim, double>, double) -> Gauge<Dim>;

} // namespace spate
