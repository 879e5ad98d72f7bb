// SPDX-License-Identifier: BSD-3-Clause
// Markers of Adami that see no fluid: they are at rest pressure, whatever they bore before, and so is a marker that stands
// in one pack beside wet ones.
#include "spate/boundary/adami.hpp"

#include <spate/spate.hpp>

#include <gtest/gtest.h>

namespace {

using namespace spate;
using At = Vec<2, double>;

constexpr double dx = 0.02, h = 1.2 * dx, rho0 = 1000;

/// A few particles, pressed together by 1 %, in the corner of a tank of 300 markers and more.
auto corner()
{
    auto water = wcsph(CubicSpline<2>{.h = h}, Tait{.rho0 = rho0, .c0 = 10}, Continuity<2>{}, PressureForce<2>{},
                       Gravity<2>{{0, -9.81}});
    Simulation s(water, RungeKutta2{}, Bce(Box<2>{{0, 0}, {1, 1}}, dx, Adami{}), Serial{});
    s.fill(Box<2>{{0, 0}, {0.1, 0.1}}, dx, [](auto& p, std::size_t i) { p.put(density, i, 1.01 * rho0); });
    s.prepare();
    return s;
}
struct Seen {
    int wet = 0, dry = 0, mixed_packs = 0;
};
/// Each marker is wet if a particle is in its range; then it bears what p and rho g . x of its neighbours make of it, else 0.
Seen expect_states(auto& s)
{
    s.refresh();
    auto const& p = s.particles();
    auto const& w = s.system().template species<1>().particles;
    const double p0 = equation_of_state(s.physics()).pressure_of(1.01 * rho0);
    Seen seen;
    std::vector<bool> wet(w.size());
    for (std::size_t m = 0; m < w.size(); ++m) {
        double nearest = 1;
        for (std::size_t i = 0; i < p.size(); ++i)
            nearest = std::min(nearest, std::sqrt((p.at(position, i) - w.at(position, m)).squaredNorm()));
        wet[m] = nearest < 1.9 * h; // there W is above a millionth of W(0)
        if (wet[m]) {
            EXPECT_NEAR(w.at(pressure, m), p0, 1.01 * rho0 * 9.81 * 2 * h) << m; // within the range along gravity
            EXPECT_GT(w.at(density, m), 1.005 * rho0) << m;
            ++seen.wet;
        }
        else if (nearest > 2 * h) {
            EXPECT_EQ(w.at(pressure, m), 0) << m;
            EXPECT_EQ(w.at(density, m), rho0) << m;
            ++seen.dry;
        }
    }
    for (std::size_t m = 0; m + 8 <= w.size(); m += 8) {
        int n = 0;
        for (std::size_t k = 0; k < 8; ++k) n += wet[m + k];
        seen.mixed_packs += n > 0 && n < 8;
    }
    return seen;
}

TEST(Adami, DryMarkersAreAtRestPressure)
{
    auto s = corner();
    const Seen seen = expect_states(s);
    EXPECT_GT(seen.wet, 10);
    EXPECT_GT(seen.dry, 300);
    EXPECT_GT(seen.mixed_packs, 0);
}
TEST(Adami, MarkersDryWhenTheFluidHasGone)
{
    auto s = corner();
    expect_states(s);
    auto& p = s.particles();
    for (std::size_t i = 0; i < p.size(); ++i) p.put(position, i, p.at(position, i) + At{0.5, 0.5});
    s.system().forget_lists();
    s.system().rebuild();
    const Seen seen = expect_states(s);
    EXPECT_EQ(seen.wet, 0);
    EXPECT_GT(seen.dry, 400);
}

} // namespace
