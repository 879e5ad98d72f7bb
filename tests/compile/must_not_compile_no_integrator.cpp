// expect: spate: the second argument of a Simulation is an integrator
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

struct Magic { // states nothing of its order, cost and limits
    void step(auto& s, double dt) const { s.advance(s.all, dt); }
};
void scene()
{
    Simulation s(wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, PressureForce<2>{}),
                 Magic{}, Open{});
}
