// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What terms keep of the pairs in the neighbour lists of a cell: of those that touch, and of no others.
#pragma once

#include "spate/cells/neighbours.hpp"

#include <bit>
#include <cstdint>

namespace spate {

/// Values lie row after row as the lists do, in a row component by component, of the lanes that touch: one stream.
/// \tparam Count  values a pair
template <Real T, int Count>
struct KeptPairs {
    using Set = std::uint16_t;              ///< a bit for each lane
    static constexpr std::size_t spare = 2; ///< pairs that a block of new lists has room for beyond those that touch
    std::vector<Set> set;                   ///< of each row of the lists: the lanes that touch
    std::vector<std::int32_t> first;        ///< of each block: the pairs that there is room for before it; and of all
    Array<T> value;

    [[nodiscard]] static std::size_t count(Set set) { return std::size_t(std::popcount(set)); }
    [[nodiscard]] std::size_t room(std::size_t block) const { return std::size_t(first[block + 1] - first[block]); }
    /// Values of the first row of a block.
    [[nodiscard]] T* of(std::size_t block) { return value.data() + std::size_t(first[block]) * std::size_t(Count); }
    [[nodiscard]] T const* of(std::size_t block) const
    {
        return value.data() + std::size_t(first[block]) * std::size_t(Count);
    }
    /// Component 0 of the pair in a lane of a row of a block, component c is at c * count(set[row]); nothing where it does
    /// not touch.
    [[nodiscard]] T const* find(CellLists const& lists, std::size_t block, std::size_t row, std::size_t lane) const
    {
        if (((set[row] >> lane) & 1) == 0) return nullptr;
        std::size_t n = 0;
        for (auto r = std::size_t(lists.begin[block]); r < row; ++r) n += count(set[r]);
        return of(block) + n * std::size_t(Count) + count(Set(set[row] & ((1u << lane) - 1)));
    }
    /// Room for n pairs in a block, and those that it has.
    [[gnu::noinline]] void grow(std::size_t block, std::size_t n)
    {
        constexpr std::size_t some = 4; // contacts come and go
        const std::size_t more = (n + some - 1) / some * some - room(block), values = more * std::size_t(Count);
        if (value.size() + values > value.capacity()) // not twice as much
            value.reserve(value.size() + value.size() / 64 + values);
        value.insert(value.begin() + std::ptrdiff_t(first[block + 1]) * Count, values, T(0));
        for (std::size_t b = block + 1; b < first.size(); ++b) first[b] += std::int32_t(more);
    }
    [[nodiscard]] std::size_t bytes() const
    {
        return set.capacity() * sizeof(Set) + first.capacity() * 4 + value.capacity() * sizeof(T);
    }
};
/// Of all cells; where nothing is kept, nothing.
struct NothingKept {};
template <Real T, int Count>
using KeptOfCells = std::conditional_t<Count == 0, NothingKept, std::vector<KeptPairs<T, Count>>>;

} // namespace spate
