// SPDX-License-Identifier: BSD-3-Clause
// The smallest integrator: eight constants, how it grows, and a step made of the system's verbs.
#include <spate/spate.hpp>

using namespace spate;

namespace {

//[integrator
struct DriftKick { // x+ = x + dt v; v+ = v + dt a(x+)
    static constexpr const char* name = "drift_kick";
    static constexpr int order = 1, evaluations = 1;
    static constexpr bool saves = false;
    static constexpr double imaginary_limit = 2, real_limit = 2;
    static constexpr double ahead_velocity = 1, ahead_acceleration = 0; // rates are taken at x + dt v
    static double growth(double) { return 0; }
    void step(auto& s, double dt) const
    {
        s.rates(s.driven);
        s.advance(s.drifting, dt);
        s.rates(s.kicked);
        s.advance(s.kicked, dt);
    }
};
static_assert(Integrator<DriftKick>);
//]

} // namespace

void must_compile_smallest_integrator()
{
    Simulation water(
        wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, PressureForce<2>{}),
        DriftKick{}, Open{});
    water.fill(Box<2>{{0, 0}, {0.1, 0.1}}, 0.01);
    water.run({.steps = 1});
}
