// expect: spate: a lid drives nothing where walls are free_slip
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

void scene()
{
    Bce tank(Box<2>{{0, 0}, {1, 1}}, 0.01, Adami{}, free_slip, lid(top, 1.0, 0.0));
    (void)tank;
}
