// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The box around the particles with ticks, numbers and names along three of its outer edges (two in 2D).
///        Chooses the edges from the view; does not choose the view.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "spate/io/detail/canvas.hpp"
#include "spate/io/detail/ticks.hpp"
#include "spate/io/detail/view.hpp"

namespace spate::io::detail {

struct Box {
    Eigen::Vector3d low, high; ///< [m]

    Eigen::Vector3d centre() const { return 0.5 * (low + high); }
    Eigen::Vector3d corner(int k) const
    {
        return {(k & 1 ? high : low).x(), (k & 2 ? high : low).y(), (k & 4 ? high : low).z()};
    }
};

inline constexpr Rgb pale{190, 190, 190};

struct Edge {
    int axis;
    Eigen::Vector3d from, to; ///< along the axis, from its low end  [m]
    bool back;                ///< behind the particles
};

/// Nine of the twelve: the three that meet before the particles would cross them.
inline std::vector<Edge> edges(Box const& box, Eigen::Vector3d const& toward)
{
    const auto seen = [&](int axis, int corner) { return ((corner >> axis) & 1 ? 1 : -1) * toward[axis] > 1e-9; };
    std::vector<Edge> out;
    for (int axis = 0; axis < 3; ++axis)
        for (int corner = 0; corner < 8; ++corner) {
            if ((corner >> axis) & 1) continue;
            const int faces = seen((axis + 1) % 3, corner) + seen((axis + 2) % 3, corner);
            if (faces == 2) continue;
            out.push_back({axis, box.corner(corner), box.corner(corner | (1 << axis)), faces == 0});
        }
    return out;
}

class Axes {
public:
    Axes(Box const& box, View const& view, std::array<std::string, 3> names, int font)
        : box_(box), view_(view), names_(std::move(names)), font_(font), edges_(edges(box, view.toward()))
    {}

    void draw_back(Canvas& canvas) const
    {
        for (Edge const& edge : edges_)
            if (edge.back) canvas.line(view_.place(edge.from), view_.place(edge.to), 1, pale);
    }

    void draw_front(Canvas& canvas) const
    {
        for (Edge const& edge : edges_)
            if (!edge.back) canvas.line(view_.place(edge.from), view_.place(edge.to), 1, ink);
        std::vector<Words> written;
        for (int axis = 0; axis < 3; ++axis)
            if (const auto edge = labelled_edge(axis)) label(canvas, *edge, written);
    }

private:
    /// A text by its middle and half its size [pixels].
    struct Words {
        Point middle, half;

        bool overlaps(Words const& other) const
        {
            return ((middle - other.middle).cwiseAbs() - half - other.half).maxCoeff() < 0;
        }
    };

    /// Left out where it would cover what is written already: two axes that meet write their ends at one corner.
    void write(Canvas& canvas, Point middle, std::string const& text, std::vector<Words>& written) const
    {
        const Words words{middle, 0.5 * Point(text_width(text, font_) + 4 * font_, (glyph_height + 2) * font_)};
        for (Words const& other : written)
            if (words.overlaps(other)) return;
        canvas.text(middle, {0.5, 0.5}, text, font_, ink);
        written.push_back(words);
    }

    /// The lowest outer edge; of an upright axis the left one. None when the axis points at the viewer.
    std::optional<Edge> labelled_edge(int axis) const
    {
        std::optional<Edge> best;
        double best_place = 0;
        for (Edge const& edge : edges_) {
            if (edge.axis != axis || edge.back) continue;
            const Point a = view_.place(edge.from);
            const Point b = view_.place(edge.to);
            if ((b - a).norm() < 20.0 * font_) continue;
            const bool upright = std::abs((b - a).y()) > 2 * std::abs((b - a).x());
            const double place = upright ? -(a + b).x() : (a + b).y();
            if (best && place <= best_place) continue;
            best = edge;
            best_place = place;
        }
        return best;
    }

    void label(Canvas& canvas, Edge const& edge, std::vector<Words>& written) const
    {
        const Point a = view_.place(edge.from);
        const Point along = view_.place(edge.to) - a;
        Point out(along.y(), -along.x());
        out.normalize();
        if (out.dot(a + 0.5 * along - view_.place(box_.centre())) < 0) out = -out;
        const double low = box_.low[edge.axis];
        const double high = box_.high[edge.axis];
        const double letter = glyph_advance * font_;
        const double line = (glyph_height + 3) * font_;
        const Ticks marks = ticks_that_fit(low, high, along.norm(), [&](Ticks const& t) {
            const double wide = (static_cast<double>(longest_label(t)) + 2) * letter;
            return along.norm() / std::max(std::abs(along.x()) / wide, std::abs(along.y()) / (2 * line));
        });
        const double size = static_cast<double>(longest_label(marks)) * letter;
        const double reach = 6.0 * font_ + std::abs(out.x()) * size / 2 + std::abs(out.y()) * line / 2;
        for (std::size_t k = 0; k < marks.values.size(); ++k) {
            const Point tick = a + (marks.values[k] - low) / (high - low) * along;
            canvas.line(tick, tick + 4.0 * font_ * out, 1, ink);
            write(canvas, tick + reach * out, marks.labels[k], written);
        }
        const std::string name = with_unit(names_[static_cast<std::size_t>(edge.axis)], "m", marks.exponent);
        const double further =
            std::abs(out.x()) * (size / 2 + text_width(name, font_) / 2 + 2 * letter) + std::abs(out.y()) * 1.5 * line;
        write(canvas, a + 0.5 * along + (reach + further) * out, name, written);
    }

    Box box_;
    View view_;
    std::array<std::string, 3> names_;
    int font_;
    std::vector<Edge> edges_;
};

} // namespace spate::io::detail
