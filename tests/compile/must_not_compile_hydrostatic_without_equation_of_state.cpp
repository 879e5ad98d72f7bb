// expect: spate: hydrostatic needs an equation of state
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

void scene()
{
    Simulation s(dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}), Leapfrog{}, Open{});
    s.fill(Box<2>{{0, 0}, {1, 1}}, 0.02, hydrostatic);
}
