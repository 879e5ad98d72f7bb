// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Wall markers whose density follows continuity, as the seed does it.
#pragma once

#include "spate/core/fields.hpp"

#include <tuple>

namespace spate {

/// Dynamic boundary (Crespo et al. 2007; the seed deck): the model's continuity runs on the markers, its equation of
/// state gives their pressure. Simple and biased: a gap of about a spacing and 10 % of pressure error near the wall.
/// docs/models/boundaries.md (5).
struct ByContinuity {
    static constexpr const char* name = "by_continuity";
    static constexpr Fields fields{density, density_rate, pressure};
    template <bool = false, class P>
    [[nodiscard]] std::tuple<> terms(P const&) const
    {
        return {};
    }
};

} // namespace spate
