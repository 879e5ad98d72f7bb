// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A walk over the pairs that neighbour lists hold, one at a time: for looks that are rare.
#pragma once

#include "spate/core/fields.hpp"
#include "spate/core/pack.hpp"
#include "spate/core/vec.hpp"

#include <algorithm>

namespace spate {

/// f(i, j, x) for each directed pair of mobile particles in the lists; x = x_i - x_j of the images that meet [m]. On many
/// ranks pairs with another's particle are left out.
template <class S>
[[gnu::cold]] void each_listed_pair(S const& system, auto const& f)
{
    auto const& p = system.mobile();
    auto const& bins = system.template species<0>().bins;
    auto const& lists = system.template lists<0, 0>();
    auto const& images = bins.images();
    constexpr auto W = std::size_t(width<typename S::V>);
    const std::size_t n = p.size();
    for (std::size_t cell = 0; cell < bins.cells(); ++cell) {
        auto const& mine = lists.of_cell(cell);
        const auto first = std::size_t(bins.begin(cell));
        for (std::size_t slot = 0; slot < mine.index.size(); ++slot) {
            const std::size_t j = lists.number(mine.index[slot]);
            if (system.particle_of(j) >= n) continue; // the sentinel; another's
            const auto row = std::int32_t(slot / W);
            const auto block =
                std::size_t(std::upper_bound(mine.begin.begin(), mine.begin.end(), row) - mine.begin.begin()) - 1;
            const std::size_t i = first + std::size_t(mine.target[block * W + slot % W]);
            Vec<S::dim, double> other = p.at(position, j < n ? j : std::size_t(images.of[j - n - 1]));
            if (j > n) other += shift_of(images.code[j - n - 1], system.grid());
            f(i, j < n ? j : std::size_t(images.of[j - n - 1]), p.at(position, i) - other);
        }
    }
}

} // namespace spate
