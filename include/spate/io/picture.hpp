// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A picture of the particles as a PNG file: discs and spheres to scale, axes, colour bar; needs no display.
///        Not a viewer: for more than a glance open the snapshots in ParaView.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "spate/io/ball.hpp"
#include "spate/io/detail/axes.hpp"
#include "spate/io/detail/canvas.hpp"
#include "spate/io/detail/colour_bar.hpp"
#include "spate/io/detail/layout.hpp"
#include "spate/io/detail/png.hpp"
#include "spate/io/detail/replace_file.hpp"
#include "spate/io/detail/splats.hpp"
#include "spate/io/detail/view.hpp"
#include "spate/io/output_error.hpp"

namespace spate::io {

namespace detail {

inline Eigen::Vector3d place(Ball const& ball, bool flat) { return {ball.x[0], ball.x[1], flat ? 0.0 : ball.x[2]}; }

inline bool drawable(Ball const& ball, bool flat)
{
    return place(ball, flat).allFinite() && std::isfinite(ball.radius) && ball.radius >= 0;
}

/// What of the balls is to be drawn; NaN in lower and upper limits nothing.
inline std::vector<Ball> visible(Picture const& picture, std::vector<Ball> const& balls)
{
    std::vector<Ball> out;
    for (Ball const& ball : balls) {
        bool inside = drawable(ball, picture.dim == 2) && !(ball.ghosted && picture.ghosts == Ghosts::left_out);
        for (std::size_t k = 0; k < static_cast<std::size_t>(picture.dim); ++k)
            inside = inside && !(ball.x[k] < picture.lower[k]) && !(ball.x[k] > picture.upper[k]);
        if (inside) out.push_back(ball);
    }
    return out;
}

/// Never empty in a direction that is drawn.
inline Box bounds(Picture const& picture, std::vector<Ball> const& balls)
{
    const bool flat = picture.dim == 2;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Box box{Eigen::Vector3d::Constant(infinity), Eigen::Vector3d::Constant(-infinity)};
    for (Ball const& ball : balls) {
        box.low = box.low.cwiseMin((place(ball, flat).array() - ball.radius).matrix());
        box.high = box.high.cwiseMax((place(ball, flat).array() + ball.radius).matrix());
    }
    if (balls.empty()) box = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()};
    for (int k = 0; k < 3; ++k) {
        const auto slot = static_cast<std::size_t>(k);
        if (std::isfinite(picture.lower[slot])) box.low[k] = picture.lower[slot];
        if (std::isfinite(picture.upper[slot])) box.high[k] = picture.upper[slot];
    }
    if (flat) box.low.z() = box.high.z() = 0;
    const double size = (box.high - box.low).maxCoeff();
    for (int k = 0; k < picture.dim; ++k) {
        const double missing = 1e-3 * (size > 0 ? size : 1) - (box.high[k] - box.low[k]);
        if (missing <= 0) continue;
        box.low[k] -= missing / 2;
        box.high[k] += missing / 2;
    }
    return box;
}

/// Both ends of the colours, apart from each other.
inline std::array<double, 2> value_range(Picture const& picture, std::vector<Ball> const& balls)
{
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (Ball const& ball : balls) {
        if (ball.ghosted || !std::isfinite(ball.value)) continue;
        low = std::min<double>(low, ball.value);
        high = std::max<double>(high, ball.value);
    }
    if (low > high) low = high = 0;
    if (std::isfinite(picture.value_min)) low = picture.value_min;
    if (std::isfinite(picture.value_max)) high = picture.value_max;
    const double largest = std::max(std::abs(low), std::abs(high));
    if (high - low > 1e-5 * largest) return {low, high}; // float resolves no finer
    if (largest == 0) return {0, 1};
    return {low - 5e-4 * largest, low + 5e-4 * largest};
}

inline void check_picture(Picture const& picture)
{
    if (picture.dim != 2 && picture.dim != 3)
        throw std::invalid_argument("spate: a picture has 2 or 3 dimensions, not " + std::to_string(picture.dim));
    constexpr int smallest = 240;
    constexpr int largest = 16384;
    if (std::min(picture.width, picture.height) < smallest || std::max(picture.width, picture.height) > largest)
        throw std::invalid_argument("spate: a picture of " + std::to_string(picture.width) + " x " +
                                    std::to_string(picture.height) + " pixels is out of range; use " +
                                    std::to_string(smallest) + " to " + std::to_string(largest));
}

inline constexpr Rgb not_a_number{220, 30, 30};

/// Written below the picture, so that nothing is missing from it in silence.
inline std::string warning(std::vector<Ball> const& balls, bool flat)
{
    const auto lost = std::count_if(balls.begin(), balls.end(), [&](Ball const& b) { return !drawable(b, flat); });
    const auto red =
        std::count_if(balls.begin(), balls.end(), [&](Ball const& b) { return !b.ghosted && std::isnan(b.value); });
    std::string text;
    if (red > 0) text += std::to_string(red) + " red: not a number";
    if (lost > 0) text += (text.empty() ? "" : "; ") + std::to_string(lost) + " not drawn: place or radius not finite";
    return text;
}

inline void draw_balls(Canvas& canvas, Picture const& picture, std::vector<Ball> const& balls, View const& view,
                       ColourBar const& bar)
{
    constexpr Rgb wall{205, 205, 205};
    const bool flat = picture.dim == 2;
    SplatLayer solid(canvas.width(), canvas.height());
    SplatLayer glass(canvas.width(), canvas.height());
    Light light{flat, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (Ball const& ball : balls) {
        const Eigen::Vector3d at = view(place(ball, flat));
        const double smallest = 0.6; // a ball far smaller than a pixel is still seen  [pixels]
        const double fraction = (ball.value - bar.low) / (bar.high - bar.low);
        const Rgb colour = ball.ghosted ? wall : std::isnan(fraction) ? not_a_number : viridis(fraction);
        const bool through = ball.ghosted && !flat && picture.ghosts == Ghosts::translucent;
        (through ? glass : solid).add({at, std::max(smallest, view.scale * ball.radius), colour});
        light.far = std::min(light.far, at.z());
        light.near = std::max(light.near, at.z());
    }
    paint(canvas, solid, glass, light, 0.3);
}

inline Canvas draw(Picture const& picture, std::vector<Ball> const& all)
{
    const std::vector<Ball> balls = visible(picture, all);
    const bool flat = picture.dim == 2;
    const int font = std::max(1, (std::min(picture.width, picture.height) + 400) / 500); // 2 at 600 to 1099 pixels
    Canvas canvas(picture.width, picture.height, {255, 255, 255});
    const Box box = bounds(picture, balls);
    const auto [low, high] = value_range(picture, balls);
    const Eigen::Matrix3d turn = flat ? Eigen::Matrix3d::Identity().eval() : turn_toward(picture.seen_from);
    const Margins around(box, picture.axes, flat, font);
    const Layout layout =
        lay_out(canvas, box, turn, around, {low, high, picture.value_name, picture.unit, font, false});
    const Axes axes(box, layout.view, picture.axes, font);
    axes.draw_back(canvas);
    draw_balls(canvas, picture, balls, layout.view, layout.bar);
    axes.draw_front(canvas);
    if (!picture.value_name.empty()) layout.bar.draw(canvas);
    const int large = text_width(picture.title, font + 1) < picture.width ? font + 1 : font;
    canvas.text({picture.width / 2.0, layout.title_base}, {0.5, 1}, picture.title, large, ink);
    canvas.text({picture.width / 2.0, picture.height - 3.0 * font}, {0.5, 1}, warning(all, flat), font, not_a_number);
    return canvas;
}

} // namespace detail

/// Throws OutputError, and the file is then what it was before. The same balls give the same bytes.
inline void write_png(std::filesystem::path const& file, Picture const& picture, std::vector<Ball> const& balls)
{
    detail::check_picture(picture);
    detail::replace_file(file, detail::png_bytes(file, detail::draw(picture, balls)));
}

} // namespace spate::io
