// SPDX-License-Identifier: BSD-3-Clause
// Mixed: pairs in float, state in double. Its rates are those of double to the rounding of a float wherever the particles
// lie; its bits depend on nobody; what it adds to the error of a flow is small beside that of the spacing.
#include "simulation/scenes.hpp"

#include "models/internal_flow.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace scenes;

/// The rates of a jittered block at `at`, by id: the change of density, and the acceleration.
template <class Precision>
std::vector<std::array<double, 3>> rates(double at, double h)
{
    const double dx = h / 1.3;
    auto water = wcsph(CubicSpline<2>{.h = h}, LinearEos{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, PressureForce<2>{},
                       LaminarViscosity{.mu = 1});
    Simulation s(water, SymplecticEuler{}, Open{}, Serial{}, Precision{});
    std::mt19937 random(5);
    auto dice = [&] { return double(random()) / 2147483648.0 - 1; };
    const Vec<2, double> corner{at, -at};
    s.fill(Box<2>{corner, corner + Vec<2, double>{12 * dx, 12 * dx}}, dx, [&](auto& p, std::size_t i) {
        // Places are whole multiples of 2^-30 m: the same block wherever it lies.
        Vec<2, double> x = p.at(position, i);
        const auto number = double(i);
        x[0] = std::floor(number / 12) * dx + 0.2 * dx * dice(), x[1] = std::fmod(number, 12) * dx + 0.2 * dx * dice();
        for (int c = 0; c < 2; ++c) x[c] = std::round(x[c] * 0x1p30) * 0x1p-30 + corner[c];
        p.put(position, i, x);
        p.put(velocity, i, {dice(), dice()});
        p.put(density, i, 1000 * (1 + 0.01 * dice()));
    });
    s.prepare();
    s.system().rebuild();
    s.system().rates(s.system().all);
    auto const& p = s.particles();
    std::vector<std::array<double, 3>> r(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto a = p.at(acceleration, i);
        r[p.id()[i]] = {p.at(density_rate, i), a[0], a[1]};
    }
    return r;
}
/// Root of the sum of squared differences over that of squares, the worst of the three rates.
double difference(std::vector<std::array<double, 3>> const& a, std::vector<std::array<double, 3>> const& b)
{
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        double d = 0, n = 0;
        for (std::size_t i = 0; i < b.size(); ++i)
            d += (a[i][c] - b[i][c]) * (a[i][c] - b[i][c]), n += b[i][c] * b[i][c];
        worst = std::max(worst, std::sqrt(d / n));
    }
    return worst;
}
/// What is told of a block of 12 by 12 at its first step; the particle that lies in the place of another is this one's.
std::vector<std::string> told_of(std::size_t twice)
{
    const double dx = 0.0625 / 1.3;
    auto water =
        wcsph(CubicSpline<2>{.h = 0.0625}, LinearEos{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, PressureForce<2>{});
    Simulation s(water, SymplecticEuler{}, Open{}, Serial{}, Mixed{});
    s.fill(Box<2>{{{0, 0}}, {{12 * dx, 12 * dx}}}, dx, [&](auto& p, std::size_t i) {
        if (i == twice) p.put(position, i, p.at(position, i - 100));
    });
    s.run({.steps = 1});
    return s.report().warnings;
}
// Lists are as wide as the packs of pairs, not of particles: a walk over them must know whose is whose.
TEST(Mixed, TellsOfTwoAtOnePlaceAndOfNoOthers)
{
    EXPECT_THAT(told_of(1000), testing::IsEmpty());
    EXPECT_THAT(told_of(130), testing::ElementsAre("particles 30 and 130 are at one place, where no force parts them"));
}
// A hundred roundings of 2^-24, of which those of a sum meet at random.
TEST(Mixed, HasTheRatesOfDouble)
{
    const auto exact = rates<Double>(0, 0.0625);
    EXPECT_LT(difference(rates<Mixed>(0, 0.0625), exact), 100 * 0x1p-24);
    EXPECT_GT(difference(rates<Mixed>(0, 0.0625), exact), 0x1p-30); // it is no double
}
// Numerics X15: 1e-5 at x = 1e6 m with h = 1e-3 m. There a double has 2^-33 m, so a place of 2^-30 m is exact.
TEST(Mixed, HasTheRatesOfDoubleFarFromTheOrigin)
{
    const double h = 0x1p-10, far = 0x1p20;
    const auto exact = rates<Double>(0, h);
    EXPECT_LT(difference(rates<Double>(far, h), exact), 1e-12);
    EXPECT_LT(difference(rates<Mixed>(far, h), exact), 1e-5);
}
TEST(Mixed, HasTheSameBitsForThreadsAndCells)
{
    const auto reference = dam_break<Mixed>(RungeKutta2{}, Adami{}, Threads{1});
    EXPECT_GE(reference.rebuilds, 20);
    EXPECT_EQ((dam_break<Mixed>(RungeKutta2{}, Adami{}, Threads{2, 3}).hash), reference.hash);
}
// Images of a periodic box have tails of their own.
TEST(Mixed, HasTheSameBitsForThreadsInAPeriodicBox)
{
    EXPECT_EQ((vortices<Watch, Mixed>(Threads{1}).hash), (vortices<Watch, Mixed>(Threads{2, 3}).hash));
}

/// The largest error of Poiseuille flow at t = 0.225 s, 20 across, over the speed at the end.
template <class Precision>
double error_of_poiseuille()
{
    constexpr double L = 1e-3, nu = 1e-6, V0 = 1.25e-5, dx = L / 20, pi = 3.141592653589793;
    const Box<2> box{{0, 0}, {0.4 * L, L}};
    Simulation s(models::internal_flow(dx, 1000, nu, V0, Gravity<2>{{8 * nu * V0 / (L * L), 0}}), SymplecticEuler{},
                 Bce(box, dx, Adami{}, periodic(x_axis), no_slip), Serial{}, Precision{});
    s.fill(box, dx);
    s.run({.until = 0.225});
    double most = 0;
    auto const& p = s.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double y = p.at(position, i)[1] / L;
        double u = 4 * y * (1 - y);
        for (int n = 1; n < 60; n += 2)
            u -= 32 / (pi * pi * pi * n * n * n) * std::sin(n * pi * y) *
                 std::exp(-nu * n * n * pi * pi * s.time() / (L * L));
        most = std::max(most, std::abs(p.at(velocity, i)[0] / V0 - u));
    }
    return most;
}
// Numerics D.4: Mixed adds at most 5 % to the error of the spacing.
TEST(Mixed, HasTheErrorOfDouble)
{
    const double exact = error_of_poiseuille<Double>(), mixed = error_of_poiseuille<Mixed>();
    std::printf("largest error over V0: double %.6f, mixed %.6f\n", exact, mixed);
    EXPECT_NEAR(mixed / exact, 1, 0.05);
}

} // namespace
