// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Particles sorted by (cell, bin, id): which cells are occupied, where each bin begins, and the periodic images
/// of the particles near a periodic face. Memory grows with occupied cells, never with the bounding box.
#pragma once

#include "spate/cells/grid.hpp"
#include "spate/core/particles.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace spate {

/// A periodic image: record n + 1 + k of a species is particle `of[k]` moved by shift `code[k]`.
struct Images {
    std::vector<std::int32_t> of;
    std::vector<std::int8_t> code;       ///< base-3 digits per axis: 0 none, 1 up by a period, 2 down
    std::vector<std::int32_t> first;     ///< first image of particle i (n + 1 entries)
    std::vector<std::uint8_t> near_face; ///< two bits an axis: image up, image down
};

/// Where the particles of a species are: all that sorting and lists ask of it, so that they are compiled once.
template <int Dim, class T>
struct Places {
    std::array<T const*, std::size_t(Dim)> x; ///< columns
    std::size_t size;                         ///< particles

    template <class P, Field F = Position>
    static Places of(P const& p, F where = {})
    {
        Places places{{}, p.size()};
        for (std::size_t c = 0; c < std::size_t(Dim); ++c) places.x[c] = p.column(where)[c].data();
        return places;
    }
};

/// Who and where a particle is, for a stop.
template <int Dim, class T>
[[gnu::cold]] StopFacts facts(Places<Dim, T> const& places, std::vector<std::uint32_t> const& ids, std::size_t i)
{
    StopFacts f;
    f.particle = ids[i];
    for (int c = 0; c < Dim; ++c) f.position[c] = double(places.x[std::size_t(c)][i]);
    return f;
}

template <int Dim>
class Binning {
public:
    /// Sorts the particles by (cell, bin, id) of their position, or of another field, and finds the occupied cells.
    /// \param in_parts  how loops are shared: core/in_parts.hpp
    template <class P, class Parts = InOnePart, Field F = Position>
    void sort(P& p, Grid<Dim> const& grid, Parts const& in_parts = {}, F where = {})
    {
        using Places = spate::Places<Dim, typename P::real>;
        p.permute(order_of(Places::of(p, where), p.id(), grid, in_parts), in_parts);
        make_images(Places::of(p, where), grid);
    }

    [[nodiscard]] std::size_t cells() const { return cells_.size(); }
    [[nodiscard]] Index<Dim> cell(std::size_t k) const { return unpacked(cells_[k]); }
    /// First particle of local bin b of occupied cell k; of bin b + 1 is its end.
    [[nodiscard]] std::int32_t first(std::size_t k, int b) const
    {
        return first_[k * std::size_t(bins_of_cell_) + std::size_t(b)];
    }
    /// The same by the bin's number: bins are numbered cell by cell.
    [[nodiscard]] std::int32_t first(std::size_t bin) const { return first_[bin]; }
    [[nodiscard]] std::int32_t begin(std::size_t k) const { return first(k, 0); }
    [[nodiscard]] std::int32_t end(std::size_t k) const { return first_[(k + 1) * std::size_t(bins_of_cell_)]; }
    /// Number of the occupied cell at an index, or -1.
    [[nodiscard]] std::int32_t find(Index<Dim> const& cell) const { return find(packed(cell)); }
    [[nodiscard]] Images const& images() const { return images_; }
    /// Record index of the image of particle i with shift `code` (0: the particle itself).
    [[nodiscard]] std::int32_t record_of(std::int32_t i, int code, std::size_t n) const
    {
        if (code == 0) return i;
        const int near_face = images_.near_face[std::size_t(i)];
        int slot = 0, stride = 1;
        for (int c = 0; c < Dim; ++c, code /= 3) {
            const int up = (near_face >> (2 * c)) & 1, down = (near_face >> (2 * c + 1)) & 1;
            const int digit = code % 3;
            slot += stride * (digit == 2 ? 1 + up : digit);
            stride *= 1 + up + down;
        }
        return std::int32_t(n) + images_.first[std::size_t(i)] + slot; // n + 1 + first + (slot - 1)
    }
    [[nodiscard]] std::size_t bytes() const
    {
        return cells_.capacity() * 8 + first_.capacity() * 4 + table_.capacity() * 8 + images_.of.capacity() * 5 +
               images_.first.capacity() * 4 + images_.near_face.capacity();
    }

private:
    static constexpr std::uint64_t overflow = ~std::uint64_t(0);
    static constexpr int bits = 21; // of a cell's index along an axis, about the origin

    static std::uint64_t packed(Index<Dim> const& cell)
    {
        std::uint64_t key = 0;
        for (int c = Dim - 1; c >= 0; --c) {
            const std::int64_t i = std::int64_t(cell[std::size_t(c)]) + (1 << (bits - 1));
            if (i < 0 || i >= (1 << bits)) return overflow;
            key = (key << bits) | std::uint64_t(i);
        }
        return key;
    }
    static Index<Dim> unpacked(std::uint64_t key)
    {
        Index<Dim> cell;
        for (int c = 0; c < Dim; ++c, key >>= bits)
            cell[std::size_t(c)] = std::int32_t(key & ((1u << bits) - 1)) - (1 << (bits - 1));
        return cell;
    }
    /// The particles by (cell, bin, id), and the cells that they occupy. Who is in which cell is counted by one thread, in
    /// their order, in which most have the cell of the one before; all else by cells or by particles.
    template <class T>
    std::vector<std::int32_t> order_of(Places<Dim, T> const& places, std::vector<std::uint32_t> const& id,
                                       Grid<Dim> const& grid, auto const& in_parts)
    {
        const std::size_t n = places.size;
        bins_of_cell_ = grid.bins_of_cell();
        std::vector<std::uint64_t> key(n); // of the cell
        std::vector<std::int32_t> local(n), in_cell(n), order(n);
        in_parts(n, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) find_bin(places, grid, i, key[i], local[i]);
        });
        const auto beyond = std::find(key.begin(), key.end(), overflow);
        if (beyond != key.end()) {
            StopFacts f = facts(places, id, std::size_t(beyond - key.begin()));
            f.quantity = "the cell index of its position";
            f.limit = double(1 << (bits - 1)), f.value = std::numeric_limits<double>::infinity();
            throw IndexOverflow(f);
        }
        find_cells(key);
        first_.resize(cells_.size() * std::size_t(bins_of_cell_) + 1);
        std::vector<std::int32_t> begin(cells_.size() + 1, 0);
        for_each_cell(key, [&](std::size_t cell, std::size_t) { ++begin[cell + 1]; });
        for (std::size_t c = 1; c < begin.size(); ++c) begin[c] += begin[c - 1];
        auto next = begin;
        for_each_cell(key,
                      [&](std::size_t cell, std::size_t i) { in_cell[std::size_t(next[cell]++)] = std::int32_t(i); });
        first_.back() = std::int32_t(n);
        in_parts(cells_.size(), [&](std::size_t c, std::size_t last) {
            for (; c < last; ++c)
                order_cell(first_.data() + c * std::size_t(bins_of_cell_), begin[c], begin[c + 1], local, id, in_cell,
                           order);
        });
        return order;
    }
    template <class T>
    static void find_bin(Places<Dim, T> const& places, Grid<Dim> const& grid, std::size_t i, std::uint64_t& key,
                         std::int32_t& local)
    {
        Index<Dim> cell;
        local = 0;
        for (int c = Dim - 1; c >= 0; --c) {
            const std::int32_t bin = grid.bin(c, double(places.x[std::size_t(c)][i]));
            cell[std::size_t(c)] = grid.cell_of(c, bin);
            local = local * grid.bins_of_cell(c) + (bin - cell[std::size_t(c)] * grid.bins_of_cell(c));
        }
        key = packed(cell);
    }
    /// f(number of its cell, i) for each particle i.
    void for_each_cell(std::vector<std::uint64_t> const& key, auto const& f) const
    {
        std::uint64_t last = overflow;
        std::size_t cell = 0;
        for (std::size_t i = 0; i < key.size(); ++i) {
            if (key[i] != last) last = key[i], cell = std::size_t(find(last));
            f(cell, i);
        }
    }
    /// The particles in_cell[begin] to in_cell[end] of a cell by (bin, id), and where its bins begin.
    void order_cell(std::int32_t* bin, std::int32_t begin, std::int32_t end, std::vector<std::int32_t> const& local,
                    std::vector<std::uint32_t> const& id, std::vector<std::int32_t> const& in_cell,
                    std::vector<std::int32_t>& order) const
    {
        const auto bins = std::size_t(bins_of_cell_);
        std::fill_n(bin, bins, 0);
        for (std::int32_t k = begin; k < end; ++k) ++bin[local[std::size_t(in_cell[std::size_t(k)])]];
        std::int32_t next = begin;
        for (std::size_t b = 0; b < bins; ++b) next = bin[b] += next; // where bins end
        for (std::int32_t k = end; k-- > begin;) {
            const std::int32_t i = in_cell[std::size_t(k)];
            order[std::size_t(--bin[local[std::size_t(i)]])] = i;
        }
        auto earlier = [&](std::int32_t a, std::int32_t d) { return id[std::size_t(a)] < id[std::size_t(d)]; };
        for (std::size_t b = 0; b < bins; ++b) {
            auto* const from = order.data() + bin[b];
            auto* const to = order.data() + (b + 1 < bins ? bin[b + 1] : end);
            if (to - from > 1 && !std::is_sorted(from, to, earlier)) std::sort(from, to, earlier);
        }
    }
    /// The distinct keys, in order, and an open-addressing table from key to number.
    void find_cells(std::vector<std::uint64_t> const& key)
    {
        cells_.clear();
        std::uint64_t last = overflow;
        for (std::uint64_t k : key)
            if (k != last) cells_.push_back(last = k);
        std::sort(cells_.begin(), cells_.end());
        cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
        std::size_t size = 16;
        while (size < 2 * cells_.size()) size *= 2;
        table_.assign(size, -1);
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            std::size_t h = hash(cells_[c]);
            while (table_[h] >= 0) h = (h + 1) & (table_.size() - 1);
            table_[h] = std::int32_t(c);
        }
    }
    [[nodiscard]] std::size_t hash(std::uint64_t key) const
    {
        key *= 0x9E3779B97F4A7C15u;
        key ^= key >> 32; // the last axis is in the high bits: without this it would have no say
        return std::size_t((key * 0x9E3779B97F4A7C15u) >> 32) & (table_.size() - 1);
    }
    [[nodiscard]] std::int32_t find(std::uint64_t key) const
    {
        if (table_.empty()) return -1;
        for (std::size_t h = hash(key); table_[h] >= 0; h = (h + 1) & (table_.size() - 1))
            if (cells_[std::size_t(table_[h])] == key) return table_[h];
        return -1;
    }
    template <class T>
    void make_images(Places<Dim, T> const& places, Grid<Dim> const& grid)
    {
        auto const& x = places.x;
        const std::size_t n = places.size;
        images_ = {};
        if (!grid.any_periodic()) return;
        images_.near_face.resize(n);
        images_.first.assign(1, 0);
        for (std::size_t i = 0; i < n; ++i) {
            std::array<std::array<int, 3>, std::size_t(Dim)> digits{};
            std::array<int, std::size_t(Dim)> count{};
            int face = 0, total = 1;
            for (int c = 0; c < Dim; ++c) {
                auto& m = count[std::size_t(c)] = 1;
                if (grid.periodic(c)) {
                    const std::int32_t b = grid.bin(c, double(x[std::size_t(c)][i]));
                    if (b < grid.per_range(c)) face |= 1 << (2 * c), digits[std::size_t(c)][std::size_t(m++)] = 1;
                    if (b >= grid.bins(c) - grid.per_range(c))
                        face |= 2 << (2 * c), digits[std::size_t(c)][std::size_t(m++)] = 2;
                }
                total *= m;
            }
            images_.near_face[i] = std::uint8_t(face);
            for (int s = 1; s < total; ++s) {
                int rest = s, code = 0, three = 1;
                for (int c = 0; c < Dim; ++c, three *= 3) {
                    code += three * digits[std::size_t(c)][std::size_t(rest % count[std::size_t(c)])];
                    rest /= count[std::size_t(c)];
                }
                images_.of.push_back(std::int32_t(i));
                images_.code.push_back(std::int8_t(code));
            }
            images_.first.push_back(std::int32_t(images_.of.size()));
        }
    }

    int bins_of_cell_ = 1;
    std::vector<std::uint64_t> cells_;
    std::vector<std::int32_t> first_{0}, table_;
    Images images_;
};

/// The shift of an image [m].
template <int Dim>
Vec<Dim, double> shift_of(int code, Grid<Dim> const& grid)
{
    Vec<Dim, double> s{};
    for (int c = 0; c < Dim; ++c, code /= 3)
        s[c] = code % 3 == 0 ? 0 : code % 3 == 1 ? grid.period(c) : -grid.period(c);
    return s;
}

} // namespace spate
