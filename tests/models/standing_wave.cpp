// SPDX-License-Identifier: BSD-3-Clause
// A standing wave of gravity between walls of free slip against linear theory, omega^2 = g k tanh(k H), and its decay by
// viscosity, E_k ~ exp(-4 nu k^2 t) (Lighthill 1978): V21 of the validation plan.
#include "models/case.hpp"
#include "models/results.hpp"

#include "spate/measure/leaks.hpp"
#include "spate/spate.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace spate;

constexpr double H = 1, L = 2, g = 1, a = 0.05 * H, k = 2 * std::numbers::pi / L; // one wave long; amplitude a [m]
const double omega = std::sqrt(g * k * std::tanh(k * H)), period = std::numbers::pi / omega; // of kinetic energy [s]

/// Flat, with the velocity of the linear wave: eta = a cos(k x) sin(omega t).
template <class Kernel>
auto wave(int n, double smoothing, double Re)
{
    const double dx = H / n, c0 = 10 * std::sqrt(g * H), nu = std::sqrt(g * H) * H / Re;
    auto water = wcsph(Kernel{.h = smoothing * dx}, Tait{.rho0 = 1000, .c0 = c0}, Continuity<2>{},
                       DensityDiffusion{.delta = 0.1}, PressureForce<2>{}, ArtificialViscosity{.alpha = 0.02},
                       LaminarViscosity{.mu = 1000 * nu}, Gravity<2>{{0, -g}});
    Simulation s(water, RungeKutta2{}, Bce(Box<2>{{0, 0}, {L, 1.2 * H}}, dx, Adami{}, free_slip, open(top)), Serial{});
    s.fill(Box<2>{{0, 0}, {L, H}}, dx, settled);
    auto& p = s.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto x = p.at(position, i);
        const double U = a * omega / std::sinh(k * H);
        p.put(velocity, i,
              {-U * std::cosh(k * x[1]) * std::sin(k * x[0]), U * std::sinh(k * x[1]) * std::cos(k * x[0])});
    }
    return s;
}

struct Fit {
    double period = 0; // of kinetic energy [s]
    double first = 0;  // time of the first maximum after the start [s]
    double decay = 0;  // of kinetic energy [1/s]
    double excess = 0; // of the viscosity that the decay shows, over nu [-]
    double leaks = 0;
};
constexpr auto of_period = "error of the period of E_k";
/// Place and height of a maximum: a parabola by least squares through the samples from first to last, in units of samples.
std::array<double, 2> maximum(std::vector<double> const& y, std::size_t first, std::size_t last)
{
    double s0 = 0, s2 = 0, s4 = 0, y0 = 0, y1 = 0, y2 = 0;
    const double mid = 0.5 * double(first + last);
    for (std::size_t i = first; i <= last; ++i) {
        const double x = double(i) - mid;
        s0 += 1, s2 += x * x, s4 += x * x * x * x, y0 += y[i], y1 += x * y[i], y2 += x * x * y[i];
    }
    const double c2 = (s0 * y2 - s2 * y0) / (s0 * s4 - s2 * s2), c1 = y1 / s2, c0 = (y0 - c2 * s2) / s0;
    return {mid - c1 / (2 * c2), c0 - c1 * c1 / (4 * c2)};
}
double slope(std::vector<double> const& y)
{
    double sxy = 0, sxx = 0;
    for (std::size_t i = 0; i < y.size(); ++i) {
        const double x = double(i) - 0.5 * double(y.size() - 1);
        sxy += x * y[i], sxx += x * x;
    }
    return sxy / sxx;
}
/// By the maxima of kinetic energy from the first after the start on; an eighth of a period on either side of each.
template <class Kernel>
Fit run(int n, double smoothing, double Re, int maxima)
{
    auto s = wave<Kernel>(n, smoothing, Re);
    constexpr std::size_t samples = 64; // in a period
    std::vector<double> kinetic;
    Fit f;
    auto file = models::results("standing_wave_" + std::to_string(n) + "_" + std::to_string(int(Re)) + ".csv",
                                "t_over_period,kinetic");
    for (std::size_t i = 0; i <= samples * std::size_t(maxima) + samples / 4; ++i) {
        if (i > 0) s.run({.until = double(i) * period / samples, .cfl = 0.2});
        kinetic.push_back(s.energy().kinetic);
        file << double(i) / samples << ',' << kinetic.back() / kinetic.front() << '\n';
        f.leaks = std::max(f.leaks, Leaks{H / n}(s));
    }
    std::vector<double> at, height;
    for (int m = 1; m <= maxima; ++m) {
        const auto [x, y] =
            maximum(kinetic, samples * std::size_t(m) - samples / 8, samples * std::size_t(m) + samples / 8);
        at.push_back(x / samples * period), height.push_back(std::log(y));
    }
    f.first = at[0];
    if (maxima == 1) return f;
    f.period = slope(at), f.decay = -slope(height) / f.period;
    const double nu = std::sqrt(g * H) * H / Re, found = f.decay / (4 * k * k);
    f.excess = found / nu - 1;
    std::printf("H/dx %d, Re %.0f: period of E_k %+.2f %%, nu_num - nu = %.2e m^2/s (%.2f nu; alpha h c0/8 = %.2e)\n",
                n, Re, 100 * (f.period / period - 1), found - nu, found / nu - 1,
                0.02 * smoothing * H / n * 10 * std::sqrt(g * H) / 8);
    return f;
}

/// Over one period only: the first maximum of exp(-2 s t) cos^2(omega t), s = 2 nu k^2, comes by atan(s/omega)/omega before it.
TEST(StandingWave, HasThePeriodOfLinearTheoryAtFirst)
{
    const models::Case c("V21", "Wendland C2, Re = 500", 50);
    const Fit f = run<WendlandC2<2>>(50, 2, 500, 1);
    const double s = 2 * std::sqrt(g * H) * H / 500 * k * k, first = period - std::atan(s / omega) / omega;
    std::printf("first maximum of E_k %+.2f %%\n", 100 * (f.first / first - 1));
    c.at_most("error of the first maximum of E_k", std::abs(f.first / first - 1), 0.01);
    EXPECT_EQ(f.leaks, 0);
}
/// Coarse, and with the kernel of the other free-surface cases at 1.2 dx, of which the wave is 5 % too fast for a reason not
/// found.
TEST(StandingWave, HasThePeriodOfLinearTheoryWhenCoarse)
{
    const models::Case c("V21", "Wendland C2, Re = 500", 20);
    const Fit f = run<WendlandC2<2>>(20, 2, 500, 3);
    c.told("numerical viscosity over nu", f.excess);
    EXPECT_GT(f.decay, 0);
    EXPECT_EQ(f.leaks, 0);
    c.known_gap(of_period, std::abs(f.period / period - 1), "V21 period H/dx 20");
}
TEST(StandingWave, HasThePeriodOfLinearTheoryWithTheCubicSpline)
{
    const models::Case c("V21", "cubic spline, Re = 500", 20);
    const Fit f = run<CubicSpline<2>>(20, 1.2, 500, 3);
    c.told("numerical viscosity over nu", f.excess);
    EXPECT_GT(f.decay, 0);
    EXPECT_EQ(f.leaks, 0);
    c.known_gap(of_period, std::abs(f.period / period - 1), "V21 period cubic spline H/dx 20");
}
TEST(LongStandingWave, HasThePeriodOfLinearTheory)
{
    const models::Case c("V21", "Wendland C2, Re = 500", 50);
    const Fit f = run<WendlandC2<2>>(50, 2, 500, 3);
    c.told("numerical viscosity over nu", f.excess);
    c.at_most(of_period, std::abs(f.period / period - 1), 0.01);
    EXPECT_GT(f.decay, 0);
    EXPECT_EQ(f.leaks, 0);
}

} // namespace
