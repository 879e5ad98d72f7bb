// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Where title, box and colour bar go: as large as the sheet allows, in its middle. Draws nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include <Eigen/Core>

#include "spate/io/detail/axes.hpp"
#include "spate/io/detail/canvas.hpp"
#include "spate/io/detail/colour_bar.hpp"
#include "spate/io/detail/ticks.hpp"
#include "spate/io/detail/view.hpp"

namespace spate::io::detail {

struct Layout {
    View view;
    ColourBar bar;
    double title_base; ///< lower edge of the title  [pixels]
};

/// Extent of the box on the screen [m].
inline Point extent(Box const& box, Eigen::Matrix3d const& turn)
{
    const Eigen::Vector3d reach = turn.cwiseAbs() * (box.high - box.low);
    return reach.head<2>();
}

/// Space for numbers and names around the box [pixels].
struct Margins {
    double left, right, top, bottom;

    Margins(Box const& box, std::array<std::string, 3> const& names, bool flat, int font)
    {
        const double letter = glyph_advance * font;
        const double line = (glyph_height + 3) * font;
        std::size_t number = 0;
        std::size_t name = 0;
        for (int k = 0; k < (flat ? 2 : 3); ++k) {
            const Ticks marks = ticks(box.low[k], box.high[k], 8);
            number = std::max(number, longest_label(marks));
            name = std::max(name, with_unit(names[static_cast<std::size_t>(k)], "m", marks.exponent).size());
        }
        left = static_cast<double>(number + name + 4) * letter;
        right = static_cast<double>(number + 2) * letter;
        top = 3.5 * line;
        bottom = 3.5 * line;
    }
};

/// One of the two places of the bar.
inline Layout lay_out(Canvas const& sheet, Box const& box, Eigen::Matrix3d const& turn, Margins around, ColourBar bar,
                      bool with_bar)
{
    const double line = bar.line();
    const Point shape = extent(box, turn);
    if (with_bar && bar.lying) around.bottom += line + bar.breadth();
    if (with_bar && !bar.lying) around.right += bar.breadth();
    const Point room(sheet.width() - around.left - around.right, sheet.height() - around.top - around.bottom - line);
    const double scale = std::max(1e-9, std::min(room.x() / shape.x(), room.y() / shape.y()));
    const Point size = scale * shape;
    const Point corner(around.left + (room.x() - size.x()) / 2, around.top + (room.y() - size.y()) / 2);
    bar.length = bar.lying ? std::max(0.6 * size.x(), std::min(room.x(), 40 * bar.letter()))
                           : std::max(size.y(), std::min(room.y(), 12 * line));
    if (bar.lying)
        bar.corner = {corner.x() + (size.x() - bar.length) / 2, corner.y() + size.y() + around.bottom - bar.breadth()};
    else bar.corner = {corner.x() + size.x() + around.right - bar.breadth(), corner.y() + (size.y() - bar.length) / 2};
    return {{turn, box.centre(), scale, corner + size / 2},
            bar,
            std::min(corner.y(), bar.lying ? corner.y() : bar.corner.y()) - 1.5 * line};
}

/// The place of the bar that leaves the box larger; beside it when there is little between them.
inline Layout lay_out(Canvas const& sheet, Box const& box, Eigen::Matrix3d const& turn, Margins const& around,
                      ColourBar bar)
{
    const bool with_bar = !bar.name.empty();
    bar.lying = false;
    const Layout beside = lay_out(sheet, box, turn, around, bar, with_bar);
    bar.lying = true;
    const Layout below = lay_out(sheet, box, turn, around, bar, with_bar);
    return below.view.scale > 1.05 * beside.view.scale ? below : beside;
}

} // namespace spate::io::detail
