// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The scale of the colours, upright beside the particles or lying below them. Does not choose its place.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include "spate/io/detail/canvas.hpp"
#include "spate/io/detail/colour_map.hpp"
#include "spate/io/detail/ticks.hpp"

namespace spate::io::detail {

struct ColourBar {
    double low, high; ///< values at the ends
    std::string name, unit;
    int font;
    bool lying;
    Point corner = Point::Zero(); ///< upper left  [pixels]
    double length = 0;            ///< [pixels]

    double letter() const { return glyph_advance * font; }
    double line() const { return (glyph_height + 3) * font; }
    double thickness() const { return 2 * letter(); }

    /// Across its length, with numbers and name [pixels].
    double breadth() const
    {
        const auto letters = static_cast<double>(longest_label(ticks(low, high, 8)));
        return thickness() + (lying ? 3.5 * line() : (letters + 3) * letter() + line());
    }

    void draw(Canvas& canvas) const
    {
        const double step = 1 / length;
        for (double s = 0; s < 1; s += step) stripe(canvas, s, step, viridis(s));
        const Ticks marks = ticks_that_fit(low, high, length, [&](Ticks const& t) {
            return lying ? (static_cast<double>(longest_label(t)) + 2) * letter() : 2.5 * line();
        });
        const Point out = lying ? Point(0, 1) : Point(1, 0);
        for (std::size_t k = 0; k < marks.values.size(); ++k) {
            const Point tick = at((marks.values[k] - low) / (high - low)) + thickness() * out;
            canvas.line(tick, tick + 4.0 * font * out, 1, ink);
            canvas.text(tick + 7.0 * font * out, lying ? Point(0.5, 0) : Point(0, 0.5), marks.labels[k], font, ink);
        }
        const std::string title = with_unit(name, unit, marks.exponent);
        const double reach = thickness() + 7.0 * font;
        if (lying) return canvas.text(at(0.5) + Point(0, reach + 1.6 * line()), {0.5, 0}, title, font, ink);
        const double wide = static_cast<double>(longest_label(marks)) * letter();
        canvas.upright_text(at(0.5) + Point(reach + wide + 1.2 * line(), 0), title, font, ink);
    }

private:
    /// On the edge without numbers; 0 is the low end.
    Point at(double fraction) const
    {
        return corner + (lying ? Point(fraction * length, 0) : Point(0, (1 - fraction) * length));
    }

    void stripe(Canvas& canvas, double s, double step, Rgb colour) const
    {
        const Point a = at(lying ? s : s + step);
        const Point b = at(lying ? s + step : s) + (lying ? Point(0, thickness()) : Point(thickness(), 0));
        const auto pixel = [](double x) { return static_cast<int>(std::lround(x)); };
        canvas.fill(pixel(a.x()), pixel(a.y()), pixel(b.x()), pixel(b.y()), colour);
    }
};

} // namespace spate::io::detail
