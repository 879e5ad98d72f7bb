// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A solid in the domain of a boundary of markers, at rest or moving by a law.
#pragma once

#include "spate/boundary/motion.hpp"
#include "spate/boundary/solid/solid.hpp"

namespace spate {

/// Option of a boundary of markers: `obstacle(Sphere<3>{{...}, r})`, `obstacle(Box<2>{...}, Steady<2>{...})`.
template <class S, class M = Still>
struct Obstacle {
    S solid; ///< at rest
    M law;
};
template <class S, class M = Still>
Obstacle<S, M> obstacle(S solid, M law = {})
{
    if constexpr (requires { solid.check(); }) solid.check();
    return {solid, law};
}

} // namespace spate
