// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Neighbour lists with a skin, one for each ordered pair of species (target <- source): for each block of W
/// targets the k-th neighbour of each, in the order (global bin, id); short lists end in the sentinel record.
#pragma once

#include "spate/cells/binning.hpp"

namespace spate {

/// How neighbour lists are kept; part of the scene, since bins fix the order of sums and with it the bits.
struct Neighbours {
    double skin = 0.1;     ///< reach of a list beyond the range, as a fraction of it [-]
    double bins = 0;       ///< bin edge over the range [-], 0: 1 + skin; at least 1 + skin
    double trigger = 0;    ///< lists are rebuilt when a particle may have moved this fraction of the range; 0: skin / 2
    int finer = 4;         ///< bins in a range along x [-]

    void check() const
    {
        require(skin > 0 && skin <= 2, "neighbours.skin", skin, "above 0 and at most 2");
        require(bins == 0 || (bins >= 1 + skin && bins <= 4), "neighbours.bins", bins, "0, or 1 + skin up to 4");
        require(trigger == 0 || (trigger > 0 && trigger <= skin / 2), "neighbours.trigger", trigger,
                "0, or above 0 and at most skin / 2");
        require(finer >= 1 && finer <= 16, "neighbours.finer", finer, "1 to 16");
    }
    [[nodiscard]] double bin_edge() const { return bins > 0 ? bins : 1 + skin; }
    [[nodiscard]] double moved() const { return trigger > 0 ? trigger : skin / 2; }
};

/// The lists of one target cell: entry (begin[b] + k) * W + lane is the k-th neighbour of target lane of block b.
struct CellLists {
    std::vector<std::int32_t> begin;
    Array<std::int32_t> index;
};

template <int Dim>
class Lists {
public:
    /// \param same   target and source are one species: a particle is not its own neighbour
    /// \param W      targets in a block
    /// \param reach  range and skin [m]; \param range [m], for counting pairs
    template <class P, class Q, class Backend>
    void build(P const& target, Binning<Dim> const& at, Q const& source, Binning<Dim> const& of, Grid<Dim> const& grid,
               bool same, int W, double reach, double range, Backend const& backend)
    {
        cell_.resize(at.cells());
        std::vector<std::int64_t> pairs(at.cells(), 0);
        backend.for_each(at.cells(), [&](std::size_t k) {
            pairs[k] = build_cell(cell_[k], k, target, at, source, of, grid, same, W, reach, range);
        });
        pairs_ = slots_ = 0;
        for (std::size_t k = 0; k < at.cells(); ++k) pairs_ += pairs[k], slots_ += std::int64_t(cell_[k].index.size());
    }
    [[nodiscard]] CellLists const& of_cell(std::size_t k) const { return cell_[k]; }
    /// Directed pairs within range when the lists were built.
    [[nodiscard]] std::int64_t pairs() const { return pairs_; }
    /// Entries of all lists, sentinels too.
    [[nodiscard]] std::int64_t slots() const { return slots_; }
    [[nodiscard]] std::size_t bytes() const
    {
        std::size_t b = cell_.capacity() * sizeof(CellLists);
        for (auto const& c : cell_) b += 4 * (c.begin.capacity() + c.index.capacity());
        return b;
    }

private:
    /// Candidates of a row of bins of one cell, copied together: positions as float from the row's corner.
    struct Candidates {
        Array<float> x[std::size_t(Dim)];
        std::vector<std::int32_t> number, first; // first: of row r, bin b at r * (bins + 1) + b
        std::size_t count = 0;
    };

    template <class P, class Q>
    static std::int64_t build_cell(CellLists& lists, std::size_t k, P const& target, Binning<Dim> const& at,
                                   Q const& source, Binning<Dim> const& of, Grid<Dim> const& grid, bool same, int W,
                                   double reach, double range)
    {
        static thread_local Candidates near;
        static thread_local std::vector<std::int32_t> row, list; // of W targets, of a cell
        static thread_local std::vector<std::size_t> length;
        // Float differences of positions within a row of a cell: the reach grows by the rounding of both ends.
        const double hair = reach * (1 + 2e-6) + 4e-7 * (grid.cell() + 2) * reach;
        const auto reach2 = float(hair * hair), range2 = float(range * range);
        const auto sentinel = std::int32_t(source.size());
        const int nx = grid.bins_of_cell(0), nx_near = nx + 2 * grid.finer();
        const Index<Dim> cell = at.cell(k);
        const int rows = grid.bins_of_cell() / nx;

        std::int64_t within = 0;
        list.clear();
        lists.begin.assign(1, 0);
        length.assign(std::size_t(W), 0);
        std::size_t stride = 0;
        int lane = 0;
        auto close_block = [&] {
            const std::size_t longest = *std::max_element(length.begin(), length.end());
            const std::size_t o = list.size();
            list.resize(o + longest * std::size_t(W));
            for (std::size_t t = 0; t < longest; ++t)
                for (std::size_t l = 0; l < std::size_t(W); ++l)
                    list[o + t * std::size_t(W) + l] = t < length[l] ? row[l * stride + t] : sentinel;
            lists.begin.push_back(std::int32_t(list.size() / std::size_t(W)));
            std::fill(length.begin(), length.end(), 0);
            lane = 0;
        };
        for (int r = 0; r < rows; ++r) {
            const std::int32_t b0 = at.first(k, r * nx), b1 = at.first(k, (r + 1) * nx);
            if (b0 == b1) continue;
            Index<Dim> corner; // first bin of the row
            corner[0] = cell[0] * nx;
            if constexpr (Dim > 1) corner[1] = cell[1] * grid.bins_of_cell(1) + r % grid.bins_of_cell(1);
            if constexpr (Dim > 2) corner[2] = cell[2] * grid.bins_of_cell(2) + r / grid.bins_of_cell(1);
            gather(near, corner, source, of, grid);
            const std::size_t need = near.count + 32;
            if (need > stride) {
                std::vector<std::int32_t> grown(need * std::size_t(W));
                for (std::size_t l = 0; l < std::size_t(W); ++l)
                    std::copy_n(row.begin() + std::ptrdiff_t(l * stride), length[l], grown.begin() + std::ptrdiff_t(l * need));
                row = std::move(grown);
                stride = need;
            }
            constexpr int near_rows = Dim == 1 ? 1 : Dim == 2 ? 3 : 9;
            for (int bx = 0; bx < nx; ++bx) {
                const std::int32_t i0 = at.first(k, r * nx + bx), i1 = at.first(k, r * nx + bx + 1);
                for (std::int32_t i = i0; i < i1; ++i) {
                    float xi[std::size_t(Dim)];
                    for (int c = 0; c < Dim; ++c)
                        xi[c] = float(double(target.column(position)[std::size_t(c)][std::size_t(i)]) -
                                      grid.corner(c, corner[std::size_t(c)]));
                    std::int32_t* out = row.data() + std::size_t(lane) * stride;
                    int m = 0;
                    for (int q = 0; q < near_rows; ++q) {
                        std::int32_t const* first = near.first.data() + q * (nx_near + 1);
                        std::int32_t j = first[bx];
                        const std::int32_t end = first[bx + 2 * grid.finer() + 1];
                        for (; j < end; j += 16) {
                            float const* x[std::size_t(Dim)];
                            for (int c = 0; c < Dim; ++c) x[c] = near.x[c].data() + j;
                            m += select_near<Dim>(x, near.number.data() + j, end - j, xi, reach2, range2, same ? i : -1,
                                                  out + m, within);
                        }
                    }
                    length[std::size_t(lane)] = std::size_t(m);
                    if (++lane == W) close_block();
                }
            }
        }
        if (lane > 0) close_block();
        lists.index.assign(list.begin(), list.end());
        return within;
    }

    /// Copies the candidates of one row of a cell: rows in the order of the global bins, images in their place.
    template <class Q>
    static void gather(Candidates& near, Index<Dim> const& corner, Q const& source, Binning<Dim> const& of,
                       Grid<Dim> const& grid)
    {
        const int reach_x = grid.finer(), nx = grid.bins_of_cell(0) + 2 * reach_x;
        constexpr int near_rows = Dim == 1 ? 1 : Dim == 2 ? 3 : 9;
        near.first.resize(std::size_t(near_rows * (nx + 1)));
        near.count = 0;
        for (int q = 0; q < near_rows; ++q) {
            Index<Dim> bin = corner;
            if constexpr (Dim > 1) bin[1] += q % 3 - 1;
            if constexpr (Dim > 2) bin[2] += q / 3 - 1;
            int code = 0;
            bool inside = true;
            for (int c = 1, three = 3; c < Dim; ++c, three *= 3) inside = wrap(bin, c, three, code, grid) && inside;
            std::int32_t* first = near.first.data() + q * (nx + 1);
            int b = 0;
            while (b < nx) { // a stretch within one cell and one period
                Index<Dim> at = bin;
                at[0] = corner[0] - reach_x + b;
                int full = code;
                const bool exists = wrap(at, 0, 1, full, grid) && inside;
                Index<Dim> cell;
                int local = 0;
                for (int c = Dim - 1; c >= 0; --c) {
                    cell[std::size_t(c)] = grid.cell_of(c, at[std::size_t(c)]);
                    local = local * grid.bins_of_cell(c) + at[std::size_t(c)] - cell[std::size_t(c)] * grid.bins_of_cell(c);
                }
                int stretch = std::min(nx - b, (cell[0] + 1) * grid.bins_of_cell(0) - at[0]);
                if (grid.periodic(0)) stretch = std::min(stretch, at[0] < grid.bins(0) ? grid.bins(0) - at[0] : stretch);
                const std::int32_t k = exists ? of.find(cell) : -1;
                if (k < 0) {
                    for (int s = 0; s < stretch; ++s) first[b + s] = std::int32_t(near.count);
                }
                else {
                    const std::int32_t j0 = of.first(std::size_t(k), local);
                    for (int s = 0; s < stretch; ++s)
                        first[b + s] = std::int32_t(near.count) + of.first(std::size_t(k), local + s) - j0;
                    copy(near, j0, of.first(std::size_t(k), local + stretch), full, corner, source, of, grid);
                }
                b += stretch;
            }
            first[nx] = std::int32_t(near.count);
        }
    }
    /// The bin inside the period, and the digit of the shift; false where a bin beyond the images is asked for.
    static bool wrap(Index<Dim>& bin, int c, int three, int& code, Grid<Dim> const& grid)
    {
        if (!grid.periodic(c)) return true;
        auto& b = bin[std::size_t(c)];
        const std::int32_t n = grid.bins(c), margin = grid.per_range(c);
        if (b < 0) {
            if (b < -margin) return false;
            b += n, code += 2 * three;
        }
        else if (b >= n) {
            if (b >= n + margin) return false;
            b -= n, code += three;
        }
        return true;
    }
    template <class Q>
    static void copy(Candidates& near, std::int32_t j0, std::int32_t j1, int code, Index<Dim> const& corner,
                     Q const& source, Binning<Dim> const& of, Grid<Dim> const& grid)
    {
        const std::size_t n = std::size_t(j1 - j0), o = near.count;
        near.count += n;
        if (near.number.size() < near.count + 16) {
            near.number.resize(2 * near.count + 64);
            for (auto& x : near.x) x.resize(2 * near.count + 64);
        }
        const Vec<Dim, double> shift = shift_of(code, grid);
        for (int c = 0; c < Dim; ++c) {
            auto const* x = source.column(position)[std::size_t(c)].data() + j0;
            float* out = near.x[c].data() + o;
            const double origin = grid.corner(c, corner[std::size_t(c)]) - shift[c];
            for (std::size_t s = 0; s < n; ++s) out[s] = float(double(x[s]) - origin);
        }
        for (std::size_t s = 0; s < n; ++s)
            near.number[o + s] = code == 0 ? j0 + std::int32_t(s) : of.record_of(j0 + std::int32_t(s), code, source.size());
    }

    std::vector<CellLists> cell_;
    std::int64_t pairs_ = 0, slots_ = 0;
};

} // namespace spate
