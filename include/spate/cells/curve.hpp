// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Where a cell lies on Hilbert's curve: a stretch of the curve is a compact piece of space.
#pragma once

#include "spate/cells/grid.hpp"

#include <cstdint>

namespace spate {

/// What is added to the index of a cell: bits 0101..., so that the origin lies near no corner of a large cube of the curve.
/// The cells of a domain about the origin, as walls make it, are one short stretch of keys, and cuts are found soon.
inline constexpr std::int32_t curve_origin = 0x55555;

/// Hilbert's curve through the cells (Skilling, "Programming the Hilbert curve", 2004: the transpose of the key, then its
/// bits one after the other).
template <int Dim>
[[nodiscard]] constexpr std::uint64_t along_curve(Index<Dim> const& cell)
{
    constexpr int bits = 21; // of an index along an axis, as in Binning
    constexpr auto n = std::size_t(Dim);
    std::uint32_t x[n] = {};
    for (std::size_t c = 0; c < n; ++c) x[c] = std::uint32_t(cell[c] + curve_origin) & ((1u << bits) - 1);
    for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) { // undo excess work
        const std::uint32_t p = q - 1;
        for (std::size_t c = 0; c < n; ++c) {
            if ((x[c] & q) != 0) x[0] ^= p; // invert
            else {                          // exchange
                const std::uint32_t t = (x[0] ^ x[c]) & p;
                x[0] ^= t, x[c] ^= t;
            }
        }
    }
    for (std::size_t c = 1; c < n; ++c) x[c] ^= x[c - 1]; // Gray encode
    std::uint32_t t = 0;
    for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1)
        if ((x[n - 1] & q) != 0) t ^= q - 1;
    std::uint64_t key = 0;
    for (int b = bits - 1; b >= 0; --b)
        for (std::size_t c = 0; c < n; ++c) key = (key << 1) | (((x[c] ^ t) >> b) & 1);
    return key;
}

} // namespace spate
