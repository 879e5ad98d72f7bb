// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Wall markers of which pressure, density and velocity are extrapolated from the fluid.
#pragma once

#include "spate/boundary/adami.hpp"

namespace spate {

/// Boundary condition enforcing markers (Pazouki et al., TR-2015-09): pressure and density as Adami's, and every term of
/// the model, continuity too, sees the mirrored velocity 2 v_w - <v>_f. No-slip is in it. docs/models/boundaries.md (7).
struct Extrapolated {
    static constexpr const char* name = "extrapolated";
    static constexpr Fields fields{density, pressure};
    static constexpr bool mirrors = true; ///< in all terms
    bool suction = true;                  ///< false: wall pressure is cut at 0

    template <bool Moves = false, class P>
    [[nodiscard]] auto terms(P const& physics) const
    {
        return Adami{suction}.template terms<Moves>(physics);
    }
};

} // namespace spate
