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
/// State, its advance and particle terms in double; pairs in float, of positions in two floats each: the difference of near
/// positions is as true as a float, wherever they lie.
struct Mixed {
    using real = double;
    using value = Pack<double>;
    using pair_value = Pack<float>;
};
/// One particle at a time: the exact oracle of the packs of Double and of Float.
template <class P>
requires(!requires { typename P::pair_value; }) struct ScalarOf {
    using real = typename P::real;
    using value = Scalar<real>;
};

namespace detail {
template <class P>
struct PairValue {
    using type = typename P::value;
};
template <class P>
requires requires { typename P::pair_value; }
struct PairValue<P> {
    using type = typename P::pair_value;
};
} // namespace detail
/// What pair terms compute with.
template <class P>
using pair_value = typename detail::PairValue<P>::type;

} // namespace spate
