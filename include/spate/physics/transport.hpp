// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Positions that follow another velocity than the particle's own.
#pragma once

#include "spate/core/fields.hpp"
#include "spate/core/term.hpp"

namespace spate {

/// dx_i/dt = v_i + what other terms add to the transport velocity. A physics holds it if and only if some term adds.
/// docs/models/wcsph.md (36).
struct OwnVelocity {
    static constexpr Fields reads{velocity};
    static constexpr Fields adds{transport_velocity};
    static constexpr Between between{Role::mobile, Role::any};
    void operator()(auto& i) const { i[transport_velocity] += i[velocity]; }
};

} // namespace spate
