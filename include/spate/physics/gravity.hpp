// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A uniform body force.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"

namespace spate {

/// Gravity: dv_i/dt = g. docs/models/wcsph.md (20).
template <int Dim>
struct Gravity {
    static constexpr Fields adds{acceleration};
    Vec<Dim, double> g; ///< [m/s^2]

    [[gnu::cold]] void check() const
    {
        for (int c = 0; c < Dim; ++c) require_finite("Gravity.g[" + std::to_string(c) + "]", g[c], "m/s^2");
    }
    void operator()(auto& i) const { i[acceleration] += g; }
};

} // namespace spate
