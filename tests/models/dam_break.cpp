// SPDX-License-Identifier: BSD-3-Clause
// A column of water twice as high as wide falls in 2D, in the scene of the front page, against Martin & Moyce (1952):
// the front alone passes even for runs that are blowing up, so energy, density and leaks are looked at as well.
#include "models/case.hpp"
#include "models/results.hpp"
#include "models/series.hpp"

#include "spate/measure/front.hpp"
#include "spate/measure/gauge.hpp"
#include "spate/measure/leaks.hpp"
#include "spate/spate.hpp"

#include <gtest/gtest.h>

#include <array>

namespace {

using namespace spate;
using models::Series;

constexpr double a = 0.3, H = 2 * a, g = 9.81; // width and height of the column [m], gravity [m/s^2]

/// What a run shows, to T = t sqrt(2 g/a) = 3.5, before the front meets the end of the tank.
struct Fall {
    Series front;                 // Z = x/a over T
    Series height;                // h/H at the wall behind over tau = t sqrt(g/a)
    double energy_rise = 0;       // largest total energy over that of the start [-]
    double energy_left = 0;       // at the end [-]
    double density = 0;           // largest |rho/rho0 - 1| [-]
    double leaks = 0;             // most particles beyond a wall face by more than half a spacing
    double farthest = -1;         // of any particle beyond a wall face [spacings]
    double shift = 0, error = 0;  // best shift of time, and what is left of the rms relative error [-]
    double unshifted = 0;         // rms relative error as it stands [-]
    double of_norm = 0;           // at the best shift: rms(sim - data) / rms(data)
    double speed = 0;             // slope of the shifted front at the data's times from 1.43 on [-]
    double height_difference = 0; // largest of the height at the wall, to tau = 2.45 [-]
};

double error_of_norm(Series const& c, Series const& data)
{
    double sum = 0, norm = 0;
    for (std::size_t k = 0; k < data.t.size(); ++k)
        sum += std::pow(c.y[k] - data.y[k], 2), norm += data.y[k] * data.y[k];
    return std::sqrt(sum / norm);
}
void compare(Fall& f)
{
    const Series data = models::column_of("martin_moyce_1952_n2_2_front.csv", "T", "Z", 3.4);
    f.unshifted = relative_error(shifted(f.front, data, 0), data);
    const auto best = models::best_shift(f.front, data);
    f.shift = best.shift, f.error = best.error;
    f.of_norm = error_of_norm(shifted(f.front, data, f.shift), data);
    f.speed = models::slope(shifted(f.front, data, f.shift), 1.43);
    const Series heights = models::column_of("martin_moyce_1952_n2_2_height.csv", "tau", "H", 2.45);
    for (std::size_t k = 0; k < heights.t.size(); ++k)
        f.height_difference = std::max(f.height_difference, std::abs(f.height.at(heights.t[k]) - heights.y[k]));
}

std::string file_name(std::string const& wall, int n)
{
    return "dam_break_" + (wall == Adami::name ? "" : wall + "_") + std::to_string(n) + ".csv";
}
/// \param n  spacings in the height of the column
template <class Wall>
Fall fall(int n, Wall wall, double alpha = 0.02)
{
    const double dx = H / n, c0 = 10 * std::sqrt(2 * g * H);
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = c0}, Continuity<2>{},
                       DensityDiffusion{.delta = 0.1}, PressureForce<2>{}, ArtificialViscosity{.alpha = alpha},
                       Gravity<2>{{0, -g}});
    Bce tank(Box<2>{{0, 0}, {4 * H, 2 * H}}, dx, wall, open(top));
    Simulation dam(water, RungeKutta2{}, tank, Serial{});
    dam.fill(Box<2>{{0, 0}, {a, H}}, dx, hydrostatic);
    const double start = dam.energy().total();
    Fall f;
    auto file = models::results(file_name(wall.name, n), "T,Z,tau,h_over_H,energy,leaks");
    for (int k = 0; k <= 175; ++k) {
        const double t = 0.02 * k * std::sqrt(a / (2 * g));
        if (k > 0) dam.run({.until = t, .cfl = 0.2});
        const double leaks = Leaks{dx}(dam), T = 0.02 * k, tau = T / std::sqrt(2);
        f.front.add(T, Front{dx}(dam) / a);
        f.height.add(tau, Gauge<2>{"", {0, 0}, dx}(dam) / H);
        f.energy_left = dam.energy().total() / start;
        f.energy_rise = std::max(f.energy_rise, f.energy_left - 1);
        f.leaks = std::max(f.leaks, leaks);
        auto const& p = dam.particles();
        for (std::size_t i = 0; i < p.size(); ++i)
            f.farthest = std::max(f.farthest, tank.template beyond<2>(p.at(position, i)) / dx);
        file << T << ',' << f.front.y.back() << ',' << tau << ',' << f.height.y.back() << ',' << f.energy_left << ','
             << leaks << '\n';
    }
    auto const& r = dam.report();
    f.energy_rise = std::max(f.energy_rise, r.energy_rise * r.energy_reference / r.start.total());
    f.density = r.density_change;
    compare(f);
    std::printf(
        "%s, H/dx %d, alpha %g: rms relative error %.2f %% at shift %.3f (unshifted %.2f %%; rms/rms %.2f %%), slope %.3f, energy rise "
        "%.4f %%, left %.1f %%, density %.2f %%, leaks %.0f, farthest %.2f dx, height %.3f\n",
        wall.name, n, alpha, 100 * f.error, f.shift, 100 * f.unshifted, 100 * f.of_norm, f.speed, 100 * f.energy_rise,
        100 * f.energy_left, 100 * f.density, f.leaks, f.farthest, f.height_difference);
    return f;
}

TEST(DamBreak, TableIsThatOfMartinAndMoyce)
{
    const Series data = models::column_of("martin_moyce_1952_n2_2_front.csv", "T", "Z", 3.4);
    ASSERT_EQ(data.t.size(), 15u);
    EXPECT_NEAR(slope(data, 1.43), 1.319, 5e-4);
    EXPECT_EQ(data.at(0.41), 1.11);
    EXPECT_NEAR(data.at(2.58), 3.11, 1e-12); // half way from 3 to 3.22
}

/// The gates, at three resolutions; V25 of the validation plan.
template <class Wall>
void expect_the_fall(Wall wall)
{
    std::array<double, 3> shift{};
    int k = 0;
    for (int n : {20, 40, 80}) {
        SCOPED_TRACE(n);
        const models::Case c("V25", std::string("walls ") + wall.name, n);
        const Fall f = fall(n, wall);
        const std::string here = std::string(wall.name) + " H/dx " + std::to_string(n);
        const std::string front = "error of the front, rms after a shift of time";
        if (n == 20 && std::same_as<Wall, ByContinuity>) c.known_gap(front, f.error, "V25 front " + here);
        else c.at_most(front, f.error, 0.025);
        c.told("error of the front, rms as it stands", f.unshifted);
        // As it stands, since the plan does not say that heights are shifted as the front is.
        const std::string height = "height at the wall, off by at most [H]";
        if (std::same_as<Wall, ByContinuity> || (n == 80 && std::same_as<Wall, Extrapolated>))
            c.known_gap(height, f.height_difference, "V25 height " + here);
        else c.at_most(height, f.height_difference, 0.05);
        c.at_least("slope of the front", f.speed, 1.2);
        c.at_most("slope of the front", f.speed, 1.4);
        c.at_most("energy above the start", f.energy_rise, 0.01);
        c.at_most("change of density", f.density, 0.02);
        EXPECT_EQ(f.leaks, 0);
        shift[std::size_t(k++)] = f.shift;
    }
    const auto [least, most] = std::minmax_element(shift.begin(), shift.end());
    EXPECT_LE(*most - *least, 0.05); // one gate lag, whatever the resolution
}
TEST(DamBreak, FollowsMartinAndMoyce) { expect_the_fall(Adami{.suction = false}); }
TEST(DamBreak, FollowsMartinAndMoyceOnExtrapolatedMarkers) { expect_the_fall(Extrapolated{.suction = false}); }
TEST(DamBreak, FollowsMartinAndMoyceOnMarkersByContinuity) { expect_the_fall(ByContinuity{}); }

/// Koshizuka & Oka (1996), V27, which sets no gate: the same column, a = 0.146 m. Sound, weight and dissipation scale with it,
/// so that the run is that of Martin & Moyce in units of its own; the experiment is another one.
TEST(DamBreak, IsToldBesideKoshizukaAndOka)
{
    const models::Case c("V27", "column 1 : 2", 40);
    const Fall f = fall(40, Adami{.suction = false});
    const Series data = models::column_of("koshizuka_oka_1996_exp_front.csv", "T", "Z");
    const auto best = models::best_shift(f.front, data);
    c.told("error of the front, rms after a shift of time", best.error);
    c.told("error of the front, rms as it stands", relative_error(shifted(f.front, data, 0), data));
    c.told("shift of time", best.shift);
    EXPECT_EQ(f.leaks, 0);
    // The two experiments differ: this one is up to 0.3 behind that of Martin & Moyce.
    const Series other = models::column_of("martin_moyce_1952_n2_2_front.csv", "T", "Z", 3.4);
    double behind = 0;
    for (std::size_t k = 1; k < data.t.size(); ++k) behind = std::max(behind, other.at(data.t[k]) - data.y[k]);
    EXPECT_NEAR(behind, 0.3, 0.05);
}

} // namespace
