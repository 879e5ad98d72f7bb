// SPDX-License-Identifier: BSD-3-Clause
// X22 and X23: bodies that weigh next to nothing; bodies out of the water, on walls, and in each other.
#include "spate/backend/virtual_ranks.hpp"
#include "spate/spate.hpp"

#include "order/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

namespace {

using namespace spate;
using Point = Vec<2, double>;

constexpr double rho0 = 1000, c0 = 25, dx = 0.02, smoothing = 1.3, gravity = 9.81;
double norm(Point const& x) { return std::sqrt(x.squaredNorm()); }

struct Case {
    double alpha = 0.02;
    Point g{{0, -gravity}};
    Box<2> box{{{0, 0}}, {{0.4, 0.6}}};
};
template <class Precision, class Backend, class W, class... Disc>
auto scene(Case const& c, Precision precision, Backend backend, W watch, Disc... disc)
{
    auto water = wcsph(CubicSpline<2>{smoothing * dx}, Tait{rho0, c0}, Continuity<2>{}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = c.alpha}, Gravity<2>{c.g});
    return Simulation(water, Leapfrog{}, Bce(c.box, dx, Adami{}, open(top), obstacle(disc.first, disc.second)...),
                      backend, precision, watch);
}
using Disc = std::pair<Sphere<2>, Floating<2>>;
auto const& body(auto const& s, int k = 0) { return s.system().boundary().bodies()[k]; }
bool finite(auto const& s)
{
    bool all = true;
    s.system().each_species([&](auto k) {
        auto const& p = s.system().template species<k()>().particles;
        for_each(p.fields, [&](auto f) {
            for (auto const& column : p.column(f))
                for (std::size_t i = 0; i < p.size(); ++i) all = all && std::isfinite(double(column[i]));
        });
    });
    return all;
}
void in_both(auto const& f)
{
    f(Double{}, "double");
    f(Float{}, "float");
}

// ---- X22: lighter than the fluid
constexpr double R = 0.08;
const Sphere<2> low{{{0.2, 0.16}}, R};

struct Rise {
    double way = 0, speed = 0, dt = 0; ///< [m], [m/s], [s]
    std::uint64_t hash = 0;
};
template <class Precision>
Rise risen(double share, double until, Precision precision, int threads)
{
    auto s = scene({}, precision, Threads{threads}, Watch{}, Disc{low, {.density = share * rho0}});
    s.fill(Box<2>{{{0, 0}}, {{0.4, 0.4}}}, dx, hydrostatic);
    s.run({.until = until, .cfl = 0.25});
    EXPECT_TRUE(finite(s));
    return {body(s).state.shift[1], body(s).state.velocity[1], s.dt(), s.state_hash()};
}
/// With the mass of the fluid that it drives: a = g (1 - s)/(s + C), C = 1 of a disc far from walls, more between them
/// (Lamb 1932, art. 68). A body of which the coupling is not bounded would be off by a factor of 1/s.
void expect_rise(double share, double until)
{
    in_both([&]<class Precision>(Precision precision, char const* real) {
        const Rise one = risen(share, until, precision, 1);
        const double free = gravity * (1 - share) * until * until / 2;
        EXPECT_GT(one.way, free / (share + 3)) << real;
        EXPECT_LT(one.way, free / (share + 1)) << real;
        EXPECT_LT(one.speed, 2 * free / until / (share + 1)) << real;
        EXPECT_EQ(risen(share, until, precision, 2).hash, one.hash);
        std::printf("  %s, rho/rho0 = %g: has risen %.4f dx in %g s, as with an added mass of %.2f of the fluid's; "
                    "dt %.3g of h/c0\n",
                    real, share, one.way / dx, until, free / one.way - share, one.dt / (smoothing * dx / c0));
    });
}
TEST(Bodies, X22AHundredthOfTheDensityRisesWithTheAddedMass) { expect_rise(0.01, 0.04); }
TEST(LongBodies, X22ATenThousandthOfTheDensityRisesWithTheAddedMass) { expect_rise(1e-4, 0.04); }

// Without viscosity the body is a mass on the spring of the fluid that holds it: the largest stable step is 2/omega, with
// omega^2 between that of the spring alone and that with the fastest sound of the lattice added.
TEST(Bodies, X22TheLimitIsThatOfTheSpringOfTheFluid)
{
    const double kappa = lattice::table("kernel_stability_constants.csv", "cubic", 2, smoothing, "kappa");
    for (double share : {0.01, 1e-3}) {
        auto make = [&] {
            auto s = scene({.alpha = 0, .g = {}}, Double{}, Threads{1}, Watch{}, Disc{low, {.density = share * rho0}});
            s.fill(Box<2>{{{0, 0}}, {{0.4, 0.4}}}, dx);
            return s;
        };
        auto first = make();
        const double omega = first.system().boundary().body_rate(first.physics().interaction, rho0, c0, 0);
        auto grows = [&](double dt) {
            auto s = make();
            s.system().boundary().bodies()[0].state.velocity = {{1e-6, 2e-6}};
            double most = 0;
            try {
                for (int k = 0; k < 40; ++k)
                    s.run({.steps = 10, .dt = dt}), most = std::max(most, norm(body(s).state.velocity));
            }
            catch (Stop const&) {
                return true;
            }
            return !(most < 1e-3);
        };
        double stable = 1 / omega, not_stable = 4 / omega;
        ASSERT_FALSE(grows(stable));
        ASSERT_TRUE(grows(not_stable));
        while (not_stable / stable > 1.004) {
            const double middle = std::sqrt(stable * not_stable);
            (grows(middle) ? not_stable : stable) = middle;
        }
        const double sound = kappa * c0 / (smoothing * dx);
        EXPECT_LT(stable, 1.05 * 2 / omega);
        EXPECT_GT(stable, 0.95 * 2 / std::hypot(omega, sound));
        std::printf("  rho/rho0 = %g: stable to dt = %.3f/omega, omega = %.3g c0/h\n", share, stable * omega,
                    omega * smoothing * dx / c0);
    }
}

// ---- X23: out of the water, on walls, in each other
/// Two discs, the second above the first.
auto two(auto precision, auto backend, BodyContact const& contact, Point const& g, double apart, double density = 1500)
{
    const Floating<2> law{.density = density, .contact = contact};
    return scene({.alpha = 0.1, .g = g, .box = {{{0, 0}}, {{0.4, 0.8}}}}, precision, backend, Watch{},
                 Disc{{{{0.2, 0.2}}, R}, law}, Disc{{{{0.22, 0.2 + 2 * R + apart}}, R}, law});
}
/// Falls on the floor of an empty tank and bounces.
TEST(Bodies, X23OnAWallOfSpringsItBouncesAsHighAsItFell)
{
    auto s =
        scene({}, Double{}, Threads{1}, Watch{}, Disc{{{{0.2, 0.3}}, R}, {.density = 1500, .contact = {.k = 1e6}}});
    double lowest = 1, back = 0;
    while (s.time() < 0.5) {
        s.run({.steps = 1, .dt = 1e-4});
        const double y = body(s).place()[1];
        lowest = std::min(lowest, y);
        if (lowest < R) back = std::max(back, y);
    }
    EXPECT_LT(lowest, R + dx / 2); // it has been there
    EXPECT_GT(lowest, R - dx);
    EXPECT_NEAR(back, 0.3, 1e-3 * (0.3 - R)); // omega dt = 0.03: (omega dt)^2 of the energy
    EXPECT_LT(std::abs(body(s).state.shift[0]), 1e-9);
}
/// ... and with damping comes to rest where the springs bear it: n k overlap = m g.
TEST(Bodies, X23AtRestOnAWallItIsAsDeepAsItsWeight)
{
    const double k = 2e5;
    const Box<2> cube{{{0.1, 0.04}}, {{0.3, 0.2}}};
    auto water = wcsph(CubicSpline<2>{smoothing * dx}, Tait{rho0, c0}, Continuity<2>{}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -gravity}});
    Simulation s(water, Leapfrog{},
                 Bce(Box<2>{{{0, 0}}, {{0.4, 0.6}}}, dx, Adami{}, open(top),
                     obstacle(cube, Floating<2>{.density = 1500, .contact = {.k = k, .c = 2000}})));
    s.run({.until = 2, .dt = 2e-4});
    const double overlap = body(s).mass * gravity / (10 * k); // ten markers
    EXPECT_NEAR(body(s).place()[1], 0.08 - overlap, 1e-6);
    EXPECT_LT(norm(body(s).state.velocity), 1e-6);
    EXPECT_LT(std::abs(body(s).state.attitude.angle), 1e-9);
}
/// A step a hundred times too long makes more of each bounce: told at the first step, and then a stop.
TEST(Bodies, X23AStepThatNoSpringBearsIsAStop)
{
    auto s = scene({}, Double{}, Threads{1}, Watch{},
                   Disc{{{{0.2, 0.3}}, R}, {.density = 1500, .velocity = {{1, 0}}, .contact = {.k = 1e8}}});
    std::string name;
    try {
        s.run({.steps = 2000, .dt = 1e-2});
    }
    catch (Stop const& stop) {
        name = stop.name();
    }
    EXPECT_TRUE(name == "IndexOverflow" || name == "NonFinite") << name;
    EXPECT_EQ(std::count_if(s.report().warnings.begin(), s.report().warnings.end(),
                            [](auto const& w) { return w.find("more than a body of its mass bears") != w.npos; }),
              1);
}
TEST(Bodies, X23OneThatIsNowhereIsAStopThoughNothingFeelsIt)
{
    auto s = scene({}, Double{}, Threads{1}, Watch{}, Disc{{{{0.2, 0.3}}, R}, {.density = 1500}});
    s.run({.steps = 3});
    s.system().boundary().bodies()[0].torque[0] = std::nan("");
    StopFacts facts;
    try {
        s.run({.steps = 1});
    }
    catch (NonFinite const& stop) {
        facts = stop.facts();
    }
    EXPECT_EQ(facts.quantity, "the state of body 0, or a square of its speed,");
    EXPECT_EQ(facts.step, 3);
}
/// In each other by two spacings, in space without weight: they part, and what both have together stays.
TEST(Bodies, X23InEachOtherTheyPartAndKeepTheirMomentum)
{
    auto s = two(Double{}, Threads{1}, {.k = 1e3}, {}, -2 * dx);
    auto momentum = [&] {
        return body(s, 0).mass * body(s, 0).state.velocity + body(s, 1).mass * body(s, 1).state.velocity;
    };
    auto angular = [&] {
        double sum = 0;
        for (int k : {0, 1})
            sum += body(s, k).state.angular_momentum[0] +
                   body(s, k).mass * cross(body(s, k).place(), body(s, k).state.velocity)[0];
        return sum;
    };
    s.run({.until = 0.15, .dt = 1e-4});
    const double size = body(s, 0).mass * norm(body(s, 0).state.velocity), steps = double(s.steps());
    EXPECT_GT(norm(body(s, 0).place() - body(s, 1).place()), 2 * R);
    EXPECT_GT(size, 1);
    EXPECT_LT(norm(momentum()), steps * 0x1p-52 * size);
    EXPECT_LT(std::abs(angular()), steps * 0x1p-52 * size);
}
/// Two discs fall into shallow water, on each other and on the floor, in double and float, on threads and on ranks.
struct Drop {
    std::uint64_t hash = 0;
    double lowest = 1, apart = 1; ///< of the centres over the floor, and from each other [m]
    bool finite = true;
};
Drop dropped(auto precision, auto backend, double k)
{
    auto s = two(precision, backend, {.k = k, .c = 200}, {{0, -gravity}}, dx, 3000);
    s.fill(Box<2>{{{0, 0}}, {{0.4, 0.12}}}, dx, hydrostatic);
    Drop d;
    while (s.time() < 0.4) {
        s.run({.steps = 20});
        for (int b : {0, 1}) d.lowest = std::min(d.lowest, body(s, b).place()[1]);
        d.apart = std::min(d.apart, norm(body(s, 0).place() - body(s, 1).place()));
    }
    d.finite = finite(s) && std::isfinite(body(s, 0).state.angular_momentum[0]);
    d.hash = s.state_hash();
    return d;
}
TEST(Bodies, X23DroppedIntoWaterTheyKeepApartAndAboveTheFloor)
{
    in_both([](auto precision, char const* real) {
        const Drop one = dropped(precision, Threads{1}, 1e6);
        EXPECT_TRUE(one.finite);
        EXPECT_GT(one.lowest, R - dx); // nothing sinks in by more than a spacing
        EXPECT_GT(one.apart, 2 * R - dx);
        EXPECT_LT(one.apart, 2 * R + dx); // they have met
        EXPECT_LT(one.lowest, R + dx);    // the floor too
        EXPECT_EQ(dropped(precision, Threads{2}, 1e6).hash, one.hash);
        std::printf("  %s: centres %.3f dx above the floor at least, %.3f dx from each other\n", real, one.lowest / dx,
                    one.apart / dx);
    });
    std::vector<Drop> all(3);
    VirtualRanks(3).run([&](auto rank) {
        all[std::size_t(rank.rank())] = dropped(Double{}, OnRank{rank, Serial{}, 2}, 1e6);
    });
    const auto hash = dropped(Double{}, Threads{1}, 1e6).hash;
    for (auto const& d : all) EXPECT_EQ(d.hash, hash);
}
/// Without contacts they go through each other and through the floor, and nothing else breaks: no term sees markers of
/// two solids at one place, and markers that see no fluid have no pressure.
TEST(Bodies, X23WithoutContactsMarkersMayLieInEachOther)
{
    in_both([](auto precision, char const*) {
        const Drop one = dropped(precision, Threads{1}, 0);
        EXPECT_TRUE(one.finite);
        EXPECT_LT(one.lowest, R - dx);
    });
}

} // namespace
