// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief When cells move between ranks. It changes who computes, never what.
#pragma once

#include "spate/core/errors.hpp"

namespace spate {

/// Shares are cut anew where the dearest rank costs more than `tolerated` times the mean, and what that saves until the
/// next look pays for the move.
struct Balance {
    int every = 4;           ///< rebuilds of lists between two looks; 0: off
    double tolerated = 1.05; ///< largest cost of a rank over the mean [-]
    int forced = 0;          ///< tests: cuts wander at every so many steps, whatever it costs; 0: off

    void check() const
    {
        require(every >= 0, "Balance.every", every, "0 (off) or above [rebuilds]");
        require(tolerated >= 1, "Balance.tolerated", tolerated, "1 or above [-]");
        require(forced >= 0, "Balance.forced", forced, "0 (off) or above [steps]");
    }
};

} // namespace spate
