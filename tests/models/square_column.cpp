// SPDX-License-Identifier: BSD-3-Clause
// A square column of water falls in 2D: its front against Martin & Moyce (1952), n^2 = 1, and Lobovsky et al. (2014),
// H = 0.6 m; V26 of the validation plan, which sets no gate. The two experiments differ by up to 0.3 in T, since a gate takes
// a moment to open and the time of its start is a choice; water that starts at once must be between them.
#include "models/case.hpp"
#include "models/series.hpp"

#include "spate/measure/front.hpp"
#include "spate/measure/leaks.hpp"
#include "spate/spate.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;
using models::Series;

/// With the start late by the best shift of 0 to 0.3.
void match(models::Case const& c, Series const& front, std::string const& file, std::string const& whose, double from)
{
    const Series data = models::column_of(file, "T", "Z");
    const auto best = models::best_shift(front, data, 0);
    const Series late = models::shifted(front, data, best.shift);
    c.told("error of the front of " + whose + ", rms after a shift of time", best.error);
    std::printf("%s: rms relative error %.2f %% at shift %.3f, slope %.3f (data %.3f)\n", file.c_str(),
                100 * best.error, best.shift, models::slope(late, from), models::slope(data, from));
}

TEST(SquareColumn, IsBetweenMartinAndMoyceAndLobovsky)
{
    constexpr double H = 0.6, g = 9.81, dx = H / 40;
    const models::Case c("V26", "square column", 40);
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 10 * std::sqrt(2 * g * H)},
                       Continuity<2>{}, DensityDiffusion{.delta = 0.1}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.02}, Gravity<2>{{0, -g}});
    Bce tank(Box<2>{{0, 0}, {6 * H, 1.5 * H}}, dx, Adami{.suction = false}, open(top));
    Simulation dam(water, RungeKutta2{}, tank, Serial{});
    dam.fill(Box<2>{{0, 0}, {H, H}}, dx, hydrostatic);
    std::vector<Series> curves;
    const std::array fronts{Front{dx}};
    models::Recorder<std::array<Front, 1>> recorder{0.002, curves, {fronts}};
    dam.run({.until = 3.4 * std::sqrt(H / g), .cfl = 0.2}, recorder);
    Series front;
    for (std::size_t k = 0; k < curves[0].t.size(); ++k)
        front.add(curves[0].t[k] * std::sqrt(g / H), curves[0].y[k] / H);
    auto const& r = dam.report();
    std::printf("energy rise %.4f %%, density %.2f %%\n", 100 * r.energy_rise * r.energy_reference / r.start.total(),
                100 * r.density_change);
    c.at_most("energy above the start", r.energy_rise * r.energy_reference / r.start.total(), 0.01);
    c.at_most("change of density", r.density_change, 0.02);
    EXPECT_EQ(Leaks{dx}(dam), 0);
    match(c, front, "martin_moyce_1952_n2_1_front.csv", "Martin & Moyce", 1.43);
    match(c, front, "lobovsky_2014_front_H600.csv", "Lobovsky", 0.7);
    constexpr double reading = 0.01; // two copies of a table differ by so much
    const Series late = models::column_of("martin_moyce_1952_n2_1_front.csv", "T", "Z");
    const Series early = models::column_of("lobovsky_2014_front_H600.csv", "T", "Z");
    for (std::size_t k = 0; k < late.t.size(); ++k) EXPECT_GE(front.at(late.t[k]), late.y[k] - reading) << late.t[k];
    for (std::size_t k = 0; k < early.t.size(); ++k)
        EXPECT_LE(front.at(early.t[k]), early.y[k] + reading) << early.t[k];
}

} // namespace
