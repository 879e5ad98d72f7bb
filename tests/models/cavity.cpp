// SPDX-License-Identifier: BSD-3-Clause
// The cavity under a sliding lid at Re = 100 (Ghia, Ghia & Shin 1982) against a reference of our own by finite differences
// (its file says how it was made): numerics V16.
#include "oracle/table.hpp"

#include <spate/spate.hpp>

#include <gtest/gtest.h>

namespace {

using namespace spate;
using At = Vec<2, double>;

constexpr int n = 50;
constexpr double L = 1, U = 1, Re = 100, dx = L / n;

/// Root of the mean square over both profiles through the middle, u(y) and v(x), over the speed of the lid.
double error(auto const& scene)
{
    double sum = 0;
    int points = 0;
    auto profile = [&](std::string const& file, std::string const& along, int component) {
        for (auto const& row : oracle::table(file)) {
            const double s = std::stod(row.at(along));
            if (s < dx || s > L - dx) continue; // a mean over neighbours needs them on both sides
            const At x = component == 0 ? At{L / 2, s} : At{s, L / 2};
            const double e = Probe{"", velocity, x}(scene)[component] - std::stod(row.at("Re100"));
            sum += e * e, ++points;
        }
    };
    profile("cavity_reference_fd_u.csv", "y", 0);
    profile("cavity_reference_fd_v.csv", "x", 1);
    EXPECT_GE(points, 25);
    return std::sqrt(sum / points) / U;
}
// 3 % at 50 spacings, by numerics V16; the flow is steady from t = 10 L/U.
TEST(Cavity, HasTheProfilesOfTheReferenceUnderALid)
{
    const auto fluid = wcsph(CubicSpline<2>{.h = 1.2 * dx}, LinearEos{.rho0 = 1, .c0 = 10 * U}, Continuity<2>{},
                             DensityDiffusion{.delta = 0.1}, PressureForce<2>{}, LaminarViscosity{.mu = U * L / Re});
    const Box<2> box{{0, 0}, {L, L}};
    Simulation s(fluid, SymplecticEuler{}, Bce(box, dx, Adami{}, no_slip, lid(top, U, 0.0)));
    s.fill(box, dx);
    for (double t : {12.0, 13.0, 14.0}) {
        s.run({.until = t * L / U});
        EXPECT_LE(error(s), 0.03) << t;
        EXPECT_EQ(Leaks{dx}(s), 0);
        std::printf("t %g: rms error of the profiles %.4f\n", t, error(s));
    }
}

} // namespace
