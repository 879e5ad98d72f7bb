// SPDX-License-Identifier: BSD-3-Clause
// A pulse of sound in Tait's fluid arrives with the speed of sound.
#include "spate/spate.hpp"

#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace spate;

constexpr int N = 64; // points of a wavelength
constexpr double length = 16 * N, c0 = 10, rho0 = 1000;

/// One wavelength of (1 - cos(k x))/2 that runs to the right: v = amplitude c0 f, rho = rho0 (1 + amplitude f).
/// h of one spacing: only there is the lattice sum of the 1D cubic gradient 1 (tests/data/kernel_lattice_constants.csv).
auto pulse(double amplitude)
{
    auto fluid = wcsph(CubicSpline<1>{1.0}, Tait{.rho0 = rho0, .c0 = c0}, Continuity<2>{}, PressureForce<2>{});
    const Box<1> box{{}, {{length}}};
    Simulation sim(fluid, Leapfrog{}, Periodic(box), Serial{}, Double{}, NoWatch{});
    sim.fill(box, 1, [&](auto& p, std::size_t i) {
        const double x = p.at(position, i)[0];
        const double f = x < N ? 0.5 * (1 - std::cos(2 * std::numbers::pi * x / N)) : 0;
        p.put(velocity, i, {{amplitude * c0 * f}});
        p.put(density, i, rho0 * (1 + amplitude * f));
    });
    return sim;
}
/// Where the pulse is: its velocity-weighted centre, and its peak by a parabola through the three fastest.
struct Place {
    double centre = 0, peak = 0;
};
Place place(auto const& sim)
{
    auto const& p = sim.particles();
    std::vector<double> v(p.size());
    double sum = 0, first = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double u = p.at(velocity, i)[0];
        v[p.id()[i]] = u;
        sum += u, first += u * (p.id()[i] + 0.5);
    }
    const auto k = std::max_element(v.begin(), v.end());
    return {first / sum, double(k - v.begin()) + 0.5 + 0.5 * (k[-1] - k[1]) / (k[-1] - 2 * k[0] + k[1])};
}

TEST(Pulse, ArrivesWithTheSpeedOfSound)
{
    auto sim = pulse(1e-4);
    const auto before = place(sim);
    const double way = 10 * N, dt = 0.1 / c0;
    sim.run({.steps = std::int64_t(way / c0 / dt), .dt = dt});
    const auto after = place(sim);
    const double t = sim.time();
    EXPECT_NEAR((after.centre - before.centre) / (c0 * t), 1, 2e-3);
    EXPECT_NEAR((after.peak - before.peak) / (c0 * t), 1, 2e-3);
    RecordProperty("centre", testing::PrintToString((after.centre - before.centre) / (c0 * t) - 1));
    RecordProperty("peak", testing::PrintToString((after.peak - before.peak) / (c0 * t) - 1));
}

} // namespace
