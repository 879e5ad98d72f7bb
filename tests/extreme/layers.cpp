// SPDX-License-Identifier: BSD-3-Clause
// X03: two fluids, one a thousand times as heavy as the other, at rest in a well: put together from terms of one's own, as
// the library's equations of state know one fluid.
#include <spate/spate.hpp>

#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace spate;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr double dx = 0.025, L = 80 * dx, half = 20 * dx, g = 1; // heavy where |y| < half
constexpr double heavy = 1000, light = 1, c_heavy = 10, stiffness = heavy * c_heavy * c_heavy;

inline constexpr struct RestDensity : ScalarField {
    static constexpr std::string_view name = "rest_density", unit = "kg/m^3";
} rest_density{};

/// p = B (rho/rho0 - 1) with one B for both fluids, so that sound is sqrt(1000) times as fast in the light one.
struct OfTwoFluids {
    static constexpr Fields reads{density, rest_density};
    static constexpr Fields writes{pressure};
    void operator()(auto& i) const { i[pressure] = stiffness * (i[density] / i[rest_density] - 1); }
};
/// Pulls towards y = 0: potential g L/(2 pi) (1 - cos(2 pi y/L)), so that nothing needs a wall.
double potential(double y) { return g * L / (2 * std::numbers::pi) * (1 - std::cos(2 * std::numbers::pi * y / L)); }
struct Well {
    static constexpr Fields reads{position};
    static constexpr Fields adds{acceleration};
    void operator()(auto& i) const
    {
        // sin by its product: packs have no libm. u = y over half the period, within -1 to 1.
        const auto u = i[position][1] * (2 / L);
        using V = std::remove_cvref_t<decltype(u)>;
        V s = V(std::numbers::pi) * u;
        for (int k = 1; k <= 40; ++k) s = s * (V(1) - u * u * V(1.0 / (k * k)));
        i[acceleration][1] = i[acceleration][1] - V(g) * s;
    }
};

/// What has become of the two fluids.
struct End {
    double across = 0;  ///< the farthest that a particle is on the wrong side of its interface [spacings]
    double balance = 0; ///< sum of forces along x over the sum of their sizes
    double fastest = 0; ///< [m/s]
    std::string stop;
    std::vector<std::string> warnings;
};
template <int sigma, class Precision = Double, class Backend = Serial>
End settle(int steps, Backend backend = {})
{
    const Box<2> box{{0, -L / 2}, {16 * dx, L / 2}};
    Simulation s(physics(Smoothing<WendlandC2<2>>{{.h = 1.6 * dx}}, OfTwoFluids{}, Continuity<sigma>{},
                         PressureForce<sigma>{}, MonaghanCleary<2>{.mu = 1}, Well{}),
                 Leapfrog{}, Periodic(box), backend, Precision{}, Watch{.stop = 1e9}); // the well is a source to it
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> noise(-0.01, 0.01);
    const double top = light * (potential(L / 2) - potential(half)); // pressure at the interface
    s.fill(box, dx, [&](auto& p, std::size_t i) {
        const auto x = p.at(position, i);
        const bool is_heavy = std::abs(x[1]) < half;
        const double rest = is_heavy ? heavy : light;
        const double above = top + rest * (potential(half) - potential(x[1]));
        p.put(position, i, {x[0] + dx * noise(random), x[1] + dx * noise(random)});
        p.put(rest_density, i, rest);
        p.put(density, i, rest * (1 + above / stiffness));
        p.put(mass, i, rest * (1 + above / stiffness) * dx * dx);
    });
    End end;
    try {
        s.run({.steps = steps, .dt = 0.25 * 1.6 * dx / (c_heavy * std::sqrt(heavy / light))});
    }
    catch (Stop const& stop) {
        end.stop = stop.name();
    }
    end.warnings = s.report().warnings;
    auto const& p = s.particles();
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double y = std::abs(p.at(position, i)[1]), force = p.at(mass, i) * p.at(acceleration, i)[0];
        end.across = std::max(end.across, (p.at(rest_density, i) > light ? y - half : half - y) / dx);
        sum += force, all += std::abs(force);
        end.fastest = std::max(end.fastest, std::sqrt(p.at(velocity, i).squaredNorm()));
    }
    end.balance = std::abs(sum) / all;
    return end;
}

// Asked: flat to one spacing after 1e4 steps, forces in balance to 1e-13 of the largest.
TEST(Layers, X03HeavyBelowLightStayFlat)
{
    const End end = settle<1>(10000);
    EXPECT_EQ(end.stop, "");
    EXPECT_LE(end.across, 1);
    EXPECT_LE(end.balance, 1e-13);
    EXPECT_THAT(end.warnings, Not(Contains(HasSubstr("densities differ"))));
    std::printf("  %.3g spacings across, balance %.2g, %.3g m/s\n", end.across, end.balance, end.fastest);
}
TEST(Layers, X03HeavyBelowLightStayFlatInFloatOnTwoThreads)
{
    const End end = settle<1, Float>(10000, Threads{2});
    EXPECT_EQ(end.stop, "");
    EXPECT_LE(end.across, 1);
    EXPECT_LE(end.balance, 1e-13 * 0x1p29); // the digits that a float has less
    std::printf("  %.3g spacings across, balance %.2g, %.3g m/s\n", end.across, end.balance, end.fastest);
}
TEST(Layers, X03SumsWithSigmaTwoWarnAndAreStopped)
{
    const End end = settle<2>(10000);
    EXPECT_THAT(end.warnings, Contains(HasSubstr("sigma = 2 are not made")));
    EXPECT_NE(end.stop, "");
    std::printf("  %s\n", end.stop.c_str());
}

} // namespace
