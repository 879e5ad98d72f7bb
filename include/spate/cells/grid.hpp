// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief One global integer grid: bins about as long as the interaction range (finer along x), and cells of M ranges
/// an edge, the unit of work. Geometry only; who is in a bin is Binning.
#pragma once

#include "spate/core/box.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace spate {

template <int Dim>
using Index = std::array<std::int32_t, std::size_t(Dim)>;

template <int Dim>
class Grid {
public:
    /// \param box     the domain; bins count from its lower corner, beyond it where a face is open
    /// \param range   length of a bin across x, at least the reach of the neighbour lists [m]
    /// \param finer   bins in a range along x
    /// \param cell    ranges along the edge of a cell
    Grid(Box<Dim> const& box, Edges<Dim> const& edges, double range, int finer, int cell)
        : box_(box), finer_(finer), cell_(cell)
    {
        for (int c = 0; c < Dim; ++c) {
            const auto k = std::size_t(c);
            const double length = box.size()[c];
            ranges_[k] = edges.periodic(c) ? std::int32_t(std::max(1.0, std::floor(length / range))) : 0;
            const double size = edges.periodic(c) ? length / ranges_[k] : range;
            edge_[k] = c == 0 ? size / finer : size;
            length_[k] = edges.periodic(c) ? length : 0;
            per_cell_[k] = 1.0 / bins_of_cell(c);
        }
    }
    [[nodiscard]] int finer() const { return finer_; }
    [[nodiscard]] int cell() const { return cell_; }
    [[nodiscard]] Box<Dim> const& box() const { return box_; }
    [[nodiscard]] bool periodic(int c) const { return ranges_[std::size_t(c)] > 0; }
    [[nodiscard]] bool any_periodic() const
    {
        bool any = false;
        for (int c = 0; c < Dim; ++c) any = any || periodic(c);
        return any;
    }
    /// Length of a periodic axis [m], 0 for others.
    [[nodiscard]] double period(int c) const { return length_[std::size_t(c)]; }
    /// Bins along an axis: of a range (x: `finer`).
    [[nodiscard]] int per_range(int c) const { return c == 0 ? finer_ : 1; }
    /// Number of bins along a periodic axis; 0 for others.
    [[nodiscard]] std::int32_t bins(int c) const { return ranges_[std::size_t(c)] * per_range(c); }
    [[nodiscard]] int bins_of_cell(int c) const { return cell_ * per_range(c); }
    [[nodiscard]] int bins_of_cell() const
    {
        int n = 1;
        for (int c = 0; c < Dim; ++c) n *= bins_of_cell(c);
        return n;
    }
    /// Length of a bin along an axis [m].
    [[nodiscard]] double edge(int c) const { return edge_[std::size_t(c)]; }
    /// The bin of a coordinate: half-open [lower, upper). Not finite or beyond the index: the largest index.
    [[nodiscard]] std::int32_t bin(int c, double x) const
    {
        constexpr double far = 1 << 30;
        const auto k = std::size_t(c);
        const double b = std::floor((x - box_.lo[c]) / edge_[k]);
        if (!(b > -far && b < far)) return std::numeric_limits<std::int32_t>::max();
        const auto i = std::int32_t(b);
        if (ranges_[k] == 0) return i;
        return i < 0 ? 0 : i >= bins(c) ? bins(c) - 1 : i; // wrapped before: only rounding can leave the period
    }
    /// Lower corner of a bin [m].
    [[nodiscard]] double corner(int c, std::int32_t bin) const { return box_.lo[c] + bin * edge_[std::size_t(c)]; }
    /// The cell that holds a bin.
    [[nodiscard]] std::int32_t cell_of(int c, std::int32_t bin) const
    {
        // Rounding is far from half a bin: exact, and a division of integers less.
        return std::int32_t(std::floor((double(bin) + 0.5) * per_cell_[std::size_t(c)]));
    }
    /// x brought into [lower, upper) of a periodic axis.
    [[nodiscard]] double wrapped(int c, double x) const
    {
        const double L = period(c), lo = box_.lo[c];
        if (L == 0 || (x >= lo && x < box_.hi[c])) return x;
        const double y = x - L * std::floor((x - lo) / L);
        return y < lo || y >= box_.hi[c] ? lo : y; // rounding may land on the upper face, which is the lower one
    }

private:
    Box<Dim> box_;
    int finer_, cell_;
    std::array<double, std::size_t(Dim)> edge_{}, length_{}, per_cell_{};
    std::array<std::int32_t, std::size_t(Dim)> ranges_{};
};

} // namespace spate
