// SPDX-License-Identifier: BSD-3-Clause
// Couette and Poiseuille flow from rest (Morris, Fox & Zhu 1997, section 5) against their series: numerics V12, V13, V14.
#include "models/case.hpp"
#include "models/internal_flow.hpp"
#include "models/results.hpp"
#include "oracle/table.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace spate;

constexpr double L = 1e-3, nu = 1e-6, rho0 = 1000, V0 = 1.25e-5; // width [m], viscosity [m^2/s], fastest flow [m/s]

/// \param n       spacings across
/// \param faster  the speed over that of Morris, Fox & Zhu
template <class... Options>
auto channel(int n, double F, double faster, Options... options)
{
    const double dx = L / n;
    const Box<2> box{{0, 0}, {0.4 * L, L}};
    auto fluid = models::internal_flow(dx, rho0, nu, faster * V0, Gravity<2>{{F, 0}});
    Simulation s(fluid, SymplecticEuler{}, Bce(box, dx, Adami{}, periodic(x_axis), no_slip, options...));
    s.fill(box, dx);
    return s;
}
auto couette(int n) { return channel(n, 0, 1, lid(top, V0, 0.0)); }
auto poiseuille(int n, double faster = 1) { return channel(n, 8 * nu * faster * V0 / (L * L), faster); }

/// u/V0 (Morris, Fox & Zhu 1997): the steady profile and a series that dies out.
double series(std::string const& flow, double y, double t)
{
    const double pi = std::numbers::pi;
    double u = flow == "couette" ? y : 4 * y * (1 - y);
    for (int n = 1; n < 200; ++n) {
        const double wave = std::sin(n * pi * y) * std::exp(-nu * n * n * pi * pi * t / (L * L));
        if (flow == "couette") u += 2 / (n * pi) * (n % 2 == 0 ? 1 : -1) * wave;
        else if (n % 2 == 1) u -= 32 / (pi * pi * pi * n * n * n) * wave;
    }
    return u;
}
/// The largest error of any particle over V0, after each time of the table.
double worst(auto s, int n, std::string const& flow, std::vector<std::string> const& times)
{
    auto file = models::results(flow + "_" + std::to_string(n) + "_profile.csv", "t,y_over_L,u_over_V0,exact");
    double all = 0;
    for (auto const& t : times) {
        s.run({.until = std::stod(t)});
        double most = 0;
        auto const& p = s.particles();
        for (std::size_t i = 0; i < p.size(); ++i) {
            const double y = p.at(position, i)[1] / L, u = p.at(velocity, i)[0] / V0;
            const double exact = series(flow, y, s.time());
            most = std::max(most, std::abs(u - exact));
            if (p.at(position, i)[0] < L / 25) file << t << ',' << y << ',' << u << ',' << exact << '\n';
        }
        std::printf("%s t = %s: largest error %.5f V0\n", flow.c_str(), t.c_str(), most);
        all = std::max(all, most);
    }
    return all;
}
const std::vector<std::string> four{"0.0225", "0.045", "0.1125", "0.225"};

TEST(Channel, SeriesAreThoseOfTheTable)
{
    const auto table = oracle::table("couette_poiseuille_morris1997.csv");
    ASSERT_EQ(table.size(), 21U);
    for (auto const& row : table)
        for (std::string flow : {"couette", "poiseuille"})
            for (auto const& t : four)
                EXPECT_NEAR(series(flow, std::stod(row.at("y_over_L")), std::stod(t)),
                            std::stod(row.at(flow + "_t" + t)), 1e-8);
}
// 1 % at 50 across: numerics V12, V13.
constexpr auto largest = "error of velocity, largest over V0, four times";
TEST(Couette, HasTheVelocityOfItsSeriesAtFourTimes)
{
    const models::Case c("V12", "from rest", 50);
    c.at_most(largest, worst(couette(50), 50, "couette", four), 0.01);
}
TEST(Poiseuille, HasTheVelocityOfItsSeriesAtFourTimes)
{
    const models::Case c("V13", "from rest", 50);
    c.at_most(largest, worst(poiseuille(50), 50, "poiseuille", four), 0.01);
}

// Order 1.5 at least over 20, 40, 80 across; at the time when the profile is sharp. Long: at all four times.
void converges(auto scene, std::string const& flow, std::vector<std::string> const& times)
{
    const std::string id = flow == "couette" ? "V12" : "V13";
    const std::string what = times.size() == 1 ? "error of velocity, largest over V0, t = 0.0225" : largest;
    double e[3];
    for (int k = 0; k < 3; ++k) {
        const models::Case c(id, "from rest", 20 << k);
        e[k] = worst(scene(20 << k), 20 << k, flow, times);
        c.told(what, e[k]);
    }
    models::Case(id, "from rest", 0).at_least("order of the " + what + ", 20 to 80", models::order(e[0], e[2]), 1.5);
    EXPECT_LT(e[1], e[0]);
    EXPECT_LT(e[2], e[1]);
}
TEST(Couette, ConvergesAtFirst) { converges(couette, "couette", {"0.0225"}); }
TEST(Poiseuille, ConvergesAtFirst)
{
    converges([](int n) { return poiseuille(n); }, "poiseuille", {"0.0225"});
}
TEST(LongChannel, CouetteConvergesAtAllTimes) { converges(couette, "couette", four); }
TEST(LongChannel, PoiseuilleConvergesAtAllTimes)
{
    converges([](int n) { return poiseuille(n); }, "poiseuille", four);
}

struct State {
    double drift = 0, middle = 0, empty = 0, error = 0;
};
/// Mean density over rho0 less 1; fastest velocity and largest error over the flow's speed; the emptiest place.
State state(auto const& s, int n, double speed)
{
    auto const& p = s.particles();
    State now;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double y = p.at(position, i)[1] / L, u = p.at(velocity, i)[0] / speed;
        now.drift += (p.at(density, i) / rho0 - 1) / double(p.size());
        now.middle = std::max(now.middle, u), now.error = std::max(now.error, std::abs(u - 4 * y * (1 - y)));
    }
    now.empty = models::emptiest(s, Box<2>{{0, 0}, {0.4 * L, L}}, L / n);
    std::printf("t = %g: density %+.2e, fastest %.5f, error %.5f, emptiest %.3f dx\n", s.time(), now.drift, now.middle,
                now.error, now.empty);
    return now;
}
// To 10 L^2/nu, numerics V14: steady, without voids, density within 1e-4.
TEST(Poiseuille, IsSteadyAfterTenTimesOfViscosity)
{
    const models::Case c("V14", "plates, Re = 0.0125, 10 L^2/nu", 20);
    auto s = poiseuille(20);
    s.run({.until = 9});
    const State before = state(s, 20, V0);
    s.run({.until = 10});
    const State after = state(s, 20, V0);
    c.at_most("drift of density", std::abs(after.drift), 1e-4);
    EXPECT_NEAR(after.middle, before.middle, 1e-3);
    c.at_most("emptiest place [dx]", after.empty, 1);
    c.at_most("error of velocity, largest over V0", after.error, 0.01);
}
// The same at Re = 1, where fluid passes the box 25 times: no voids, no leaks; the speed that the force asks for; the
// drift of its density is a known gap.
TEST(Poiseuille, HasNoVoidsAfterTwentyFivePassages)
{
    constexpr double faster = 80;
    const models::Case c("V14", "plates, Re = 1, 10 L^2/nu", 20);
    auto s = poiseuille(20, faster);
    s.run({.until = 10});
    const State after = state(s, 20, faster * V0);
    c.at_most("emptiest place [dx]", after.empty, 1);
    EXPECT_EQ(Leaks{L / 20}(s), 0);
    // What the force puts in, the plates take out: the momentum is steady.
    s.refresh();
    const double force = WallForce{}(s)[0], weight = rho0 * 0.4 * L * L * 8 * nu * faster * V0 / (L * L);
    std::printf("force on the plates over that on the fluid: %.5f\n", force / weight);
    c.at_most("force on the plates, off by", std::abs(force / weight - 1), 0.01);
    c.known_gap("drift of density", std::abs(after.drift), "V14 density Re 1");
}

} // namespace
