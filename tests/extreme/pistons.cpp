// SPDX-License-Identifier: BSD-3-Clause
// X17: a piston at a tenth of the speed of sound, at half of it and above it drives a shock into a fluid at rest; in double
// and float, on one and two threads, on three ranks.
#include "spate/backend/virtual_ranks.hpp"
#include "spate/measure/leaks.hpp"
#include "spate/spate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace spate;

constexpr double dx = 0.02, rho0 = 1000, c0 = 20, tube_length = 2, start = 0.2; // [m], [kg/m^3], [m/s]
const Tait eos{.rho0 = rho0, .c0 = c0};

/// What Rankine and Hugoniot ask of Tait's fluid: with x = rho/rho0, rho0 U = rho (U - u) and p = rho0 U u give
/// (x^7 - 1) (x - 1) / x = 7 (u/c0)^2.
struct Shock {
    double compression, speed, pressure; ///< [-], [m/s], [Pa]
};
Shock shock(double u)
{
    double low = 1, high = 3;
    while (high - low > 1e-12) {
        const double x = 0.5 * (low + high);
        ((std::pow(x, 7) - 1) * (x - 1) / x < 7 * (u / c0) * (u / c0) ? low : high) = x;
    }
    const double U = u * low / (low - 1);
    return {low, U, rho0 * U * u};
}
struct Found {
    std::string end = "ok", message;
    double speed = 0, from_start = 0; ///< of the shock: in the second half of the way, of all of it [m/s]
    double pressure = 0;              ///< behind it [Pa]
    double most = 0;                  ///< largest density [kg/m^3]
    double leaks = 0, time = 0;
    std::uint64_t hash = 0;
    bool finite = true;
};
/// Where the pressure falls below half of that behind the shock, from the piston's start, between two particles [m].
double front_of(auto const& p, double half)
{
    std::vector<std::array<double, 2>> all; // place, pressure
    for (std::size_t i = 0; i < p.size(); ++i) all.push_back({p.at(position, i)[0] - start, p.at(pressure, i)});
    std::sort(all.begin(), all.end());
    std::size_t k = all.size() - 1;
    while (k > 0 && all[k][1] < half) --k;
    if (k + 1 == all.size()) return all[k][0];
    const auto [x, pressed] = all[k];
    const auto [beyond, still] = all[k + 1];
    return x + (beyond - x) * (pressed - half) / (pressed - still);
}
/// Until the shock has come 1.2 m far; its speed is that of the second half of the way, since it starts late.
template <class Precision, class Backend>
Found drive(double mach, Precision precision, Backend backend, double cfl = 0.2)
{
    const double u = mach * c0;
    const Shock theory = shock(u);
    auto fluid = wcsph(CubicSpline<2>{.h = 1.2 * dx}, eos, Continuity<2>{}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 1}, DensityDiffusion{.delta = 0.1});
    const Box<2> box{{0, 0}, {tube_length, 0.2}};
    Bce tube(box, dx, Adami{}, periodic(y_axis), obstacle(Box<2>{{-1, -1}, {start, 1}}, Steady<2>{.velocity = {u, 0}}));
    Simulation s(fluid, RungeKutta2{}, tube, backend, precision);
    s.fill(box, dx);
    Found f;
    double first = 0, at = 0;
    try {
        s.run({.until = 0.6 / theory.speed, .cfl = cfl});
        s.refresh();
        first = front_of(s.particles(), theory.pressure / 2), at = s.time();
        s.run({.until = 1.2 / theory.speed, .cfl = cfl});
    }
    catch (Stop const& stop) {
        f.end = stop.name(), f.message = stop.what(), f.most = rho0 * (1 + s.report().density_change);
        return f;
    }
    s.refresh();
    f.most = rho0 * (1 + s.report().density_change); // on whichever side it is larger
    f.time = s.time(), f.hash = s.state_hash(), f.leaks = Leaks{dx}(s);
    auto const& p = s.particles();
    double sum = 0, n = 0;
    const double piston = u * f.time, shocked = theory.speed * f.time;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double x = p.at(position, i)[0] - start, value = p.at(pressure, i);
        f.finite = f.finite && std::isfinite(value) && std::isfinite(p.at(velocity, i).squaredNorm());
        // The middle half of what is between the piston and the shock.
        if (x > piston + 0.25 * (shocked - piston) && x < piston + 0.75 * (shocked - piston)) sum += value, ++n;
    }
    const double front = front_of(p, theory.pressure / 2);
    f.pressure = sum / n, f.speed = (front - first) / (f.time - at), f.from_start = front / f.time;
    return f;
}
template <class Precision>
class Pistons : public testing::Test {};
using Precisions = testing::Types<Double, Float>;
TYPED_TEST_SUITE(Pistons, Precisions);

TYPED_TEST(Pistons, X17DriveTheShockOfTaitsFluidOrAreStopped)
{
    for (double mach : {0.1, 0.5, 1.1}) {
        const Shock theory = shock(mach * c0);
        const Found one = drive(mach, TypeParam{}, Threads{1}), two = drive(mach, TypeParam{}, Threads{2});
        std::printf(
            "  %s, piston at %.1f c0: %s, shock %+.2f %% (from its start %+.2f %%), pressure %+.2f %%, rho to %.3f rho0 (behind the shock "
            "%.3f)\n",
            std::is_same_v<TypeParam, Float> ? "float" : "double", mach, one.end.c_str(),
            100 * (one.speed / theory.speed - 1), 100 * (one.from_start / theory.speed - 1),
            100 * (one.pressure / theory.pressure - 1), one.most / rho0, theory.compression);
        EXPECT_EQ(one.end, two.end);
        EXPECT_EQ(one.hash, two.hash);
        EXPECT_LE(one.most, 3 * rho0 * (1 + 1e-6)); // what the equation of state knows, or a stop
        if (mach > 0.1 && one.end != "ok") {
            EXPECT_THAT(one.end, testing::AnyOf("EosDomain", "OutOfDomain")) << one.message;
            continue;
        }
        ASSERT_EQ(one.end, "ok") << one.message;
        EXPECT_TRUE(one.finite);
        EXPECT_EQ(one.leaks, 0);
        if (mach > 0.1) continue;
        EXPECT_NEAR(one.speed / theory.speed, 1, 0.03); // X17
        EXPECT_NEAR(one.pressure / theory.pressure, 1, 0.03);
    }
}
TEST(PistonsOnRanks, X17TheSameBitsOnThree)
{
    for (double mach : {0.1, 1.1}) {
        const Found one = drive(mach, Double{}, Threads{1});
        std::vector<Found> found(3);
        VirtualRanks(3).run([&](auto rank) {
            found[std::size_t(rank.rank())] = drive(mach, Double{}, OnRank{rank, Serial{}, 2, Balance{}});
        });
        for (Found const& f : found) {
            EXPECT_EQ(f.end, one.end);
            EXPECT_EQ(f.hash, one.hash);
        }
    }
}

} // namespace
