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
    bool by_pairs = false;   ///< a cell costs as many units as it has pairs, not the time that it took
    double a_particle = 10;  ///< what a particle costs outside of the tasks of cells, in pairs: packing, advancing [-]
    double pace = 1;         ///< tests, by pairs: how many times as long as on others anything takes on this rank [-]
    int forced = 0;          ///< tests: cuts wander at every so many steps, whatever it costs; 0: off
    bool by_cpu = false;     ///< a cell costs the time of a processor, not of the clock: where other programs run too

    void check() const
    {
        require(every >= 0, "Balance.every", every, "0 (off) or above [rebuilds]");
        require(tolerated >= 1, "Balance.tolerated", tolerated, "1 or above [-]");
        require(a_particle >= 0, "Balance.a_particle", a_particle, "0 or above [pairs]");
        require(pace > 0, "Balance.pace", pace, "above 0 [-]");
        require(forced >= 0, "Balance.forced", forced, "0 (off) or above [steps]");
    }
};

} // namespace spate
