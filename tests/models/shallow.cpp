// SPDX-License-Identifier: BSD-3-Clause
// A long reservoir opens onto a dry bed (Ritter 1892) and onto a wet one (Stoker 1957), against the solutions of shallow water:
// numerics V31, which sets no gate. Units: depth H of the reservoir, sqrt(H/g).
#include "models/case.hpp"
#include "models/results.hpp"

#include "spate/measure/gauge.hpp"
#include "spate/measure/leaks.hpp"
#include "spate/spate.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;

constexpr double H = 1, g = 1, left = 14, right = 26; // lengths on either side of the gate [m]

/// Depth at x/t on a dry bed: a fan between -1 and 2.
double ritter(double speed)
{
    if (speed <= -1) return 1;
    return speed >= 2 ? 0 : (2 - speed) * (2 - speed) / 9;
}
/// On a bed with water of depth `wet`: the fan ends in a plateau behind a bore. The depth of the plateau is where the speed
/// behind a bore into water at rest, (m - w) sqrt((m + w)/(2 m w)), is that of the fan, 2 (1 - sqrt m).
struct Stoker {
    double wet, plateau, bore;

    explicit Stoker(double w) : wet(w)
    {
        double lo = w, hi = 1;
        for (int k = 0; k < 60; ++k) {
            const double m = 0.5 * (lo + hi), behind = (m - w) * std::sqrt((m + w) / (2 * m * w));
            (behind < 2 * (1 - std::sqrt(m)) ? lo : hi) = m;
        }
        plateau = 0.5 * (lo + hi);
        bore = 2 * (1 - std::sqrt(plateau)) * plateau / (plateau - w); // continuity across it
    }
    [[nodiscard]] double operator()(double speed) const
    {
        if (speed >= bore) return wet;
        return std::max(ritter(speed), plateau);
    }
};
TEST(LongShallow, PlateauOfStokerConservesMassAndMomentum)
{
    const Stoker s(0.1);
    const double u = 2 * (1 - std::sqrt(s.plateau));
    EXPECT_NEAR(s.bore * (s.plateau - 0.1), u * s.plateau, 1e-12);
    EXPECT_NEAR(s.bore * u * s.plateau - u * u * s.plateau, 0.5 * (s.plateau * s.plateau - 0.01), 1e-12);
}

/// Mean of |depth - solution| over the places from -6 to `last` sqrt(g H) t, at t = 6.
template <class Solution>
void spreads(std::string const& scene, int n, double wet, double last, Solution const& solution)
{
    const models::Case c("V31", scene, n);
    constexpr double t = 6;
    const double dx = H / n;
    auto water =
        wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 20}, // ten times the fastest, 2 sqrt(g H)
              Continuity<2>{}, DensityDiffusion{.delta = 0.1}, PressureForce<2>{}, ArtificialViscosity{.alpha = 0.02},
              Gravity<2>{{0, -g}});
    Bce channel(Box<2>{{-left, 0}, {right, 1.5 * H}}, dx, Adami{.suction = false}, free_slip, open(top));
    Simulation s(water, RungeKutta2{}, channel, Threads{});
    s.fill(Box<2>{{-left, 0}, {0, H}}, dx, hydrostatic);
    if (wet > 0) s.fill(Box<2>{{0, 0}, {right, wet}}, dx, hydrostatic);
    s.run({.until = t, .cfl = 0.2});
    auto file = models::results("shallow_" + std::string(wet > 0 ? "wet" : "dry") + ".csv", "x_over_t,depth,solution");
    double sum = 0, points = 0;
    for (double x = -8; x < 2.2 * t; x += 0.1) {
        const double depth = WettedLength<2>{"", {x, 0}, 2 * dx, dx}(s), exact = solution(x / t);
        file << x / t << ',' << depth << ',' << exact << '\n';
        if (x / t > last) continue;
        sum += std::abs(depth - exact), points += 1;
    }
    c.told("error of depth, mean over H", sum / points);
    const double gate = WettedLength<2>{"", {0, 0}, 2 * dx, dx}(s);
    c.told("depth at the gate, off by", gate / solution(0) - 1);
    EXPECT_EQ(Leaks{dx}(s), 0);
    EXPECT_LT(std::abs(gate / solution(0) - 1), 0.2); // not another flow
}
/// To 1 of 2: ahead of it the film is thinner than two particles, and slows down on any bed.
TEST(LongShallow, ReservoirRunsOutOverADryBed) { spreads("dry bed", 20, 0, 1, ritter); }
TEST(LongShallow, ReservoirRunsOutOverAWetBed) { spreads("wet bed of 0.2 H", 20, 0.2, 2, Stoker(0.2)); }

} // namespace
