// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief How far the particles' velocities are from an exact solution.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <spate/core/fields.hpp>

namespace example {

/// A column of history.csv and of the summary: the largest |v_i - exact(x_i, t)| over a speed of the flow.
template <class Exact>
struct Difference {
    std::string name;
    double speed; ///< [m/s]
    Exact exact;  ///< (x, t) -> velocity [m/s]

    double operator()(auto const& scene) const
    {
        auto const& p = scene.particles();
        double most = 0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const auto e = p.at(spate::velocity, i) - exact(p.at(spate::position, i), scene.time());
            most = std::max(most, std::sqrt(e.squaredNorm()));
        }
        return most / speed;
    }
};
template <class Exact>
Difference(char const*, double, Exact) -> Difference<Exact>;

} // namespace example
