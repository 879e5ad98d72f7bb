// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The arithmetic of a scene: the type that is stored, and the value that terms compute with.
#pragma once

#include "spate/core/pack.hpp"

namespace spate {

/// double in packs: the default.
struct Double {
    using real = double;
    using value = Pack<double>;
};
/// float in packs. Positions are absolute: 24 bits over the domain.
struct Float {
    using real = float;
    using value = Pack<float>;
};
/// One particle at a time: the exact oracle of the packs.
template <class P>
struct ScalarOf {
    using real = typename P::real;
    using value = Scalar<real>;
};

} // namespace spate
