// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What terms keep of a pair, carried from one set of neighbour lists to the next: by the ids of the two
/// particles, so that sorting does not matter. Nothing is stored for a pair whose memory is zero.
#pragma once

#include "spate/cells/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace spate {

/// The memory of the directed pairs target <- source, aside while lists are rebuilt.
/// \tparam Count  values a pair
template <Real T, int Count>
class PairMemory {
public:
    struct Pair {
        std::uint32_t i, j; ///< ids of target and source
        std::array<T, std::size_t(Count)> value;
    };

    /// Takes what the lists hold.
    template <int Dim, class P, class Q>
    void take(Lists<Dim> const& lists, std::vector<Array<T>> const& memory, P const& target, Binning<Dim> const& at,
              Q const& source, Binning<Dim> const& of, int W, Foreign<Dim, T> const* foreign = nullptr)
    {
        pairs_.clear();
        for (std::size_t cell = 0; cell < memory.size(); ++cell)
            each_slot(lists.of_cell(cell), W, [&](std::size_t slot, std::size_t row, std::size_t lane, std::int32_t t) {
                Pair p;
                bool any = false;
                for (int c = 0; c < Count; ++c) {
                    p.value[std::size_t(c)] = memory[cell][place(row, c, W) + lane];
                    any = any || p.value[std::size_t(c)] != T(0) || std::signbit(p.value[std::size_t(c)]);
                }
                const std::size_t j = lists.number(lists.of_cell(cell).index[slot]);
                if (!any || j == source.size()) return;
                p.i = target.id()[std::size_t(at.begin(cell) + t)], p.j = id_of(j, source, of, foreign);
                pairs_.push_back(p);
            });
        std::sort(pairs_.begin(), pairs_.end(), before);
    }
    /// Gives it back to new lists; pairs that are in no list any more are forgotten, new ones begin at zero.
    template <int Dim, class P, class Q>
    void give(Lists<Dim> const& lists, std::vector<Array<T>>& memory, P const& target, Binning<Dim> const& at,
              Q const& source, Binning<Dim> const& of, int W, Foreign<Dim, T> const* foreign = nullptr) const
    {
        memory.resize(at.cells());
        for (std::size_t cell = 0; cell < memory.size(); ++cell) {
            memory[cell].assign(lists.of_cell(cell).index.size() * std::size_t(Count), T(0));
            each_slot(lists.of_cell(cell), W, [&](std::size_t slot, std::size_t row, std::size_t lane, std::int32_t t) {
                const std::size_t j = lists.number(lists.of_cell(cell).index[slot]);
                if (j == source.size()) return;
                const Pair key{target.id()[std::size_t(at.begin(cell) + t)], id_of(j, source, of, foreign), {}};
                const auto found = std::lower_bound(pairs_.begin(), pairs_.end(), key, before);
                if (found == pairs_.end() || found->i != key.i || found->j != key.j) return;
                for (int c = 0; c < Count; ++c) memory[cell][place(row, c, W) + lane] = found->value[std::size_t(c)];
            });
        }
    }
    [[nodiscard]] std::vector<Pair> const& pairs() const { return pairs_; }
    /// The pairs whose target goes elsewhere are no more here; leave(pair) says so and sees to them.
    void part(auto const& leave)
    {
        std::erase_if(pairs_, [&](Pair const& p) { return leave(p); });
    }
    void join(std::vector<Pair> const& pairs)
    {
        pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
        std::sort(pairs_.begin(), pairs_.end(), before);
    }
    /// What was taken at another time; sorted by ids.
    void put(std::vector<Pair> pairs) { pairs_ = std::move(pairs); }
    /// Nothing is aside any more.
    void clear() { pairs_.clear(); }

    /// Where component c of a row of W slots begins.
    static std::size_t place(std::size_t row, int c, int W)
    {
        return (row * std::size_t(Count) + std::size_t(c)) * std::size_t(W);
    }

private:
    static bool before(Pair const& a, Pair const& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; }
    /// f(slot, row, lane, target in the cell) for each entry of a cell's lists.
    static void each_slot(CellLists const& lists, int W, auto const& f)
    {
        for (std::size_t b = 0; b + 1 < lists.begin.size(); ++b)
            for (auto row = std::size_t(lists.begin[b]); row < std::size_t(lists.begin[b + 1]); ++row)
                for (std::size_t lane = 0; lane < std::size_t(W); ++lane)
                    f(row * std::size_t(W) + lane, row, lane, lists.target[b * std::size_t(W) + lane]);
    }
    /// The particle behind a record other than the sentinel: of an image the particle itself.
    template <int Dim, class Q>
    static std::uint32_t id_of(std::size_t j, Q const& source, Binning<Dim> const& of, Foreign<Dim, T> const* foreign)
    {
        const std::size_t n = source.size();
        if (j < n) return source.id()[j];
        if (!foreign || j < std::size_t(foreign->first)) return source.id()[std::size_t(of.images().of[j - n - 1])];
        return (*foreign->ids)[foreign->number_of(j)];
    }

    std::vector<Pair> pairs_;
};

} // namespace spate
