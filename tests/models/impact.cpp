// SPDX-License-Identifier: BSD-3-Clause
// A wide column of water, 2 H x H, falls and strikes a wall at 5.366 H: pressure there against Buchner (2002), as in Colagrossi &
// Landrini (2003) and Marrone et al. (2011); V29 of the validation plan, which sets no gate. tau = t sqrt(g/H), P = p/(rho g H).
// The same scene at H/dx = 400 by another code (c0 = 50 sqrt(g H), Wendland C2) has its front at 2.947 H and 4.665 H at
// tau = 1 and 2, and strikes at 2.35.
#include "models/case.hpp"
#include "models/results.hpp"
#include "models/series.hpp"

#include "spate/measure/front.hpp"
#include "spate/measure/leaks.hpp"
#include "spate/measure/probe.hpp"
#include "spate/spate.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;
using models::Series;

constexpr double H = 0.6, g = 9.81; // [m], [m/s^2]

Series buchner()
{
    // The record is read off a plot: where it jumps its points are not in order of time.
    Series c = models::column_of("buchner_2002_pressure.csv", "tau", "P");
    std::vector<std::size_t> order(c.t.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return c.t[a] < c.t[b]; });
    Series sorted;
    for (const auto k : order) sorted.add(c.t[k], c.y[k]);
    return sorted;
}
TEST(LongImpact, TableHasTheArrivalAndThePlateauOfTheExperiment)
{
    EXPECT_NEAR(buchner().above(0.2), 2.5, 0.02);
    EXPECT_NEAR(buchner().mean(3, 5), 0.55, 0.1);
}

void strikes(int n)
{
    const models::Case c("V29", "H = 0.6 m", n);
    const double dx = H / n, unit = std::sqrt(H / g), wall = std::round(5.366 * n) * dx;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 10 * std::sqrt(2 * g * H)},
                       Continuity<2>{}, DensityDiffusion{.delta = 0.1}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.02}, Gravity<2>{{0, -g}});
    Bce tank(Box<2>{{0, 0}, {wall, 3 * H}}, dx, Adami{.suction = false}, open(top));
    Simulation dam(water, RungeKutta2{}, tank, Threads{});
    dam.fill(Box<2>{{0, 0}, {2 * H, H}}, dx, hydrostatic);
    std::vector<Series> read;
    const std::array fronts{Front{.spacing = dx}, Front{.spacing = dx, .share = 1}}; // of 99.5 %; the foremost particle
    const std::vector<Probe<Pressure, 2>> sensors{{"p1", pressure, {wall, 0.2 * H}}};
    models::Recorder<std::array<Front, 2>, std::vector<Probe<Pressure, 2>>> recorder{
        2e-3 * unit, read, {fronts, sensors}};
    dam.run({.until = 2 * unit, .cfl = 0.2}, recorder);
    c.at_most("energy above the start, to tau = 2",
              dam.report().energy_rise * dam.report().energy_reference / dam.report().start.total(), 0.01);
    c.at_most("change of density, to tau = 2", dam.report().density_change, 0.02);
    dam.run({.until = 7 * unit, .cfl = 0.2}, recorder);
    EXPECT_EQ(Leaks{dx}(dam), 0);
    auto file = models::results("impact_" + std::to_string(n) + ".csv", "tau,front,P");
    Series front, foremost, p;
    for (std::size_t k = 0; k < read[0].t.size(); ++k) {
        const double tau = read[0].t[k] / unit;
        if (k > 0 && tau <= front.t.back()) continue; // the run goes on where it stopped
        front.add(tau, read[0].y[k] / H), foremost.add(tau, read[1].y[k] / H);
        p.add(tau, read[2].y[k] / (1000 * g * H));
        file << tau << ',' << front.y.back() << ',' << p.y.back() << '\n';
    }
    const Series data = buchner();
    const double hit = foremost.above(wall / H - 1.0 / n);
    std::printf("H/dx %d: front %.3f, %.3f H, strikes at %.3f; P1 mean %.3f (%.3f), impulse %.3f (%.3f)\n", n,
                front.at(1), front.at(2), hit, p.mean(3, 5), data.mean(3, 5), p.integral(2.4, 5.5),
                data.integral(2.4, 5.5));
    // The other code is off by 1.7 and 2.1 % from its finest level at H/dx = 40, by 0.7 and 0.9 % at 80; what it calls the front is
    // not told, so both are given.
    for (double tau : {1.0, 2.0}) {
        const double fine = tau == 1 ? 2.947 : 4.665;
        const std::string when = " at tau = " + std::to_string(int(tau)) + ", against H/dx = 400 of another code";
        c.told("error of the foremost particle" + when, std::abs(foremost.at(tau) / fine - 1));
        c.told("error of the front of 99.5 %" + when, std::abs(front.at(tau) / fine - 1));
    }
    c.told("error of the time of impact, against H/dx = 400 of another code", std::abs(hit / 2.35 - 1));
    c.told("error of the arrival of P1, above 0.2, against Buchner", std::abs(p.above(0.2) / data.above(0.2) - 1));
    c.told("error of the mean of P1 over 3 < tau < 5, against Buchner", std::abs(p.mean(3, 5) / data.mean(3, 5) - 1));
    c.told("error of the impulse of P1 over 2.4 < tau < 5.5, against Buchner",
           std::abs(p.integral(2.4, 5.5) / data.integral(2.4, 5.5) - 1));
}
TEST(LongImpact, IsToldBesideBuchnerWhenCoarse) { strikes(40); }
TEST(LongImpact, IsToldBesideBuchner) { strikes(80); }

} // namespace
