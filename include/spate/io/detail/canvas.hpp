// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A sheet of pixels to draw boxes, lines and text on. Knows nothing of particles or axes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "spate/io/detail/colour_map.hpp"
#include "spate/io/detail/font.hpp"

namespace spate::io::detail {

using Point = Eigen::Vector2d; ///< x to the right, y down, (0, 0) is the upper left corner [pixels]

inline constexpr Rgb ink{40, 40, 40};

inline double text_width(std::string_view text, int scale)
{
    return std::max(0.0, scale * (static_cast<double>(glyphs(text).size()) * glyph_advance - 1));
}

class Canvas {
public:
    Canvas(int width, int height, Rgb paper)
        : width_(width), height_(height),
          pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), paper)
    {}

    int width() const { return width_; }
    int height() const { return height_; }
    std::vector<Rgb> const& pixels() const { return pixels_; }
    bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
    Rgb& at(int x, int y)
    {
        return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    }

    void fill(int left, int top, int right, int bottom, Rgb colour)
    {
        for (int y = std::max(top, 0); y < std::min(bottom, height_); ++y)
            for (int x = std::max(left, 0); x < std::min(right, width_); ++x) at(x, y) = colour;
    }

    /// Smooth at the edges; `thickness` in pixels.
    void line(Point a, Point b, double thickness, Rgb colour)
    {
        const Point low = a.cwiseMin(b).array() - thickness - 1;
        const Point high = a.cwiseMax(b).array() + thickness + 1;
        const Point along = b - a;
        const double length2 = std::max(along.squaredNorm(), 1e-12); // a point is a line, too
        for (int y = std::max(0, static_cast<int>(low.y())); y < std::min<double>(height_, high.y()); ++y)
            for (int x = std::max(0, static_cast<int>(low.x())); x < std::min<double>(width_, high.x()); ++x) {
                const Point p(x + 0.5, y + 0.5);
                const double f = std::clamp((p - a).dot(along) / length2, 0.0, 1.0);
                const double cover = thickness / 2 + 0.5 - (p - a - f * along).norm();
                if (cover > 0) at(x, y) = mix(at(x, y), colour, std::min(cover, 1.0));
            }
    }

    /// `anchor` is the part of the text that lies at `place`: (0, 0) its upper left corner, (0.5, 0.5) its middle.
    void text(Point place, Point anchor, std::string_view words, int scale, Rgb colour)
    {
        const Point corner = place - anchor.cwiseProduct(Point(text_width(words, scale), glyph_height * scale));
        write(words, corner, Point(scale, 0), Point(0, scale), scale, colour);
    }

    /// Read from below to above; the middle of the text lies at `place`.
    void upright_text(Point place, std::string_view words, int scale, Rgb colour)
    {
        const Point corner = place + Point(-glyph_height * scale, text_width(words, scale)) / 2 - Point(0, scale);
        write(words, corner, Point(0, -scale), Point(scale, 0), scale, colour);
    }

private:
    void write(std::string_view words, Point corner, Point right, Point down, int scale, Rgb colour)
    {
        const Point start(std::round(corner.x()), std::round(corner.y()));
        int column = 0;
        for (Glyph const& letter : glyphs(words)) {
            for (int c = 0; c < 5; ++c)
                for (int row = 0; row < 8; ++row)
                    if ((letter[static_cast<std::size_t>(c)] >> row) & 1)
                        dot(start + (column + c) * right + row * down, scale, colour);
            column += glyph_advance;
        }
    }

    void dot(Point place, int scale, Rgb colour)
    {
        const int x = static_cast<int>(place.x());
        const int y = static_cast<int>(place.y());
        fill(x, y, x + scale, y + scale, colour);
    }

    int width_;
    int height_;
    std::vector<Rgb> pixels_;
};

} // namespace spate::io::detail
