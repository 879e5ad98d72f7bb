// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The rows of all ranks in one order, cut into as many stretches as there are ranks, of like numbers of rows: each
///        rank gets one, and none ever holds the whole. Not what the rows are: io/detail/rows_of_ranks.hpp, io/vtkhdf.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "spate/io/any_ranks.hpp"

namespace spate::io::detail {

/// The order of rows: the first word counts most. No two rows have the same.
using Key = std::array<std::uint32_t, 3>;

/// In the order of whole numbers.
constexpr std::uint32_t key_word(std::int32_t x) { return std::uint32_t(x) ^ 0x80000000u; }
constexpr std::uint32_t key_word(std::uint32_t x) { return x; }

/// Of rows of one to three whole numbers.
template <class T>
[[gnu::cold]] std::vector<Key> keys_of(std::vector<T> const& rows, std::size_t columns)
{
    std::vector<Key> keys(rows.size() / columns, Key{});
    for (std::size_t k = 0; k < keys.size(); ++k)
        for (std::size_t c = 0; c < columns; ++c) keys[k][c] = key_word(rows[k * columns + c]);
    return keys;
}

/// Where a stretch is in the whole [rows].
struct Where {
    std::uint64_t first = 0, total = 0;
};

class Stretches {
public:
    /// All ranks call it, and what is below. \param keys  of the rows that are here    \param words  of a key that differ
    [[gnu::cold]] Stretches(AnyRanks const& ranks, std::vector<Key> const& keys, std::size_t words)
        : ranks_(ranks), leaves_(in_order(keys)), where_{0, keys.size()}
    {
        if (ranks.count() == 1) return;
        std::vector<Key> sorted(keys.size());
        std::transform(leaves_.begin(), leaves_.end(), sorted.begin(), [&](std::size_t k) { return keys[k]; });
        cut(sorted, words);
        comes_ = in_order(exchanged<Key>(keys, 1));
    }
    /// Of a table whose rows go with the keys, those of this rank's stretch.
    template <class T>
    [[gnu::cold]] [[nodiscard]] std::vector<T> operator()(std::vector<T> const& rows, std::size_t columns) const
    {
        if (ranks_.count() == 1) return picked<T>(rows, columns, leaves_);
        return picked<T>(exchanged<T>(rows, columns), columns, comes_);
    }
    [[nodiscard]] Where where() const { return where_; }

private:
    [[gnu::cold]] static std::vector<std::size_t> in_order(std::vector<Key> const& keys)
    {
        std::vector<std::size_t> order(keys.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
        return order;
    }
    template <class T>
    [[gnu::cold]] static std::vector<T> picked(std::span<T const> rows, std::size_t columns,
                                               std::span<std::size_t const> which)
    {
        std::vector<T> some;
        some.reserve(which.size() * columns);
        for (const std::size_t k : which)
            some.insert(some.end(), rows.begin() + std::ptrdiff_t(k * columns),
                        rows.begin() + std::ptrdiff_t((k + 1) * columns));
        return some;
    }
    /// Finds the least key of each stretch, four bits at a time: the largest below which there are no more rows than are due
    /// to the ranks before. So shares are alike whatever ids are left. \param sorted  keys of the rows here
    [[gnu::cold]] void cut(std::vector<Key> const& sorted, std::size_t words)
    {
        auto below = [&](Key const& key) {
            return std::size_t(std::lower_bound(sorted.begin(), sorted.end(), key) - sorted.begin());
        };
        const auto ranks = std::size_t(ranks_.count());
        std::vector<std::uint64_t> count{sorted.size()};
        ranks_.sum(count);
        where_.total = count[0];
        std::vector<Key> least(ranks, Key{});
        constexpr std::uint32_t digits = 15; // that are not 0
        for (std::size_t word = 0; word < words; ++word)
            for (int shift = 28; shift >= 0; shift -= 4) {
                count.clear();
                for (std::size_t r = 1; r < ranks; ++r)
                    for (std::uint32_t digit = 1; digit <= digits; ++digit) {
                        Key key = least[r];
                        key[word] |= digit << shift;
                        count.push_back(below(key));
                    }
                ranks_.sum(count);
                auto rows = count.begin();
                for (std::size_t r = 1; r < ranks; ++r, rows += digits) {
                    const std::uint64_t due = where_.total * r / ranks;
                    const auto fits = std::upper_bound(rows, rows + digits, due) - rows;
                    least[r][word] |= std::uint32_t(fits) << shift;
                }
            }
        begin_.clear();
        for (Key const& key : least) begin_.push_back(below(key));
        begin_.push_back(sorted.size());
        count.assign(begin_.begin(), begin_.end());
        ranks_.sum(count);
        where_.first = count[std::size_t(ranks_.rank())];
    }
    /// What comes, by the rank that it comes from.
    template <class T>
    [[gnu::cold]] std::vector<T> exchanged(std::span<T const> rows, std::size_t columns) const
    {
        std::vector<Parcel> parcels;
        for (std::size_t r = 0; r + 1 < begin_.size(); ++r) {
            if (begin_[r] == begin_[r + 1]) continue;
            const auto which = std::span(leaves_).subspan(begin_[r], begin_[r + 1] - begin_[r]);
            parcels.push_back({int(r), {}});
            parcels.back().message.put(picked(rows, columns, which));
        }
        std::vector<T> mine;
        parcels = ranks_.scatter(std::move(parcels));
        std::size_t bytes = 0;
        for (auto const& p : parcels) bytes += p.message.bytes().size();
        mine.reserve(bytes / sizeof(T));
        for (auto& p : parcels) {
            const auto before = mine.size();
            mine.resize(before + std::size_t(p.message.template take<std::uint64_t>()));
            p.message.take(std::span(mine).subspan(before));
        }
        return mine;
    }

    AnyRanks const& ranks_;
    std::vector<std::size_t> leaves_; ///< rows that are here, in order
    std::vector<std::size_t> begin_;  ///< by rank, and the end: of those that go there
    std::vector<std::size_t> comes_;  ///< rows that come, in order
    Where where_;
};

} // namespace spate::io::detail
