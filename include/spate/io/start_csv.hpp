// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A start from a table: one particle a line, x, y[, z], vx, vy[, vz], in metres and metres a second.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "spate/io/detail/lines.hpp"
#include "spate/io/start.hpp"

namespace spate::io {

namespace detail {

/// x, y[, z], vx, vy[, vz], then those that a heading may add.
template <int Dim>
struct StartColumns {
    static constexpr std::size_t needed = 2 * std::size_t(Dim);
    static std::vector<std::string> names()
    {
        std::vector<std::string> all;
        for (int c = 0; c < Dim; ++c) all.push_back(std::string(1, "xyz"[c]));
        for (int c = 0; c < Dim; ++c) all.push_back(std::string("v") + "xyz"[c]);
        all.push_back("radius"), all.push_back("mass");
        return all;
    }
    static std::string list()
    {
        const auto all = names();
        std::string text = all[0];
        for (std::size_t k = 1; k < needed; ++k) text += ", " + all[k];
        return text;
    }
    /// Which of the names each cell of the first line is; without a heading, the needed ones in their order.
    static std::vector<std::size_t> of(Lines const& lines, bool& heading)
    {
        const auto all = names();
        const auto cells = lines.cells();
        double number = 0;
        heading = !reads_as(cells[0], number) && std::find(all.begin(), all.end(), cells[0]) != all.end();
        std::vector<std::size_t> columns;
        if (!heading) {
            for (std::size_t k = 0; k < needed; ++k) columns.push_back(k);
            return columns;
        }
        for (auto cell : cells) {
            const auto k = std::size_t(std::find(all.begin(), all.end(), cell) - all.begin());
            if (k == all.size())
                lines.refuse("the heading", Lines::quoted(cell), list() + ", and if wanted radius, mass");
            if (std::find(columns.begin(), columns.end(), k) != columns.end())
                lines.refuse("the heading", Lines::quoted(cell) + " twice", "each name once");
            columns.push_back(k);
        }
        for (std::size_t k = 0; k < needed; ++k)
            if (std::find(columns.begin(), columns.end(), k) == columns.end())
                lines.refuse("the heading", "without " + all[k], "one with " + list());
        return columns;
    }
};

} // namespace detail

/// Numbers between commas. A first line of names may give another order, and radius [m] and mass [kg]; what follows a # is
/// a comment. Throws BadInput with the line that cannot be read.
template <int Dim>
[[gnu::cold]] Start<Dim> start_csv(std::filesystem::path const& file)
{
    using Columns = detail::StartColumns<Dim>;
    detail::Lines lines(file);
    if (!lines.next()) lines.refuse_file("empty", "one particle a line: " + Columns::list());
    bool more = true, heading = false;
    const auto names = Columns::names();
    const auto columns = Columns::of(lines, heading);
    if (heading) more = lines.next();
    if (!more) lines.refuse_file("without particles", "one particle a line: " + Columns::list());
    Start<Dim> start;
    const auto has = [&](std::size_t k) { return std::find(columns.begin(), columns.end(), k) != columns.end(); };
    for (; more; more = lines.next()) {
        const auto cells = lines.cells();
        if (cells.size() != columns.size())
            lines.refuse("the number of columns", std::to_string(cells.size()),
                         heading ? std::to_string(columns.size()) + ", as in the heading"
                                 : std::to_string(columns.size()) + ": " + Columns::list());
        std::array<double, Columns::needed + 2> value{};
        for (std::size_t k = 0; k < cells.size(); ++k) value[columns[k]] = lines.number(cells[k], names[columns[k]]);
        Vec<Dim, double> x, v;
        for (int c = 0; c < Dim; ++c) x[c] = value[std::size_t(c)], v[c] = value[std::size_t(Dim + c)];
        start.x.push_back(x), start.v.push_back(v);
        for (std::size_t k = 0; k < 2; ++k)
            if (has(Columns::needed + k)) {
                const double said = value[Columns::needed + k];
                if (!(said > 0)) lines.refuse(names[Columns::needed + k], text(said), "a number above 0");
                (k == 0 ? start.radius : start.mass).push_back(said);
            }
    }
    return start;
}

} // namespace spate::io
