// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What terms keep of a pair, carried from one set of neighbour lists to the next: by the ids of the two
/// particles, so that sorting does not matter. Nothing is stored for a pair whose memory is zero.
#pragma once

#include "spate/cells/neighbours.hpp"

#include <algorithm>
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
    template <int Dim, class P, class Q, class Workers>
    void take(Lists<Dim> const& lists, std::vector<Array<T>> const& memory, P const& target, Binning<Dim> const& at,
              Q const& source, Binning<Dim> const& of, int W, Workers const& backend)
    {
        // One place a target: by its id, or by its number where ids are few among many and pairs are sorted at the end.
        std::uint32_t largest = 0;
        for (auto id : target.id()) largest = std::max(largest, id);
        dense_ = largest < 8 * target.size() + 1024;
        first_.assign((dense_ ? std::size_t(largest) + 1 : target.size()) + 1, 0);
        auto each = [&](auto const& f) {
            backend.for_each(memory.size(), [&](std::size_t cell) {
                T const* const values = memory[cell].data();
                each_slot(
                    lists.of_cell(cell), W, [&](std::size_t slot, std::size_t row, std::size_t lane, std::int32_t t) {
                        bool any = false;
                        for (int c = 0; c < Count; ++c) any = any || values[place(row, c, W) + lane] != T(0);
                        if (!any) return;
                        const std::size_t j = number_of(lists, lists.of_cell(cell).index[slot], source.size(), of);
                        if (j == source.size()) return;
                        const auto i = std::size_t(at.begin(cell) + t);
                        f(dense_ ? std::size_t(target.id()[i]) : i, i, j, values + place(row, 0, W) + lane);
                    });
            });
        };
        each([&](std::size_t k, std::size_t, std::size_t, T const*) { ++first_[k + 1]; }); // a target is in one cell
        for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
        pairs_.resize(first_.back());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        each([&](std::size_t k, std::size_t i, std::size_t j, T const* values) {
            Pair& p = pairs_[next[k]++];
            p.i = target.id()[i], p.j = source.id()[j];
            for (int c = 0; c < Count; ++c) p.value[std::size_t(c)] = values[c * W];
        });
        if (!dense_) std::sort(pairs_.begin(), pairs_.end(), before);
        else
            for (std::size_t k = 0; k + 1 < first_.size(); ++k)
                std::sort(pairs_.begin() + std::ptrdiff_t(first_[k]), pairs_.begin() + std::ptrdiff_t(first_[k + 1]),
                          before);
    }
    /// Gives it back to new lists; pairs that are in no list any more are forgotten, new ones begin at zero.
    template <int Dim, class P, class Q, class Workers>
    void give(Lists<Dim> const& lists, std::vector<Array<T>>& memory, P const& target, Binning<Dim> const& at,
              Q const& source, Binning<Dim> const& of, int W, Workers const& backend) const
    {
        memory.resize(at.cells());
        backend.for_each(memory.size(), [&](std::size_t cell) {
            auto& values = memory[cell];
            values.assign(lists.of_cell(cell).index.size() * std::size_t(Count), T(0));
            each_slot(lists.of_cell(cell), W, [&](std::size_t slot, std::size_t row, std::size_t lane, std::int32_t t) {
                const std::uint32_t i = target.id()[std::size_t(at.begin(cell) + t)];
                const auto [first, last] = of_target(i);
                if (first == last) return;
                const std::size_t j = number_of(lists, lists.of_cell(cell).index[slot], source.size(), of);
                if (j == source.size()) return;
                const auto found = std::lower_bound(first, last, Pair{i, source.id()[j], {}}, before);
                if (found == last || found->j != source.id()[j]) return;
                for (int c = 0; c < Count; ++c) values[place(row, c, W) + lane] = found->value[std::size_t(c)];
            });
        });
    }
    [[nodiscard]] std::size_t bytes() const
    {
        return pairs_.capacity() * sizeof(Pair) + first_.capacity() * sizeof(std::size_t);
    }
    [[nodiscard]] std::vector<Pair> const& pairs() const { return pairs_; }
    /// Drops the pairs for which gone(i, j) holds.
    void forget(auto const& gone)
    {
        pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(), [&](Pair const& p) { return gone(p.i, p.j); }),
                     pairs_.end());
        dense_ = false;
    }
    /// Nothing is aside any more.
    void clear() { pairs_.clear(), dense_ = false; }

    /// Where component c of a row of W slots begins.
    static std::size_t place(std::size_t row, int c, int W)
    {
        return (row * std::size_t(Count) + std::size_t(c)) * std::size_t(W);
    }

private:
    static bool before(Pair const& a, Pair const& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; }
    /// Those of the target with id i.
    auto of_target(std::uint32_t i) const
    {
        auto at = [&](std::size_t k) { return pairs_.begin() + std::ptrdiff_t(k); };
        if (dense_) {
            const bool known = std::size_t(i) + 1 < first_.size();
            return std::pair{known ? at(first_[i]) : pairs_.end(), known ? at(first_[i + 1]) : pairs_.end()};
        }
        return std::pair{std::lower_bound(pairs_.begin(), pairs_.end(), Pair{i, 0, {}}, before),
                         std::upper_bound(pairs_.begin(), pairs_.end(), Pair{i, ~std::uint32_t(0), {}}, before)};
    }
    /// f(slot, row, lane, target in the cell) for each entry of a cell's lists.
    static void each_slot(CellLists const& lists, int W, auto const& f)
    {
        for (std::size_t b = 0; b + 1 < lists.begin.size(); ++b)
            for (auto row = std::size_t(lists.begin[b]); row < std::size_t(lists.begin[b + 1]); ++row)
                for (std::size_t lane = 0; lane < std::size_t(W); ++lane)
                    f(row * std::size_t(W) + lane, row, lane, lists.target[b * std::size_t(W) + lane]);
    }
    /// The particle behind an entry: of an image the particle itself; the number of particles for the sentinel.
    template <int Dim>
    static std::size_t number_of(Lists<Dim> const& lists, std::int32_t entry, std::size_t n, Binning<Dim> const& of)
    {
        const std::size_t j = lists.number(entry);
        return j <= n ? j : std::size_t(of.images().of[j - n - 1]);
    }

    std::vector<Pair> pairs_;
    std::vector<std::size_t> first_; ///< pair of the target with an id
    bool dense_ = true;              ///< ids are nearly all there
};

} // namespace spate
