// expect: spate: walls are no_slip or free_slip
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

void scene()
{
    Bce tank(Box<2>{{0, 0}, {1, 1}}, 0.01, Adami{}, no_slip, free_slip);
    (void)tank;
}
