// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief When states of a run are kept.
#pragma once

#include <cstdint>

#include "spate/core/errors.hpp"

namespace spate::io {

/// What becomes of the state after a step.
enum class Due { nothing, remember, write };

/// When states are kept. With neither steps nor wall only a run that is interrupted, or that a Stop ends, leaves one.
struct Keep {
    std::int64_t steps = 0;       ///< between two checkpoints; 0: not by steps
    double wall = 0;              ///< between two checkpoints, by the clock on the wall [s]; 0: not by the clock
    std::int64_t recorder = 1000; ///< steps between two states kept in memory for the case of a Stop; 0: none

    [[gnu::cold]] void check() const
    {
        require(steps >= 0, "Keep.steps", double(steps), "0 or above");
        require_non_negative("Keep.wall", wall, "s");
        require(recorder >= 0, "Keep.recorder", double(recorder), "0 or above [steps]");
    }
};

} // namespace spate::io
