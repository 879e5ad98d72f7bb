// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief How far a flow has come along an axis, without the few particles that fly ahead of it.
#pragma once

#include "spate/core/field.hpp"
#include "spate/core/ranks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace spate {

/// The coordinate that a share of the particles has not passed (nearest rank), and half a spacing: a full box ends at its
/// face. The maximum is a stray particle and does not converge. NaN without particles.
struct Front {
    double spacing; ///< of the particles [m]
    int axis = 0;
    double share = 0.995; ///< [-]
    std::string name = "front";

    [[gnu::cold]] double operator()(auto const& scene) const // [m]
    {
        auto const& p = scene.particles();
        const auto ranks = party_of(scene);
        const auto n = ranks.all(std::int64_t(p.size()), agree::Sum{});
        if (n == 0) return std::numeric_limits<double>::quiet_NaN();
        std::vector<double> x(p.size());
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = p.at(position, i)[axis];
        const double place = std::ceil(share * double(n) * (1 - 1e-14)); // 0.995 of 200 is 199, whatever the rounding
        const auto k = std::size_t(std::clamp(place, 1.0, double(n))) - 1;
        if constexpr (!decltype(ranks)::alone) return of_all(x, std::int64_t(k), ranks) + spacing / 2;
        std::nth_element(x.begin(), x.begin() + std::ptrdiff_t(k), x.end());
        return x[k] + spacing / 2;
    }

private:
    /// The number of which k others are smaller, of the numbers of all ranks: by halves of the doubles, in their order.
    static double of_all(std::vector<double> const& x, std::int64_t k, auto const& ranks)
    {
        constexpr std::uint64_t sign = std::uint64_t(1) << 63;
        constexpr auto most = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity()) | sign;
        std::uint64_t low = ~most, high = most;
        auto number = [](std::uint64_t place) { return std::bit_cast<double>(place & sign ? place ^ sign : ~place); };
        while (low < high) { // the least place up to which there are more than k
            const std::uint64_t middle = low + (high - low) / 2;
            const double here = number(middle);
            std::int64_t up_to = 0;
            for (double value : x) up_to += value <= here;
            if (ranks.all(up_to, agree::Sum{}) > k) high = middle;
            else low = middle + 1;
        }
        return number(low);
    }
};

} // namespace spate
