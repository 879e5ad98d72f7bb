// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Neighbour lists with a skin, one for each ordered pair of species (target <- source): for each block of W
/// targets the k-th neighbour of each, in the order (global bin, id); short lists end in the sentinel record.
#pragma once

#include "spate/cells/skins.hpp"

#include <new>
#include <optional>

namespace spate {

/// How neighbour lists are kept; part of the scene, since bins fix the order of sums and with it the bits.
struct Neighbours {
    double skin = 0.07; ///< reach of a list beyond the range, as a fraction of it, at most [-]
    double bins = 0;    ///< bin edge over the range [-], 0: 1 + skin; at least 1 + skin
    double trigger = 0; ///< lists are rebuilt when a pair may have closed in by this fraction of the range; 0: skin
    int finer = 4;      ///< bins in a range along x [-]
    bool local = false; ///< skin and trigger are thinner where particles move alike; see Skins
    int window = 16;    ///< targets within which those of like list length share a block; changes no bit
    int most = 65536;   ///< neighbours of a particle in one species: more is a clump, at which a run stops

    void check() const
    {
        require(skin > 0 && skin <= 2, "neighbours.skin", skin, "above 0 and at most 2");
        require(bins == 0 || (bins >= 1 + skin && bins <= 4), "neighbours.bins", bins, "0, or 1 + skin up to 4");
        require(trigger == 0 || (trigger > 0 && trigger <= skin), "neighbours.trigger", trigger,
                "0, or above 0 and at most skin");
        require(window >= 1 && window <= 4096, "neighbours.window", window, "1 to 4096 targets");
        require(finer >= 1 && finer <= 16, "neighbours.finer", finer, "1 to 16");
        require(most >= 1, "neighbours.most", most, "1 or above");
    }
    [[nodiscard]] double bin_edge() const { return bins > 0 ? bins : 1 + skin; }
    [[nodiscard]] double closed_in() const { return trigger > 0 ? trigger : skin; }
};

/// The lists of one target cell: entry (begin[b] + k) * W + lane is the k-th neighbour of target lane of block b, as the
/// place of its record: its number times the length of a record. Lane l of block b is the cell's particle
/// target[b * W + l]; within a window of targets blocks gather lists of like length (SELL-C-sigma: Kreutzer et al. 2014),
/// so that little of a block is sentinels. The last block repeats its last target.
struct CellLists {
    std::vector<std::int32_t> begin, target;
    Array<std::int32_t> index;
    std::int64_t pairs = 0;   ///< within range when the lists were built
    bool in_order = true;     ///< lanes hold targets one after the other: `target` is not needed
    std::int32_t targets = 0; ///< of the cell

    /// The particle of the cell in a lane, of all lanes of all blocks.
    [[nodiscard]] std::int32_t target_of(std::size_t lane) const
    {
        return in_order ? std::min(std::int32_t(lane), targets - 1) : target[lane];
    }
};

/// Particles of a source that others own, as far as targets here reach: their records follow those of the images.
template <int Dim, class T>
struct Foreign {
    Places<Dim, T> places;
    Binning<Dim> const& bins;
    std::int32_t first; ///< record of the first of them
    std::vector<std::uint32_t> const& ids;

    /// Records of them and of their images.
    [[nodiscard]] std::size_t records() const { return places.size + bins.images().of.size(); }
    /// Which of them a record is.
    [[nodiscard]] std::size_t number_of(std::size_t record) const
    {
        const std::size_t k = record - std::size_t(first);
        return k < places.size ? k : std::size_t(bins.images().of[k - places.size]);
    }
};

template <int Dim>
class Lists {
public:
    /// Whom lists are for.
    template <class T>
    struct For {
        int species;
        Places<Dim, T> places;
        Binning<Dim> const& bins;
        std::vector<std::uint32_t> const& ids;
    };
    /// One source of the lists of a target: where they go, and whom they list.
    template <class T>
    struct From {
        Lists& lists;
        Places<Dim, T> places;
        Binning<Dim> const& bins;
        int record; ///< length of a record of the source
        bool same;  ///< target and source are one species: a particle is not its own neighbour
        std::optional<Foreign<Dim, T>> foreign = {};

        [[nodiscard]] std::size_t records() const { return places.size + (foreign ? foreign->records() : 0); }
    };
    /// Builds the lists of a target over all its sources (at most two) together: their blocks hold the same targets.
    /// \param W  targets in a block    \param range  [m]
    /// Throws NeighbourOverflow for a particle that has too many neighbours, or where they need more memory than there is.
    template <class T, class Workers>
    static void build(For<T> const& target, Grid<Dim> const& grid, int W, Neighbours const& how, double range,
                      Skins<Dim> const& skins, Workers const& backend,
                      std::type_identity_t<std::span<const From<T>>> sources)
    {
        const std::size_t cells = target.bins.cells();
        for (auto const& from : sources) from.lists.begin_build(cells, from.record, from.records());
        try {
            backend.for_each(cells,
                             [&](std::size_t k) { build_cell<T>(k, target, grid, W, how, range, skins, sources); });
        }
        catch (std::bad_alloc const&) {
            stop_for_memory(target, how.most);
        }
        for (auto const& from : sources) from.lists.end_build();
    }
    [[nodiscard]] CellLists const& of_cell(std::size_t k) const { return cell_[k]; }
    /// The number of the source's record at a place that a list holds.
    [[nodiscard]] std::size_t number(std::int32_t place) const
    {
        return std::size_t(std::uint32_t(place)) / std::size_t(record_);
    }
    /// ... and the place of a number.
    [[nodiscard]] std::int32_t place(std::size_t number) const { return std::int32_t(number * std::size_t(record_)); }
    /// Directed pairs within range when the lists were built.
    [[nodiscard]] std::int64_t pairs() const { return pairs_; }
    /// Entries of all lists, sentinels too.
    [[nodiscard]] std::int64_t slots() const { return slots_; }
    [[nodiscard]] std::size_t bytes() const
    {
        std::size_t b = cell_.capacity() * sizeof(CellLists);
        for (auto const& c : cell_) b += 4 * (c.begin.capacity() + c.target.capacity() + c.index.capacity());
        return b;
    }

private:
    /// Squares of the distances of a selection. Positions are floats from a row's corner: the reach grows by the rounding
    /// of both ends, so that no pair is lost.
    struct Ranges {
        double hair;
        float reach2, range2;
        Ranges(double reach, double range, Grid<Dim> const& grid)
            : hair(reach * (1 + 2e-6) + 4e-7 * (grid.cell() + 2) * reach), reach2(float(hair * hair)),
              range2(float(range * range))
        {}
    };
    /// Candidates of a row of bins of one cell, copied together: positions as float from the row's corner; in the plane of
    /// all rows of the cell, as what is near one row is near the next.
    struct Candidates {
        Array<float> x[std::size_t(Dim)];
        std::vector<std::int32_t> number, first; // first: of row r, bin b at r * (bins + 1) + b
        std::size_t count = 0;
    };
    /// The lists of a window of targets, before they are dealt into blocks.
    struct Window {
        Candidates near;
        std::vector<std::int32_t> row;    // of target t at t * stride
        std::vector<std::int32_t> length; // of target t
        std::vector<std::int32_t> list;   // of the cell, so far
        std::size_t used = 0;             // of it
        std::vector<std::int32_t> nobody; // the list of a lane without a target
        std::array<std::int32_t*, 64> lane{};
        std::size_t stride = 0;

        void make_room(std::size_t targets, std::size_t open)
        {
            length.resize(std::max(length.size(), targets));
            // A selection writes whole registers; an odd number of cache lines keeps rows out of each other's way.
            const std::size_t need = ((near.count + 48) / 16 | 1) * 16;
            if (nobody.size() < need) nobody.resize(need);
            if (need <= stride && row.size() >= targets * stride) return;
            std::vector<std::int32_t> grown(need * targets);
            for (std::size_t t = 0; t < open; ++t)
                std::copy_n(row.begin() + std::ptrdiff_t(t * stride), length[t],
                            grown.begin() + std::ptrdiff_t(t * need));
            row = std::move(grown);
            stride = need;
        }
    };

    void begin_build(std::size_t cells, int record, std::size_t sources)
    {
        if (sources * std::size_t(record) > std::size_t(std::numeric_limits<std::int32_t>::max()))
            throw BadInput("number of particles of a species", std::to_string(sources),
                           "at most " + std::to_string(std::numeric_limits<std::int32_t>::max() / record) +
                               " in one process: use more processes");
        cell_.resize(cells);
        record_ = record;
    }
    void end_build()
    {
        pairs_ = slots_ = 0;
        for (auto const& c : cell_) pairs_ += c.pairs, slots_ += std::int64_t(c.index.size());
    }

    static constexpr std::size_t most_sources = 2;
    static constexpr bool whole_cells = Dim == 2; ///< gathered at once; a cell of space would not stay in the cache

    template <class T>
    static void build_cell(std::size_t k, For<T> const& target, Grid<Dim> const& grid, int W, Neighbours const& how,
                           double range, Skins<Dim> const& skins, std::span<const From<T>> from)
    {
        auto const& at = target.bins;
        const double beyond = how.skin - how.closed_in(); // reach beyond range and skin, as a fraction of the range
        static thread_local std::array<Window, most_sources> open;
        static thread_local std::vector<std::int32_t> order;
        const std::size_t sources = from.size();
        std::array<CellLists*, most_sources> lists{};
        for (std::size_t q = 0; q < sources; ++q) lists[q] = &from[q].lists.cell_[k];
        const int nx = grid.bins_of_cell(0), rows = grid.bins_of_cell() / nx;
        const Index<Dim> cell = at.cell(k);
        const int window = (std::max(how.window, W) + W - 1) / W * W;

        for (std::size_t q = 0; q < sources; ++q) {
            lists[q]->begin.assign(1, 0);
            lists[q]->target.clear();
            lists[q]->pairs = 0;
            lists[q]->in_order = how.window == 1, lists[q]->targets = at.end(k) - at.begin(k);
            open[q].used = 0;
        }
        int count = 0;
        std::int32_t first = 0; // of the window
        bool gathered = false;
        const Ranges everywhere(range * (1 + skins.least() + beyond), range, grid);
        auto close_window = [&] {
            like_lengths_together(order, open[0].length, count, W);
            for (std::size_t q = 0; q < sources; ++q)
                deal(open[q], order, first, count, W, from[q].record,
                     std::int32_t(from[q].places.size) * from[q].record, *lists[q]);
            first += count;
            count = 0;
        };
        for (int r = 0; r < rows; ++r) {
            const std::int32_t b0 = at.first(k, r * nx), b1 = at.first(k, (r + 1) * nx);
            if (b0 == b1) continue;
            Index<Dim> corner; // first bin of the row
            corner[0] = cell[0] * nx;
            if constexpr (Dim > 1) corner[1] = cell[1] * grid.bins_of_cell(1) + r % grid.bins_of_cell(1);
            if constexpr (Dim > 2) corner[2] = cell[2] * grid.bins_of_cell(2) + r / grid.bins_of_cell(1);
            if (!whole_cells || !gathered) {
                if constexpr (whole_cells) corner[1] -= r;
                for (std::size_t q = 0; q < sources; ++q) {
                    gather(open[q].near, corner, from[q], grid);
                    open[q].make_room(std::size_t(window), std::size_t(count));
                }
                if constexpr (whole_cells) corner[1] += r;
                gathered = true;
            }
            const int row = whole_cells ? r : 0; // of those gathered
            auto targets = [&](std::int32_t i, std::int32_t last, Ranges const& ranges) {
                for (; i < last; ++i) {
                    double x[std::size_t(Dim)];
                    for (int c = 0; c < Dim; ++c)
                        x[c] = double(target.places.x[std::size_t(c)][i]) - grid.corner(c, corner[std::size_t(c)]);
                    for (std::size_t q = 0; q < sources; ++q) {
                        auto& w = open[q];
                        w.length[std::size_t(count)] =
                            w.near.count == 0 ? 0
                                              : select(w.near, row, x, grid, ranges, from[q].same ? i : -1,
                                                       w.row.data() + std::size_t(count) * w.stride, lists[q]->pairs);
                        if (w.length[std::size_t(count)] > how.most)
                            stop(target, std::size_t(i), "its number of neighbours", w.length[std::size_t(count)],
                                 how.most);
                    }
                    if (++count == window) close_window();
                }
            };
            if (skins.uniform()) {
                targets(b0, b1, everywhere);
                continue;
            }
            const std::size_t patch = k * Skins<Dim>::patches_of_cell(grid) + std::size_t(r * grid.cell());
            for (int b = 0, i = b0; b < grid.cell(); ++b) {
                const Ranges ranges(range * (1 + skins.of(patch + std::size_t(b)) + beyond), range, grid);
                const std::int32_t last = at.first(k, r * nx + (b + 1) * grid.finer());
                targets(i, last, ranges);
                i = last;
            }
        }
        if (count > 0) close_window();
        for (std::size_t q = 0; q < sources; ++q) {
            auto& index = lists[q]->index;
            if (index.capacity() > open[q].used + open[q].used / 32) Array<std::int32_t>().swap(index);
            index.assign(open[q].list.begin(), open[q].list.begin() + std::ptrdiff_t(open[q].used));
        }
    }

    template <class T>
    [[noreturn, gnu::cold]] static void stop(For<T> const& target, std::size_t i, std::string quantity, double value,
                                             int most)
    {
        StopFacts f = facts(target.places, target.ids, i);
        f.species = target.species, f.quantity = std::move(quantity), f.value = value, f.limit = most;
        throw NeighbourOverflow(f);
    }
    /// Names the first particle of the fullest cell.
    template <class T>
    [[noreturn, gnu::cold]] static void stop_for_memory(For<T> const& target, int most)
    {
        auto const& at = target.bins;
        std::size_t fullest = 0;
        for (std::size_t k = 0; k < at.cells(); ++k)
            if (at.end(k) - at.begin(k) > at.end(fullest) - at.begin(fullest)) fullest = k;
        const std::int32_t first = at.begin(fullest);
        stop(target, std::size_t(first),
             "that all neighbours need more memory than there is; the number of particles in its cell, the fullest,",
             at.end(fullest) - first, most);
    }

    /// Appends the neighbours of a target at x from the row's corner: of each row of bins, the stretch that the reach
    /// can touch, 16 candidates at a time.
    /// \param row  of the rows that were gathered
    static std::int32_t select(Candidates const& near, int row, double const (&x)[std::size_t(Dim)],
                               Grid<Dim> const& grid, Ranges const& ranges, std::int32_t self, std::int32_t* out,
                               std::int64_t& within)
    {
        const int nx_near = grid.bins_of_cell(0) + 2 * grid.finer();
        constexpr int near_rows = Dim == 1 ? 1 : Dim == 2 ? 3 : 9;
        float xi[std::size_t(Dim)];
        for (int c = 0; c < Dim; ++c) xi[c] = float(x[c]);
        float across[3][3] = {}; // squared distance to the rows below, at and above, along y and z
        for (int c = 1; c < Dim; ++c) {
            const float below = std::max(xi[c], 0.0f), above = std::max(float(grid.edge(c)) - xi[c], 0.0f);
            across[c][0] = below * below, across[c][2] = above * above;
        }
        constexpr float hair = 1e-3f; // bins
        const auto per_bin = float(1 / grid.edge(0)), last = float(nx_near - 1);
        const float at_bin = xi[0] * per_bin + float(grid.finer());
        float half[12];
        std::int32_t from[12], to[12];
        for (int q = 0; q < near_rows; ++q)
            half[q] = ranges.reach2 - (across[1][q % 3] + across[2][Dim > 2 ? q / 3 : 1]);
        for (int q = 0; q < near_rows; ++q) {
            const float bins = grid.finer() == 1 ? 1 + hair : std::sqrt(std::max(half[q], 0.0f)) * per_bin + hair;
            from[q] = std::int32_t(std::max(at_bin - bins, 0.0f));
            to[q] = std::int32_t(std::min(at_bin + bins, last)) + 1;
        }
        if constexpr (whole_cells) xi[1] = float(x[1] + row * grid.edge(1)); // candidates are from the cell's corner
        std::int32_t m = 0;
        for (int q = 0; q < near_rows; ++q) {
            if (half[q] <= 0) continue;
            std::int32_t const* first = near.first.data() + (row + q) * (nx_near + 1);
            const std::int32_t end = first[to[q]];
            for (std::int32_t j = first[from[q]]; j < end; j += 16) {
                float const* xj[std::size_t(Dim)];
                for (int c = 0; c < Dim; ++c) xj[c] = near.x[c].data() + j;
                m += select_near<Dim>(xj, near.number.data() + j, end - j, xi, ranges.reach2, ranges.range2, self,
                                      out + m, within);
            }
        }
        return m;
    }

    /// The targets of a window in the order of their list lengths, longest first; ties keep their place.
    static void like_lengths_together(std::vector<std::int32_t>& order, std::vector<std::int32_t> const& length,
                                      int count, int W)
    {
        order.resize(std::size_t(count));
        for (std::int32_t t = 0; t < count; ++t) order[std::size_t(t)] = t;
        if (count <= W) return;
        std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
            const auto la = length[std::size_t(a)], lb = length[std::size_t(b)];
            return la != lb ? la > lb : a < b;
        });
    }
    /// to[s * W + l] = record * row[l][s], s < length; W is 1 or a multiple of 4. Writes up to 8 W entries past the end.
    static void interleave(std::int32_t const* const* row, int W, std::int32_t length, std::int32_t record,
                           std::int32_t* to)
    {
        if (W % 8 == 0) {
            for (std::int32_t s = 0; s < length; s += 8)
                for (int l = 0; l < W; l += 8) interleave_8(row + l, s, W, record, to + std::ptrdiff_t(s) * W + l);
            return;
        }
        for (std::int32_t s = 0; s < length; ++s)
            for (int l = 0; l < W; ++l) to[s * W + l] = row[l][s] * record;
    }
    /// Deals the targets of a window into blocks and appends their lists.
    static void deal(Window& open, std::vector<std::int32_t> const& order, std::int32_t first, int count, int W,
                     std::int32_t record, std::int32_t sentinel, CellLists& lists)
    {
        auto& list = open.list;
        for (int b = 0; b < count; b += W) {
            std::int32_t longest = 0;
            for (int l = b; l < std::min(b + W, count); ++l)
                longest = std::max(longest, open.length[std::size_t(order[std::size_t(l)])]);
            const std::size_t o = open.used, full = std::size_t(longest + 8) * std::size_t(W); // interleaved by eights
            open.used += std::size_t(longest) * std::size_t(W);
            if (list.size() < o + full) list.resize(2 * (o + full));
            for (int l = 0; l < W; ++l) {
                const bool real = b + l < count;
                const auto t = std::size_t(order[std::size_t(real ? b + l : count - 1)]);
                const std::int32_t length = real ? open.length[t] : 0;
                if (!lists.in_order) lists.target.push_back(first + std::int32_t(t));
                std::int32_t* const row = real ? open.row.data() + t * open.stride : open.nobody.data();
                std::fill(row + length, row + longest + 8, sentinel / record);
                open.lane[std::size_t(l)] = row;
            }
            interleave(open.lane.data(), W, longest, record, list.data() + o);
            lists.begin.push_back(std::int32_t(open.used / std::size_t(W)));
        }
    }

    /// Copies the candidates of one row of a cell: rows in the order of the global bins, images in their place.
    template <class T>
    static void gather(Candidates& near, Index<Dim> const& corner, From<T> const& source, Grid<Dim> const& grid)
    {
        const int reach_x = grid.finer(), nx = grid.bins_of_cell(0) + 2 * reach_x;
        const int near_rows = Dim == 1 ? 1 : Dim == 2 ? grid.bins_of_cell(1) + 2 : 9;
        near.first.resize(std::size_t(near_rows * (nx + 1)));
        near.count = 0;
        for (int q = 0; q < near_rows; ++q) {
            Index<Dim> bin = corner;
            if constexpr (Dim == 2) bin[1] += q - 1;
            if constexpr (Dim == 3) bin[1] += q % 3 - 1;
            if constexpr (Dim == 3) bin[2] += q / 3 - 1;
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
                    local =
                        local * grid.bins_of_cell(c) + at[std::size_t(c)] - cell[std::size_t(c)] * grid.bins_of_cell(c);
                }
                int stretch = std::min(nx - b, (cell[0] + 1) * grid.bins_of_cell(0) - at[0]);
                if (grid.periodic(0) &&
                    exists) { // to the end of the period, or of its images: there is no record beyond
                    const std::int32_t bins = grid.bins(0), x = corner[0] - reach_x + b;
                    stretch = std::min(stretch, (x < 0 ? 0 : x < bins ? bins : bins + reach_x) - x);
                }
                Binning<Dim> const* of = &source.bins;
                std::int32_t k = exists ? of->find(cell) : -1;
                if (k < 0 && exists && source.foreign) of = &source.foreign->bins, k = of->find(cell);
                if (k < 0) {
                    for (int s = 0; s < stretch; ++s) first[b + s] = std::int32_t(near.count);
                }
                else {
                    const std::int32_t j0 = of->first(std::size_t(k), local);
                    for (int s = 0; s < stretch; ++s)
                        first[b + s] = std::int32_t(near.count) + of->first(std::size_t(k), local + s) - j0;
                    const std::int32_t j1 = of->first(std::size_t(k), local + stretch);
                    const bool own = of == &source.bins;
                    auto const& places = own ? source.places : source.foreign->places;
                    const std::int32_t from = own ? 0 : source.foreign->first;
                    const std::size_t images = own ? places.size : places.size - 1; // theirs need no second sentinel
                    copy(near, j0, j1, full, corner, places, grid,
                         [&](std::int32_t j) { return from + of->record_of(j, full, images); });
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
    template <class T>
    static void copy(Candidates& near, std::int32_t j0, std::int32_t j1, int code, Index<Dim> const& corner,
                     Places<Dim, T> const& source, Grid<Dim> const& grid, auto const& record)
    {
        const std::size_t n = std::size_t(j1 - j0), o = near.count;
        near.count += n;
        if (near.number.size() < near.count + 16) {
            near.number.resize(2 * near.count + 64);
            for (auto& x : near.x) x.resize(2 * near.count + 64);
        }
        const Vec<Dim, double> shift = shift_of(code, grid);
        for (int c = 0; c < Dim; ++c) {
            T const* x = source.x[std::size_t(c)] + j0;
            float* out = near.x[c].data() + o;
            const double origin = grid.corner(c, corner[std::size_t(c)]) - shift[c];
            for (std::size_t s = 0; s < n; ++s) out[s] = float(double(x[s]) - origin);
        }
        for (std::size_t s = 0; s < n; ++s) near.number[o + s] = record(j0 + std::int32_t(s));
    }

    std::vector<CellLists> cell_;
    std::int64_t pairs_ = 0, slots_ = 0;
    int record_ = 1;
};

} // namespace spate
