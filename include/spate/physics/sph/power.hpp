// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A real power without libm: the same bits in every lane and on every machine.
#pragma once

#include "spate/core/pack.hpp"

namespace spate::detail {

/// x^s for x > 0: y = x^(1/16), ln y = 2 atanh((y-1)/(y+1)) and exp(s ln y) by their series, then the 16th power.
/// For 1e-3 <= x <= 1e3 and |s| <= 4 the series are exact to rounding; roundings are multiplied by 16.
template <class V>
[[gnu::always_inline]] inline V power_of(V const& x, double s)
{
    const V y = sqrt(sqrt(sqrt(sqrt(x))));
    const V t = (y - 1) / (y + 1), t2 = t * t;
    V a = V(1.0 / 27);
    for (int k = 25; k > 0; k -= 2) a = a * t2 + V(1.0 / k);
    const V u = V(2 * s) * (t * a);
    V e = V(1);
    for (int k = 26; k > 0; --k) e = 1 + u * e * V(1.0 / k);
    const V e2 = e * e, e4 = e2 * e2, e8 = e4 * e4;
    return e8 * e8;
}

} // namespace spate::detail
