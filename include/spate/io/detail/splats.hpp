// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Spheres on a canvas: the nearest one at each of 2 x 2 samples of a pixel, lit from the upper left.
///        Knows pixels only; what a sphere stands for is the caller's.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "spate/io/detail/canvas.hpp"

namespace spate::io::detail {

struct Splat {
    Eigen::Vector3d at; ///< right, down, toward the viewer  [pixels]
    double radius;      ///< [pixels]
    Rgb colour;
};

/// The foremost splat at each sample.
class SplatLayer {
public:
    static constexpr int samples = 2; ///< a pixel and direction

    SplatLayer(int width, int height)
        : width_(samples * width), height_(samples * height),
          front_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_))
    {}

    void add(Splat const& splat)
    {
        const auto index = static_cast<std::uint32_t>(splats_.size());
        splats_.push_back(splat);
        const Eigen::Vector3d c = samples * splat.at;
        const double r = samples * splat.radius;
        const int bottom = last(c.y() + r, height_);
        const int right = last(c.x() + r, width_);
        for (int y = first(c.y() - r); y < bottom; ++y)
            for (int x = first(c.x() - r); x < right; ++x) {
                const double dx = x + 0.5 - c.x();
                const double dy = y + 0.5 - c.y();
                const double height2 = r * r - dx * dx - dy * dy;
                if (height2 < 0) continue;
                const auto depth = static_cast<float>(c.z() + std::sqrt(height2));
                Sample& sample = front_[place(x, y)];
                if (depth > sample.depth) sample = {depth, index};
            }
    }

    float depth(int x, int y) const { return front_[place(x, y)].depth; }
    bool empty(int x, int y) const { return front_[place(x, y)].splat == nobody; }
    Splat const& splat(int x, int y) const { return splats_[front_[place(x, y)].splat]; }

private:
    static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
    struct Sample {
        float depth = -std::numeric_limits<float>::infinity();
        std::uint32_t splat = nobody;
    };

    static int first(double place) { return static_cast<int>(std::clamp(std::floor(place), 0.0, 1e6)); }
    static int last(double place, int size)
    {
        return static_cast<int>(std::clamp(std::ceil(place), 0.0, static_cast<double>(size)));
    }
    std::size_t place(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    int width_;
    int height_;
    std::vector<Sample> front_;
    std::vector<Splat> splats_;
};

struct Light {
    bool flat;        ///< discs with a thin rim instead of shaded spheres
    double far, near; ///< depths between which colours darken to the back  [pixels]

    /// x, y: the sample, in samples.
    Rgb operator()(SplatLayer const& layer, int x, int y) const
    {
        constexpr Rgb black{0, 0, 0};
        Splat const& splat = layer.splat(x, y);
        const Point off = Point(x + 0.5, y + 0.5) / SplatLayer::samples - splat.at.head<2>();
        const double rim = splat.radius - std::min(0.13 * splat.radius, 2.5);
        if (flat) return mix(splat.colour, black, splat.radius > 3 && off.norm() > rim ? 0.25 : 0.0);
        const double s2 = std::min(1.0, off.squaredNorm() / (splat.radius * splat.radius));
        const Eigen::Vector3d normal(off.x() / splat.radius, -off.y() / splat.radius, std::sqrt(1 - s2));
        const double lambert = std::max(0.0, normal.dot(Eigen::Vector3d(-0.35, 0.5, 0.79)));
        const double back = std::clamp((near - splat.at.z()) / std::max(near - far, 1e-9), 0.0, 1.0);
        return mix(black, splat.colour, std::min(1.0, 0.4 + 0.62 * lambert) * (1 - 0.25 * back));
    }
};

/// `glass` lies over `solid` where it is nearer; `opacity` is that of the glass.
inline void paint(Canvas& canvas, SplatLayer const& solid, SplatLayer const& glass, Light const& light, double opacity)
{
    constexpr int n = SplatLayer::samples;
    for (int y = 0; y < canvas.height(); ++y)
        for (int x = 0; x < canvas.width(); ++x) {
            Eigen::Vector3d sum = Eigen::Vector3d::Zero();
            for (int v = n * y; v < n * (y + 1); ++v)
                for (int u = n * x; u < n * (x + 1); ++u) {
                    Rgb colour = solid.empty(u, v) ? canvas.at(x, y) : light(solid, u, v);
                    if (glass.depth(u, v) > solid.depth(u, v)) colour = mix(colour, light(glass, u, v), opacity);
                    sum += Eigen::Vector3d(colour.r, colour.g, colour.b);
                }
            const auto mean = [&](int k) { return static_cast<std::uint8_t>(std::lround(sum[k] / (n * n))); };
            canvas.at(x, y) = {mean(0), mean(1), mean(2)};
        }
}

} // namespace spate::io::detail
