// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief How many others a grain touches, in the mean.
#pragma once

#include <cstdint>
#include <string>

namespace spate {

/// Z = 2 N_c / N: contacts between grains, not with walls, over all grains. 0 without grains.
struct Coordination {
    std::string name = "coordination";

    double operator()(auto& scene) const // [-]
    {
        scene.make_lists_current();
        const auto directed =
            scene.system().template over_contacts<std::int64_t>([](std::int64_t& n, auto const&...) { ++n; });
        const auto grains = scene.particles().size();
        return grains > 0 ? double(directed) / double(grains) : 0;
    }
};

} // namespace spate
