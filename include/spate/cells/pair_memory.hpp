// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What terms keep of a pair, carried from one set of neighbour lists to the next: by the ids of the two
/// particles, so that sorting does not matter. Nothing is stored for a pair whose memory is zero.
#pragma once

#include "spate/cells/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
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
              Q const& source, Binning<Dim> const& of, int W, Workers const& backend,
              std::optional<Foreign<Dim, T>> const& foreign = {})
    {
        // A place for each target: by its id, or by its number where ids are few among many.
        std::uint32_t largest = 0;
        for (auto id : target.id()) largest = std::max(largest, id);
        const bool dense = largest < 8 * target.size() + 1024;
        std::vector<std::size_t> next((dense ? std::size_t(largest) + 1 : target.size()) + 1, 0);
        auto place_of = [&](std::size_t i) { return dense ? std::size_t(target.id()[i]) : i; };
        auto each = [&](auto const& f) {
            backend.for_each(memory.size(), [&](std::size_t cell) {
                T const* const values = memory[cell].data();
                each_slot(lists.of_cell(cell), W, [&](std::size_t slot, std::size_t row, std::size_t lane, auto t) {
                    bool any = false;
                    for (int c = 0; c < Count; ++c) {
                        const T value = values[place(row, c, W) + lane];
                        any = any || value != T(0) || std::signbit(value);
                    }
                    const std::size_t j = any ? lists.number(lists.of_cell(cell).index[slot]) : source.size();
                    if (j == source.size()) return;
                    f(std::size_t(at.begin(cell) + t), j, values + place(row, 0, W) + lane);
                });
            });
        };
        each([&](std::size_t i, std::size_t, T const*) { ++next[place_of(i) + 1]; }); // a target is in one cell
        for (std::size_t k = 1; k < next.size(); ++k) next[k] += next[k - 1];
        pairs_.resize(next.back());
        each([&](std::size_t i, std::size_t j, T const* values) {
            Pair& p = pairs_[next[place_of(i)]++];
            p.i = target.id()[i], p.j = id_of(j, source, of, foreign);
            for (int c = 0; c < Count; ++c) p.value[std::size_t(c)] = values[std::ptrdiff_t(c) * W];
        });
        if (!dense) std::sort(pairs_.begin(), pairs_.end(), before);
        else
            for (std::size_t k = 0, first = 0; k + 1 < next.size(); first = next[k++]) // where k now ends
                std::sort(pairs_.begin() + std::ptrdiff_t(first), pairs_.begin() + std::ptrdiff_t(next[k]), before);
    }
    /// Gives it back to new lists; pairs that are in no list any more are forgotten, new ones begin at zero.
    template <int Dim, class P, class Q, class Workers>
    void give(Lists<Dim> const& lists, std::vector<Array<T>>& memory, P const& target, Binning<Dim> const& at,
              Q const& source, Binning<Dim> const& of, int W, Workers const& backend,
              std::optional<Foreign<Dim, T>> const& foreign = {}) const
    {
        memory.resize(at.cells());
        const auto first_of = index();
        backend.for_each(memory.size(), [&](std::size_t cell) {
            auto& values = memory[cell];
            values.assign(lists.of_cell(cell).index.size() * std::size_t(Count), T(0));
            std::int32_t last = -1;
            auto range = of_target(0, first_of);
            each_slot(lists.of_cell(cell), W, [&](std::size_t slot, std::size_t row, std::size_t lane, std::int32_t t) {
                const std::uint32_t i = target.id()[std::size_t(at.begin(cell) + t)];
                if (t != last) range = of_target(i, first_of), last = t;
                if (range.first == range.second) return;
                const std::size_t j = lists.number(lists.of_cell(cell).index[slot]);
                if (j == source.size()) return;
                const std::uint32_t id = id_of(j, source, of, foreign);
                const auto found = std::lower_bound(range.first, range.second, Pair{i, id, {}}, before);
                if (found == range.second || found->j != id) return;
                for (int c = 0; c < Count; ++c) values[place(row, c, W) + lane] = found->value[std::size_t(c)];
            });
        });
    }
    [[nodiscard]] std::size_t bytes() const { return pairs_.capacity() * sizeof(Pair); }
    [[nodiscard]] std::vector<Pair> const& pairs() const { return pairs_; }
    /// The pairs whose target goes elsewhere are no more here; leave(pair) says so and sees to them.
    void part(auto const& leave)
    {
        std::erase_if(pairs_, [&](Pair const& p) { return leave(p); });
    }
    /// Drops the pairs for which gone(i, j) holds.
    void forget(auto const& gone)
    {
        std::erase_if(pairs_, [&](Pair const& p) { return gone(p.i, p.j); });
    }
    void join(std::vector<Pair> const& pairs)
    {
        pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
        std::sort(pairs_.begin(), pairs_.end(), before);
    }
    /// What was taken at another time; sorted by ids.
    void put(std::vector<Pair> pairs) { pairs_ = std::move(pairs); }
    /// Nothing is aside any more, and no room is kept for it: it would be a fifth of all memory.
    void clear() { std::vector<Pair>().swap(pairs_); }

    /// Where component c of a row of W slots begins.
    static std::size_t place(std::size_t row, int c, int W)
    {
        return (row * std::size_t(Count) + std::size_t(c)) * std::size_t(W);
    }

private:
    static bool before(Pair const& a, Pair const& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; }
    /// Where the pairs of each target begin, by its id; empty where ids are few among many.
    [[nodiscard]] std::vector<std::size_t> index() const
    {
        std::vector<std::size_t> first;
        if (pairs_.empty() || pairs_.back().i >= 8 * pairs_.size() + 1024) return first;
        first.assign(std::size_t(pairs_.back().i) + 2, 0);
        for (auto const& p : pairs_) ++first[p.i + 1];
        for (std::size_t k = 1; k < first.size(); ++k) first[k] += first[k - 1];
        return first;
    }
    /// Those of the target with id i.
    auto of_target(std::uint32_t i, std::vector<std::size_t> const& first_of) const
    {
        auto at = [&](std::size_t k) { return pairs_.begin() + std::ptrdiff_t(k); };
        if (!first_of.empty()) {
            const bool known = std::size_t(i) + 1 < first_of.size();
            return std::pair{known ? at(first_of[i]) : pairs_.end(), known ? at(first_of[i + 1]) : pairs_.end()};
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
    /// The particle behind a record other than the sentinel: of an image the particle itself.
    template <int Dim, class Q>
    static std::uint32_t id_of(std::size_t j, Q const& source, Binning<Dim> const& of,
                               std::optional<Foreign<Dim, T>> const& foreign)
    {
        const std::size_t n = source.size();
        if (j < n) return source.id()[j];
        if (!foreign || j < std::size_t(foreign->first)) return source.id()[std::size_t(of.images().of[j - n - 1])];
        return foreign->ids[foreign->number_of(j)];
    }

    std::vector<Pair> pairs_;
};

} // namespace spate
