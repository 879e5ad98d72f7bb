// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Who owns which cell: cells lie on a curve, each rank owns a stretch of it. The cuts are all that a rank knows of
/// the others' shares.
#pragma once

#include "spate/cells/curve.hpp"
#include "spate/core/ranks.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace spate {

/// What a cell costs, in whole units: sums over ranks are exact.
struct CellCost {
    std::uint64_t key; ///< along the curve
    std::int64_t cost;
};

template <int Dim>
class Shares {
public:
    /// All to rank 0.
    Shares() = default;
    /// Rank r owns the keys from first[r] to first[r + 1]; first[0] is 0.
    explicit Shares(std::vector<std::uint64_t> first) : first_(std::move(first)) {}

    [[nodiscard]] int owner(Index<Dim> const& cell) const { return owner_of(along_curve<Dim>(cell)); }
    [[nodiscard]] int owner_of(std::uint64_t key) const
    {
        return int(std::upper_bound(first_.begin(), first_.end(), key) - first_.begin()) - 1;
    }
    [[nodiscard]] std::vector<std::uint64_t> const& first() const { return first_; }
    friend bool operator==(Shares const&, Shares const&) = default;

    struct Anew;
    /// The same as of_like_cost where each rank brings the cells that these shares give it, and no others: two sums of a
    /// value or two for each rank, since a rank then knows which of the new cuts are in its own stretch.
    template <class R>
    [[nodiscard]] Anew cut_anew(std::vector<CellCost> mine, R const& ranks) const;

    /// Cuts the curve into shares of like cost; of all ranks' costs together.
    template <class R>
    [[nodiscard]] static Shares of_like_cost(std::vector<CellCost> mine, R const& ranks)
    {
        std::sort(mine.begin(), mine.end(), [](auto const& a, auto const& b) { return a.key < b.key; });
        std::vector<std::int64_t> before{0}; // cost of those before the k-th
        for (auto const& c : mine) before.push_back(before.back() + c.cost);
        const auto total = ranks.all(before.back(), agree::Sum{});
        const auto least = ranks.all(mine.empty() ? ~std::uint64_t(0) : mine.front().key, agree::Least{});
        const auto most = ranks.all(mine.empty() ? std::uint64_t(0) : mine.back().key, agree::Most{});
        const auto cuts = std::size_t(ranks.count());
        std::vector<std::uint64_t> low(cuts, least), high(cuts, most + 1); // low: too little lies before it
        low[0] = high[0] = 0;
        auto too_little = [&](std::size_t r, std::int64_t cost) { return is_too_little(r, cost, total, cuts); };
        std::vector<std::int64_t> cost(cuts);
        while (true) { // every rank sees the same numbers and leaves at the same turn
            bool open = false;
            for (std::size_t r = 1; r < cuts; ++r) {
                cost[r] = 0;
                if (low[r] >= high[r]) continue;
                open = true;
                const std::uint64_t middle = low[r] + (high[r] - low[r]) / 2;
                if (mine.empty() || middle <= mine.front().key) continue; // most cuts are far from here
                const auto k = middle > mine.back().key
                                   ? mine.end()
                                   : std::lower_bound(mine.begin(), mine.end(), middle,
                                                      [](auto const& a, std::uint64_t key) { return a.key < key; });
                cost[r] = before[std::size_t(k - mine.begin())];
            }
            if (!open) break;
            ranks.each(cost, agree::Sum{});
            for (std::size_t r = 1; r < cuts; ++r) {
                if (low[r] >= high[r]) continue;
                const std::uint64_t middle = low[r] + (high[r] - low[r]) / 2;
                if (too_little(r, cost[r])) low[r] = middle + 1;
                else high[r] = middle;
            }
        }
        return Shares(std::move(low));
    }

private:
    /// Whether `cost` of `total` is less than what lies before cut r of so many shares.
    static bool is_too_little(std::size_t r, std::int64_t cost, std::int64_t total, std::size_t shares)
    {
        return double(cost) * double(shares) < double(total) * double(r) - 0.5;
    }
    /// A cut and the cost before it, known to one rank; zero elsewhere.
    struct Cut {
        std::uint64_t key = 0;
        std::int64_t before = 0;
        Cut& operator+=(Cut const& b)
        {
            key += b.key, before += b.before;
            return *this;
        }
    };
    std::vector<std::uint64_t> first_{0};
};

template <int Dim>
struct Shares<Dim>::Anew {
    Shares shares;
    std::int64_t dearest = 0; ///< the largest cost of a share
};

template <int Dim>
template <class R>
auto Shares<Dim>::cut_anew(std::vector<CellCost> mine, R const& ranks) const -> Anew
{
    std::sort(mine.begin(), mine.end(), [](auto const& a, auto const& b) { return a.key < b.key; });
    const auto count = std::size_t(ranks.count()), me = std::size_t(ranks.rank());
    std::vector<std::int64_t> to(count, 0); // what all ranks up to the k-th have
    for (auto const& c : mine) to[me] += c.cost;
    ranks.each(to, agree::Sum{});
    std::partial_sum(to.begin(), to.end(), to.begin());
    const std::int64_t total = to.back();
    if (total == 0) return {*this};
    std::vector<Cut> cut(count);
    std::int64_t before = me > 0 ? to[me - 1] : 0;
    auto cell = mine.begin();
    for (std::size_t r = 1; r < count; ++r) {
        if (me > 0 && !is_too_little(r, to[me - 1], total, count)) continue; // of a rank before
        if (is_too_little(r, to[me], total, count)) break;                   // ... after this one
        while (is_too_little(r, before + cell->cost, total, count)) before += cell->cost, ++cell;
        cut[r] = {cell->key + 1, before + cell->cost};
        for (auto next = cell + 1; next != mine.end() && next->key == cell->key; ++next) cut[r].before += next->cost;
    }
    ranks.each(cut, agree::Sum{});
    Anew anew{Shares(std::vector<std::uint64_t>(count, 0))};
    for (std::size_t r = 0; r < count; ++r) {
        anew.shares.first_[r] = cut[r].key;
        anew.dearest = std::max(anew.dearest, (r + 1 < count ? cut[r + 1].before : total) - cut[r].before);
    }
    return anew;
}

} // namespace spate
