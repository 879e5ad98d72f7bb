// SPDX-License-Identifier: BSD-3-Clause
// A drop that is stretched (Monaghan 1994, section 5): V22 of the validation plan. A disc of radius R starts with
// v = A0 (-x, y) and stays an ellipse of the same area in an incompressible fluid; the table is the solution of its
// ordinary differential equation, in units of R and 1/A0.
#include "models/case.hpp"
#include "models/results.hpp"
#include "oracle/table.hpp"

#include "spate/spate.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace spate;
using Point = Vec<2, double>;

constexpr double R = 1, A0 = 100, rho0 = 1000; // radius [m], rate of strain [1/s], density [kg/m^3]
const Tait eos{.rho0 = rho0, .c0 = 1400};      // Monaghan's speed of sound

/// On the lattice, with the velocity and the pressure rho0 A0^2 (R^2 - r^2)/2 of the solution at its start.
template <class Kernel>
auto drop(int n, double smoothing)
{
    const double dx = R / n;
    auto water = wcsph(Kernel{.h = smoothing * dx}, eos, Continuity<2>{}, DensityDiffusion{.delta = 0.1},
                       PressureForce<2>{}, ArtificialViscosity{.alpha = 0.02});
    Simulation s(water, RungeKutta2{}, Open{}, Serial{});
    auto start = [](auto& p, std::size_t i) {
        const Point x = p.at(position, i);
        p.put(velocity, i, Point{-A0 * x[0], A0 * x[1]});
        p.put(density, i, eos.density_of(0.5 * rho0 * A0 * A0 * (R * R - x.squaredNorm())));
    };
    s.fill(Box<2>{{0, 0}, {dx, dx}}, dx, start); // one particle; the others are added, since a disc is no box
    for (int i = -n; i < n; ++i)
        for (int j = -n; j < n; ++j) {
            const Point x{(i + 0.5) * dx, (j + 0.5) * dx};
            if (x.squaredNorm() > R * R || (i == 0 && j == 0)) continue;
            const std::size_t k = s.add(x);
            start(s.particles(), k);
        }
    s.prepare();
    return s;
}

struct Shape {
    double minor, major; // semi-axes by the second moments of the area [m]: a^2 = 4 <x^2> of an ellipse
    double area;         // sum m/rho [m^2]
    double far;          // outermost particle along, and dx/2 [m]
};
Shape shape(auto const& s, double dx)
{
    double area = 0, xx = 0, yy = 0, far = 0;
    auto const& p = s.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double V = p.at(mass, i) / p.at(density, i);
        const Point x = p.at(position, i);
        area += V, xx += V * x[0] * x[0], yy += V * x[1] * x[1], far = std::max(far, x[1] + dx / 2);
    }
    return {2 * std::sqrt(xx / area), 2 * std::sqrt(yy / area), area, far};
}

/// The gates of V22, at R/dx = 40: semi-axes 1 %, area 0.5 %, at each time of the table to A0 t = 2. The minor one is a
/// known gap once the lattice has been stretched by a half (A0 t = 0.4).
template <class Kernel>
void expect_the_solution(std::string const& what, double smoothing)
{
    constexpr int n = 40;
    const models::Case c("V22", what == "cubic_spline" ? "cubic spline" : "Wendland C2", n);
    auto s = drop<Kernel>(n, smoothing);
    const double area = std::numbers::pi * R * R, start = s.energy().total();
    auto file = models::results("elliptical_drop_40_" + what + ".csv", "A0t,minor,major,area,energy");
    double minor_off = 0, major_off = 0, area_off = 0, far = 0;
    for (auto const& row : oracle::table("elliptical_drop.csv")) {
        const double t = std::stod(row.at("A0t"));
        if (t > 2 + 1e-9) break;
        if (t > 0) s.run({.until = t / A0, .cfl = 0.2});
        const Shape now = shape(s, R / n);
        const double minor = now.minor / R / std::stod(row.at("minor")) - 1,
                     major = now.major / R / std::stod(row.at("major")) - 1;
        if (t < 0.4 + 1e-9) {
            EXPECT_LE(std::abs(minor), 0.01) << t;
        }
        EXPECT_LE(std::abs(major), 0.01) << t;
        EXPECT_LE(std::abs(now.area / area - 1), 0.005) << t;
        minor_off = std::max(minor_off, std::abs(minor)), major_off = std::max(major_off, std::abs(major));
        area_off = std::max(area_off, std::abs(now.area / area - 1));
        if (std::abs(t - 0.8) < 1e-9)
            std::printf("A0 t = 0.8: minor %+.2f %%, major %+.2f %%\n", 100 * minor, 100 * major);
        far = now.far / R / std::stod(row.at("major")) - 1;
        file << t << ',' << now.minor / R << ',' << now.major / R << ',' << now.area / area << ','
             << s.energy().total() / start << '\n';
    }
    EXPECT_NEAR(s.time() * A0, 2, 1e-9);
    std::printf(
        "%s, R/dx %d, to A0 t = 2: minor within %.2f %%, major %.2f %%, area %.3f %%, outermost particle off by "
        "%.2f %% at the end, energy lost %.2f %%\n",
        what.c_str(), n, 100 * minor_off, 100 * major_off, 100 * area_off, 100 * far,
        100 * (1 - s.energy().total() / start));
    c.at_most("error of the major semi-axis, to A0 t = 2", major_off, 0.01);
    c.at_most("error of the area, to A0 t = 2", area_off, 0.005);
    c.told("energy lost", 1 - s.energy().total() / start);
    c.known_gap("error of the minor semi-axis, to A0 t = 2", minor_off, "V22 minor semi-axis " + what);
}
TEST(EllipticalDrop, HasTheSemiAxesOfTheSolution) { expect_the_solution<CubicSpline<2>>("cubic_spline", 1.2); }
TEST(EllipticalDrop, HasTheSemiAxesOfTheSolutionWithWendlandC2)
{
    expect_the_solution<WendlandC2<2>>("wendland_c2", 2);
}

} // namespace
