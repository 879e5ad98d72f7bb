// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief More layers of wall markers than the range of the interaction needs.
#pragma once

#include "spate/core/errors.hpp"

namespace spate {

/// Option of a boundary of markers: `layers(3)`. Never fewer than the range needs: a fluid at the wall would see its end.
struct Layers {
    int least; ///< layers
};
inline Layers layers(int least)
{
    require(least >= 1, "layers", least, "1 or above");
    return {least};
}

} // namespace spate
