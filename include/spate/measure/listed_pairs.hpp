// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A walk over the pairs that neighbour lists hold, one at a time: for looks that are rare.
#pragma once

#include "spate/core/fields.hpp"
#include "spate/core/pack.hpp"
#include "spate/core/vec.hpp"

#include <algorithm>
#include <vector>

namespace spate {

/// f(i, who, x) for each directed pair of a mobile particle i that is here in the lists; x = x_i - x_j of the images that meet
/// [m], who tells id and radius of j. \param others  what others' particles are like, by number
template <class S, class Near>
[[gnu::cold]] void each_listed_pair(S const& system, std::vector<Near> const& others, auto const& f)
{
    auto const& p = system.mobile();
    auto const& bins = system.template species<0>().bins;
    auto const& lists = system.template lists<0, 0>();
    constexpr auto W = std::size_t(width<typename S::PairV>);
    for (std::size_t cell = 0; cell < bins.cells(); ++cell) {
        auto const& mine = lists.of_cell(cell);
        const auto first = std::size_t(bins.begin(cell));
        for (std::size_t slot = 0; slot < mine.index.size(); ++slot) {
            const std::size_t j = lists.number(mine.index[slot]);
            if (j == p.size()) continue; // the sentinel
            const auto row = std::int32_t(slot / W);
            const auto block =
                std::size_t(std::upper_bound(mine.begin.begin(), mine.begin.end(), row) - mine.begin.begin()) - 1;
            const std::size_t i = first + std::size_t(mine.target_of(block * W + slot % W));
            const Near who = system.near(j, others);
            f(i, who, p.at(position, i) - who.x);
        }
    }
}

} // namespace spate
