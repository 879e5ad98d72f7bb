// expect: spate: Extrapolated mirrors the velocity in all terms
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

void scene()
{
    Bce tank(Box<2>{{0, 0}, {1, 1}}, 0.01, Extrapolated{}, no_slip);
    (void)tank;
}
