// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Pairs of cells that may hold a pair of particles: a cell with itself and with each of those around it. The pairs
/// of one target cell are one task; a cell whose neighbour is on another rank waits for that rank.
#pragma once

#include "spate/cells/binning.hpp"

#include <algorithm>

namespace spate {

/// f(cell) once for each cell, but this one, that a list of a target in this one may reach; wrapped into the period.
template <int Dim>
void each_cell_around(Index<Dim> const& cell, Grid<Dim> const& grid, auto const& f)
{
    std::array<std::array<std::int32_t, 3>, std::size_t(Dim)> at; // the cells along each axis
    std::array<std::size_t, std::size_t(Dim)> count;
    std::size_t all = 1;
    for (int c = 0; c < Dim; ++c) {
        const auto k = std::size_t(c);
        const std::int32_t M = grid.cell(), n = grid.bins(c) / grid.per_range(c), first = cell[k] * M;
        const std::int32_t last = n > 0 ? std::min(first + M, n) - 1 : first + M - 1;
        auto* next = at[k].begin();
        for (std::int32_t patch : {first - 1, first, last + 1}) {
            if (n > 0) patch = (patch % n + n) % n;
            *next++ = grid.cell_of(c, patch * grid.per_range(c));
        }
        std::sort(at[k].begin(), at[k].end());
        count[k] = std::size_t(std::unique(at[k].begin(), at[k].end()) - at[k].begin());
        all *= count[k];
    }
    for (std::size_t q = 0; q < all; ++q) {
        Index<Dim> other;
        std::size_t rest = q;
        for (std::size_t c = 0; c < std::size_t(Dim); rest /= count[c], ++c) other[c] = at[c][rest % count[c]];
        if (other != cell) f(other);
    }
}

/// Unordered pairs of occupied cells, each with itself among them: the work units of a species with itself.
template <int Dim>
[[nodiscard]] std::int64_t cell_pairs(Binning<Dim> const& bins, Grid<Dim> const& grid)
{
    std::int64_t directed = 0;
    for (std::size_t k = 0; k < bins.cells(); ++k)
        each_cell_around(bins.cell(k), grid, [&](Index<Dim> const& cell) { directed += bins.find(cell) >= 0; });
    return std::int64_t(bins.cells()) + directed / 2;
}

} // namespace spate
