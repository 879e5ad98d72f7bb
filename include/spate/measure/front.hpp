// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief How far a flow has come along an axis, without the few particles that fly ahead of it.
#pragma once

#include "spate/core/field.hpp"

#include <algorithm>
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

    double operator()(auto const& scene) const // [m]
    {
        auto const& p = scene.particles();
        if (p.empty()) return std::numeric_limits<double>::quiet_NaN();
        std::vector<double> x(p.size());
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = p.at(position, i)[axis];
        const double rank =
            std::ceil(share * double(x.size()) * (1 - 1e-14)); // 0.995 of 200 is 199, whatever the rounding
        const auto k = std::size_t(std::clamp(rank, 1.0, double(x.size()))) - 1;
        std::nth_element(x.begin(), x.begin() + std::ptrdiff_t(k), x.end());
        return x[k] + spacing / 2;
    }
};

} // namespace spate
