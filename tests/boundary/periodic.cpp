// SPDX-License-Identifier: BSD-3-Clause
#include "spate/spate.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace {

using namespace spate;

constexpr double r = 0.01;
const Box<2> box{{{-0.1, 0.2}}, {{0.1, 0.3}}};

template <class... Options>
auto grains(Options... options)
{
    return Simulation(dem<2>({.mass = 0.1, .radius = r}, LinearSpring{.k = 1e5}), Leapfrog{}, Periodic(box, options...),
                      Serial{}, Double{}, Watch{.overlap = 2});
}
std::size_t place_of(auto const& sim, std::uint32_t id)
{
    auto const& all = sim.particles().id();
    return std::size_t(std::find(all.begin(), all.end(), id) - all.begin());
}

TEST(Periodic, OneOpenFaceOpensItsAxis)
{
    const Periodic channel(box, open(top));
    EXPECT_TRUE(channel.edges<2>().periodic(0));
    EXPECT_FALSE(channel.edges<2>().periodic(1));
    EXPECT_EQ(channel.edges<2>().at(1, false), Edge::open);
    EXPECT_EQ(channel.edges<2>().at(1, true), Edge::open);
}

// Two discs that overlap by 0.4 r: apart by d in space, the same wherever the box is cut.
TEST(Periodic, APairAcrossFacesOrACornerActsAsOneInside)
{
    const Vec<2, double> d{{1.28 * r, 0.96 * r}}; // of length 1.6 r
    Vec<2, double> inside{};
    for (Vec<2, double> x :
         {Vec<2, double>{{0, 0.25}}, {{0.1 - 0.5 * r, 0.25}}, {{0, 0.3 - 0.5 * r}}, {{0.1 - 0.5 * r, 0.3 - 0.5 * r}}}) {
        auto sim = grains();
        Vec<2, double> y = x + d;
        for (int c = 0; c < 2; ++c)
            if (y[c] >= box.hi[c]) y[c] -= box.size()[c];
        sim.add(x);
        sim.add(y);
        sim.run({.steps = 1, .dt = 1e-5});
        const auto v = sim.particles().at(velocity, place_of(sim, 0)),
                   w = sim.particles().at(velocity, place_of(sim, 1));
        if (inside == Vec<2, double>{}) inside = v;
        EXPECT_LT(v[0], 0);
        EXPECT_LT(v[1], 0);
        for (int c = 0; c < 2; ++c) {
            EXPECT_NEAR(v[c], inside[c], 1e-12 * std::abs(inside[c]));
            EXPECT_NEAR(w[c], -v[c], 1e-13 * std::abs(v[c]));
        }
        EXPECT_NEAR(sim.system().pair_energy(), 0.5 * 1e5 * 0.16 * r * r, 1e-3 * 0.5 * 1e5 * 0.16 * r * r);
    }
}
// The images of an axis that is open do not exist.
TEST(Periodic, APairAcrossAnOpenFaceDoesNotAct)
{
    auto sim = grains(open(top, bottom));
    sim.add({{0, 0.2 + 0.3 * r}});
    sim.add({{0, 0.3 - 0.3 * r}});
    sim.run({.steps = 1, .dt = 1e-5});
    for (std::size_t i : {0u, 1u}) EXPECT_EQ(sim.particles().at(velocity, i), (Vec<2, double>{}));
}
TEST(Periodic, WhoLeavesComesBackOnTheOtherSide)
{
    auto sim = grains();
    const double speed = 7, dt = 1e-3;
    sim.add({{0.05, 0.25}}, {{speed, -3}});
    const auto start = sim.particles().at(position, 0);
    for (int n = 1; n <= 500; ++n) { // 17 times around x, 15 times around y
        sim.run({.steps = 1, .dt = dt});
        sim.system().rebuild();
        const auto x = sim.particles().at(position, 0);
        const Vec<2, double> flown{{speed * n * dt, -3 * n * dt}};
        for (int c = 0; c < 2; ++c) {
            ASSERT_GE(x[c], box.lo[c]);
            ASSERT_LT(x[c], box.hi[c]); // half-open
            const double turns = (x[c] - start[c] - flown[c]) / box.size()[c];
            ASSERT_NEAR(turns, std::round(turns), 1e-11);
        }
    }
}
// Far beyond the box, at once: a wrap is a floor, not one period.
TEST(Periodic, AJumpOfManyPeriodsIsWrapped)
{
    for (double far : {-1e6, 12345.0, 1e6}) {
        auto sim = grains();
        sim.add({{0.03 + far * box.size()[0], 0.27 - far * box.size()[1]}});
        sim.run({.steps = 1, .dt = 1e-3});
        const auto x = sim.particles().at(position, 0);
        EXPECT_NEAR(x[0], 0.03, 1e-9);
        EXPECT_NEAR(x[1], 0.27, 1e-9);
    }
}
TEST(Periodic, AParticleOnAFaceIsInOneCell)
{
    for (double x : {-0.1, 0.1, std::nextafter(0.1, 0), std::nextafter(-0.1, -1)}) {
        auto sim = grains();
        sim.add({{x, 0.25}});
        sim.add({{x < 0 ? x + 1.6 * r : -0.1 + 1.6 * r, 0.25}});
        sim.run({.steps = 1, .dt = 1e-5});
        EXPECT_EQ(sim.system().pairs(), 2) << x; // one each way, not two
        const double v = sim.particles().at(velocity, place_of(sim, 1))[0];
        EXPECT_NEAR(v / (1e5 * 0.4 * r / 0.1 * 1e-5), 1, 1e-3) << x;
    }
}
// A shift of everybody by any vector changes positions only, and momentum is kept across faces.
TEST(Periodic, HasNoSpecialPlace)
{
    std::mt19937 random(5);
    auto uniform = [&] { return double(random()) / 2147483648.0 - 1; };
    std::vector<Vec<2, double>> x, v;
    for (int n = 0; n < 32; ++n) {
        x.push_back({{-0.1 + (n % 8 + 0.5) * 0.025, 0.2 + (n / 8 + 0.5) * 0.025}});
        v.push_back({{uniform(), uniform()}});
    }
    std::vector<Vec<2, double>> first;
    for (Vec<2, double> shift : {Vec<2, double>{}, {{0.0125, 0}}, {{0, 0.0125}}, {{0.0371, -0.0218}}}) {
        auto sim = grains();
        for (std::size_t n = 0; n < x.size(); ++n) sim.add(x[n] + shift, v[n]);
        sim.run({.steps = 200, .dt = 5e-5});
        Vec<2, double> p{}, p0{};
        double moved = 0;
        for (std::size_t n = 0; n < x.size(); ++n) {
            const auto now = sim.particles().at(velocity, place_of(sim, std::uint32_t(n)));
            p += now, p0 += v[n];
            moved = std::max(moved, (now - v[n]).squaredNorm());
            if (first.size() < x.size()) first.push_back(now);
            for (int c = 0; c < 2; ++c) EXPECT_NEAR(now[c], first[n][c], 1e-8) << "disc " << n;
        }
        EXPECT_GT(moved, 0.1); // there were collisions
        for (int c = 0; c < 2; ++c) EXPECT_NEAR(p[c], p0[c], 1e-13 * 32);
    }
}
TEST(Periodic, MustHoldTwoReaches)
{
    const Periodic space(box);
    EXPECT_NO_THROW(space.check(0.0499));
    EXPECT_THROW(space.check(0.0501), BadInput);
    EXPECT_NO_THROW(Periodic(box, open(top)).check(0.0999)); // only along x
    EXPECT_THROW(Periodic(box, open(top)).check(0.1001), BadInput);
}

} // namespace
