// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What terms keep of a pair, carried from one set of neighbour lists to the next: by the ids of the two
/// particles, so that sorting does not matter. Nothing is stored for a pair whose memory is zero.
#pragma once

#include "spate/cells/kept_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <vector>

namespace spate {

/// The memory of the directed pairs target <- source, aside while lists are rebuilt.
/// \tparam Count  values a pair
template <Real T, int Count>
class PairMemory {
public:
    using Kept = KeptPairs<T, Count>;
    struct Pair {
        std::uint32_t i, j; ///< ids of target and source
        std::array<T, std::size_t(Count)> value;
    };

    /// Takes what the lists hold.
    template <int Dim, class P, class Q, class Workers>
    void take(Lists<Dim> const& lists, std::vector<Kept> const& memory, P const& target, Binning<Dim> const& at,
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
                auto const& kept = memory[cell];
                auto const& list = lists.of_cell(cell);
                for (std::size_t b = 0; b + 1 < list.begin.size(); ++b) {
                    T const* values = kept.of(b); // of a row
                    for (auto row = std::size_t(list.begin[b]); row < std::size_t(list.begin[b + 1]); ++row) {
                        const auto here = Kept::count(kept.set[row]);
                        std::size_t n = 0;
                        for (unsigned set = kept.set[row]; set != 0; set &= set - 1, ++n) {
                            bool any = false;
                            for (std::size_t c = 0; c < std::size_t(Count); ++c) {
                                const T value = values[c * here + n];
                                any = any || value != T(0) || std::signbit(value);
                            }
                            if (!any) continue;
                            const auto lane = std::size_t(std::countr_zero(set));
                            const std::size_t j = lists.number(list.index[row * std::size_t(W) + lane]);
                            const std::int32_t t = list.target_of(b * std::size_t(W) + lane);
                            if (j != source.size()) f(std::size_t(at.begin(cell) + t), j, values + n, here);
                        }
                        values += here * std::size_t(Count);
                    }
                }
            });
        };
        each([&](std::size_t i, std::size_t, T const*, std::size_t) {
            ++next[place_of(i) + 1];
        }); // a target is in one cell
        for (std::size_t k = 1; k < next.size(); ++k) next[k] += next[k - 1];
        pairs_.resize(next.back());
        each([&](std::size_t i, std::size_t j, T const* values, std::size_t stride) {
            Pair& p = pairs_[next[place_of(i)]++];
            p.i = target.id()[i], p.j = id_of(j, source, of, foreign);
            for (std::size_t c = 0; c < std::size_t(Count); ++c) p.value[c] = values[c * stride];
        });
        if (!dense) std::sort(pairs_.begin(), pairs_.end(), before);
        else
            for (std::size_t k = 0, first = 0; k + 1 < next.size(); first = next[k++]) // where k now ends
                std::sort(pairs_.begin() + std::ptrdiff_t(first), pairs_.begin() + std::ptrdiff_t(next[k]), before);
    }
    /// Gives it back to new lists; pairs that are in no list any more are forgotten, new ones begin at zero.
    template <int Dim, class P, class Q, class Workers>
    void give(Lists<Dim> const& lists, std::vector<Kept>& memory, P const& target, Binning<Dim> const& at,
              Q const& source, Binning<Dim> const& of, int W, Workers const& backend,
              std::optional<Foreign<Dim, T>> const& foreign = {}) const
    {
        memory.resize(at.cells());
        const auto first_of = index();
        const Numbers numbers(source.id(), foreign);
        const std::int32_t nobody = lists.place(source.size());
        backend.for_each(memory.size(), [&](std::size_t cell) {
            auto& kept = memory[cell];
            auto const& list = lists.of_cell(cell);
            static thread_local Array<T> all;               // the cell's own is then as long as need be
            static thread_local std::vector<Wanted> wanted; // of a block: the k-th of each lane
            all.clear();
            kept.set.assign(list.begin.empty() ? 0 : std::size_t(list.begin.back()), 0);
            kept.first.assign(1, 0);
            for (std::size_t b = 0; b + 1 < list.begin.size(); ++b) {
                wanted.clear();
                for (std::size_t lane = 0; lane < std::size_t(W); ++lane) {
                    const std::int32_t t = list.target_of(b * std::size_t(W) + lane);
                    const auto [first, last] = of_target(target.id()[std::size_t(at.begin(cell) + t)], first_of);
                    while (wanted.size() < std::size_t(last - first)) wanted.emplace_back();
                    for (auto p = first; p != last; ++p) {
                        auto& w = wanted[std::size_t(p - first)];
                        w.pair[lane] = &*p;
                        if (const auto j = numbers.of(p->j); j >= 0) w.place[lane] = lists.place(std::size_t(j));
                    }
                }
                std::size_t pairs = 0;
                for (auto row = std::size_t(list.begin[b]); row < std::size_t(list.begin[b + 1]); ++row) {
                    Places who;
                    std::int32_t last = 0;
                    for (std::size_t lane = 0; lane < std::size_t(W); ++lane) {
                        who[lane] = list.index[row * std::size_t(W) + lane];
                        last = std::max(last, who[lane]);
                    }
                    if (last > nobody)
                        for (std::size_t lane = 0; lane < std::size_t(W); ++lane)
                            who[lane] = lists.place(particle_of(lists.number(who[lane]), source.size(), of, foreign));
                    Places which{}; // of those wanted, and one: without a branch, for there is no telling
                    for (std::size_t k = 0; k < wanted.size(); ++k)
                        for (std::size_t lane = 0; lane < std::size_t(W); ++lane)
                            which[lane] = who[lane] == wanted[k].place[lane] ? std::int32_t(k + 1) : which[lane];
                    std::array<Pair const*, most> found;
                    std::size_t n = 0;
                    for (std::size_t lane = 0; lane < std::size_t(W); ++lane) {
                        if (which[lane] == 0) continue;
                        kept.set[row] = typename Kept::Set(kept.set[row] | 1u << lane);
                        found[n++] = wanted[std::size_t(which[lane] - 1)].pair[lane];
                    }
                    for (std::size_t c = 0; c < std::size_t(Count); ++c)
                        for (std::size_t k = 0; k < n; ++k) all.push_back(found[k]->value[c]);
                    pairs += n;
                }
                all.insert(all.end(), Kept::spare * std::size_t(Count), T(0));
                kept.first.push_back(kept.first.back() + std::int32_t(pairs + Kept::spare));
            }
            if (kept.value.capacity() > all.size() + all.size() / 64) Array<T>().swap(kept.value);
            kept.value.reserve(1 + all.size()); // rows without any may look at the first value
            kept.value.assign(all.begin(), all.end());
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
    /// Its number, of own particles and then of others', of a record: of an image that of the particle itself.
    template <int Dim>
    static std::size_t particle_of(std::size_t record, std::size_t own, Binning<Dim> const& of,
                                   std::optional<Foreign<Dim, T>> const& foreign)
    {
        if (record <= own) return record; // or nobody
        if (!foreign || record < std::size_t(foreign->first)) return std::size_t(of.images().of[record - own - 1]);
        return std::size_t(foreign->first) + foreign->number_of(record);
    }
    template <int Dim, class Q>
    static std::uint32_t id_of(std::size_t record, Q const& source, Binning<Dim> const& of,
                               std::optional<Foreign<Dim, T>> const& foreign)
    {
        const std::size_t j = particle_of(record, source.size(), of, foreign);
        return j < source.size() ? source.id()[j] : foreign->ids[j - std::size_t(foreign->first)];
    }
    /// From ids to these numbers.
    class Numbers {
    public:
        template <int Dim>
        Numbers(std::vector<std::uint32_t> const& own, std::optional<Foreign<Dim, T>> const& foreign)
        {
            std::size_t n = own.size(), largest = 0;
            for (auto id : own) largest = std::max(largest, std::size_t(id));
            if (foreign) n += foreign->ids.size();
            if (foreign)
                for (auto id : foreign->ids) largest = std::max(largest, std::size_t(id));
            if (largest < 8 * n + 1024) dense_.assign(largest + 1, -1);
            else sparse_.reserve(n);
            for (std::size_t i = 0; i < own.size(); ++i) put(own[i], i);
            if (foreign)
                for (std::size_t i = 0; i < foreign->ids.size(); ++i)
                    put(foreign->ids[i], std::size_t(foreign->first) + i);
        }
        /// -1 where nobody here has the id.
        [[nodiscard]] std::int32_t of(std::uint32_t id) const
        {
            if (!dense_.empty()) return id < dense_.size() ? dense_[id] : -1;
            const auto found = sparse_.find(id);
            return found == sparse_.end() ? -1 : found->second;
        }

    private:
        void put(std::uint32_t id, std::size_t number)
        {
            if (!dense_.empty()) dense_[id] = std::int32_t(number);
            else sparse_[id] = std::int32_t(number);
        }
        std::vector<std::int32_t> dense_;
        std::unordered_map<std::uint32_t, std::int32_t> sparse_;
    };
    static constexpr std::size_t most = 64; ///< lanes
    using Places = std::array<std::int32_t, most>;
    /// One pair of each lane, and the place of its source in lists; -1 where there is none.
    struct Wanted {
        Wanted() { place.fill(-1); }
        Places place;
        std::array<Pair const*, most> pair{};
    };

    std::vector<Pair> pairs_;
};

} // namespace spate
