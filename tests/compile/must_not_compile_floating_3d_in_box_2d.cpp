// expect: spate: a lid, a solid or a law of motion has another number of dimensions
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

void scene()
{
    Bce tank(Box<2>{{0, 0}, {1, 1}}, 0.01, Adami{}, obstacle(Sphere<2>{{0.5, 0.5}, 0.1}, Floating<3>{.density = 500}));
    (void)tank;
}
