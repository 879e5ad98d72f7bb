// SPDX-License-Identifier: BSD-3-Clause
// Grains against closed solutions: bounces, two in a press, a ball that slips and then rolls, a gas that cools.
#include "physics/grains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {
using namespace grains;
constexpr double pi = std::numbers::pi, g = 9.81;

// A plane for a few small grains: a grain endlessly larger and heavier, which gravity leaves where it is.
constexpr double endless = 1e6, heavy = 1e30;
struct GravityOfSmall {
    static constexpr Fields reads{mass};
    static constexpr Fields adds{acceleration};
    void operator()(auto& i) const
    {
        using V = std::remove_cvref_t<decltype(i[mass])>;
        Vec<2, V> down;
        down[0] = V(0), down[1] = where(i[mass] < V(1e20), V(-g), V(0));
        i[acceleration] += down;
    }
};
struct Small {
    Vec<2, double> x, v;
    double mass, radius;
};
/// Small grains on a floor at y = 0, and under a ceiling.
template <class I = Leapfrog, class... T>
auto on_floor(std::vector<Small> const& small, double ceiling, T... term)
{
    const double largest = endless * small[0].radius;
    Simulation sim(dem<2>(Mixture{.largest = largest}, GravityOfSmall{}, term...), I{}, Open{}, Serial{}, Double{},
                   NoWatch{});
    auto& p = sim.particles();
    p.resize(small.size() + (ceiling > 0 ? 2 : 1));
    for (std::size_t i = 0; i < p.size(); ++i) {
        const bool real = i < small.size();
        p.put(mass, i, real ? small[i].mass : heavy), p.put(radius, i, real ? small[i].radius : largest);
        if (real) p.put(position, i, small[i].x), p.put(velocity, i, small[i].v);
    }
    p.put(position, small.size(), {{0, -largest}});
    if (ceiling > 0) p.put(position, small.size() + 1, {{0, ceiling + largest}});
    sim.prepare();
    return sim;
}
std::size_t index_of(auto const& sim, std::uint32_t id)
{
    auto const& ids = sim.particles().id();
    return std::size_t(std::find(ids.begin(), ids.end(), id) - ids.begin());
}
double at(auto const& sim, std::uint32_t id, auto field, int c)
{
    return sim.particles().at(field, index_of(sim, id))[c];
}

// MFIX DEM01: a sphere of 0.2 m, 2600 kg/m^3, falls from 0.5 m. Flight is exact to rounding; the k-th apex is at
// r + e^(2k) (h0 - r) for a stiff spring (numerics V46).
TEST(Bounce, FliesExactlyAndReboundsToTheHeightOfItsRestitution)
{
    const double r = 0.1, m = 2600 * 4.0 / 3 * pi * r * r * r, h0 = 0.5;
    for (double e : {1.0, 0.8}) {
        const LinearSpring spring{.k = 5e8};
        const double t_c = pi / spring.contact_frequency(2 * m), dt = t_c / 100;
        auto run = [&](auto scene) {
            const double y0 = h0;
            double t = 0;
            while (t < 0.25) scene.run({.steps = 1, .dt = dt}), t += dt;
            EXPECT_NEAR(at(scene, 0, position, 1) / (y0 - 0.5 * g * t * t), 1, 1e-9); // of thousands of additions
            std::vector<double> apex;
            double before = -1;
            for (int n = 0; apex.size() < 3 && n < 2000000; ++n) {
                scene.run({.steps = 1, .dt = dt});
                const double v = at(scene, 0, velocity, 1);
                if (before > 0 && v <= 0) apex.push_back(at(scene, 0, position, 1) + 0.5 * v * v / g);
                before = v;
            }
            ASSERT_EQ(apex.size(), 3u);
            for (int k = 1; k <= 3; ++k)
                EXPECT_NEAR((apex[std::size_t(k - 1)] - r) / ((h0 - r) * std::pow(e, 2 * k)), 1, 5e-3)
                    << e << ", bounce " << k;
        };
        const Small ball{{{0, h0}}, {{0, 0}}, m, r};
        if (e < 1) run(on_floor({ball}, 0, spring, Dashpot{.e = e}));
        else run(on_floor({ball}, 0, spring));
    }
}

// MFIX DEM03: two grains pressed between floor and ceiling: a linear oscillator of two masses.
TEST(Press, MovesAsTheLinearOscillator)
{
    const double r = 0.5e-3, k = 1e3, height = 1.8e-3;
    const double m[2] = {2e4 * 4.0 / 3 * pi * r * r * r, 1e4 * 4.0 / 3 * pi * r * r * r};
    const double start[2] = {0.46e-3, 1.33e-3};
    // m y'' = K y + b: eigenvalues of M^-1 K by hand.
    const double a00 = -2 * k / m[0], a01 = k / m[0], a10 = k / m[1], a11 = -2 * k / m[1];
    const double b0 = (k * r - 2 * k * r) / m[0] - g, b1 = (2 * k * r + k * (height - r)) / m[1] - g;
    const double det = a00 * a11 - a01 * a10;
    const double rest[2] = {-(a11 * b0 - a01 * b1) / det, -(-a10 * b0 + a00 * b1) / det};
    const double half = 0.5 * (a00 + a11), root = std::sqrt(half * half - det);
    const double lambda[2] = {half + root, half - root};
    auto exact = [&](double t, int which) {
        double z[2] = {start[0] - rest[0], start[1] - rest[1]}, sum = 0;
        for (int s = 0; s < 2; ++s) { // the projector on eigenvalue s: (A - other)/(this - other)
            const double other = lambda[1 - s], gap = lambda[s] - other;
            const double part[2] = {((a00 - other) * z[0] + a01 * z[1]) / gap,
                                    (a10 * z[0] + (a11 - other) * z[1]) / gap};
            sum += part[which] * std::cos(std::sqrt(-lambda[s]) * t);
        }
        return rest[which] + sum;
    };
    const double t_c = pi / std::sqrt(-lambda[1]), until = 4 * t_c;
    auto error = [&](int steps) {
        auto sim =
            on_floor({{{{0, start[0]}}, {}, m[0], r}, {{{0, start[1]}}, {}, m[1], r}}, height, LinearSpring{.k = k});
        sim.run({.steps = steps, .dt = until / steps});
        return std::max(std::abs(at(sim, 0, position, 1) - exact(until, 0)),
                        std::abs(at(sim, 1, position, 1) - exact(until, 1)));
    };
    const double coarse = error(1000), fine = error(4000);
    EXPECT_LE(fine / height, 1e-6);
    EXPECT_NEAR(coarse / fine, 16, 1.6); // second order
}

// MFIX DEM04, as a disc: it slips until t = u0/(3 mu g), then rolls at 2 u0/3 (a sphere: 2 u0/(7 mu g), 5 u0/7).
TEST(Rolling, BeginsWhenFrictionHasSpentTheSlip)
{
    const double r = 0.01, m = 0.1, u0 = 0.5, mu = 0.3;
    const LinearSpring spring{.k = 1e6};
    const double sunk = m * g / spring.k, dt = pi / spring.contact_frequency(2 * m) / 25;
    auto sim = on_floor({{{{0, r - sunk}}, {{u0, 0}}, m, r}}, 0, spring, Dashpot{.e = 0.5}, Friction{.mu = mu});
    const double when = u0 / (3 * mu * g);
    double rolls = 0;
    while (sim.time() < 1.5 * when) {
        sim.run({.steps = 1, .dt = dt});
        const double slip = at(sim, 0, velocity, 0) + r * at(sim, 0, angular_velocity, 0);
        if (rolls == 0 && slip < 1e-3 * u0) rolls = sim.time();
    }
    EXPECT_NEAR(at(sim, 0, velocity, 0) / (2 * u0 / 3), 1, 5e-4);
    EXPECT_NEAR(-r * at(sim, 0, angular_velocity, 0) / (2 * u0 / 3), 1, 5e-4);
    EXPECT_NEAR(rolls / when, 1, 5e-3);
    RecordProperty("speed", std::to_string(at(sim, 0, velocity, 0) / (2 * u0 / 3)));
    RecordProperty("rolls_at", std::to_string(rolls / when));
}

/// N discs in a periodic box at a fraction, at random speeds of 0.5 m/s.
template <class I = Leapfrog, class... T>
auto gas(int side, double fraction, T... term)
{
    const double r = 0.01, pitch = std::sqrt(pi * r * r / fraction);
    Simulation sim(dem<2>({.mass = 0.1, .radius = r}, LinearSpring{.k = 1e5}, term...), I{},
                   Periodic(Box<2>{{}, {{side * pitch, side * pitch}}}), Serial{}, Double{}, NoWatch{});
    oracle::Dice dice(17);
    for (int n = 0; n < side * side; ++n) {
        const double angle = dice.real(0, 2 * pi);
        sim.add({{(n % side + 0.5) * pitch, (n / side + 0.5) * pitch}},
                {{0.5 * std::cos(angle), 0.5 * std::sin(angle)}});
    }
    return sim;
}
// Numerics V51: 1024 discs, a fraction of 0.2, at least 1e5 contacts: energy walks at random, within 1 %.
TEST(LongGas, OfElasticDiscsKeepsItsEnergy)
{
    auto sim = gas(32, 0.2);
    const double e0 = 0.5 * 0.1 * 0.25 * 1024, dt = 1e-4;
    std::vector<double> x, y;
    for (int n = 0; n < 1000; ++n) {
        sim.run({.steps = 100, .dt = dt});
        sim.make_lists_current();
        x.push_back(sim.time()), y.push_back(sim.energy().total() / e0 - 1);
    }
    EXPECT_LE(
        std::abs(*std::max_element(y.begin(), y.end(), [](double a, double b) { return std::abs(a) < std::abs(b); })),
        1e-2);
    double mx = 0, my = 0, sxx = 0, sxy = 0, square = 0;
    for (std::size_t n = 0; n < x.size(); ++n) mx += x[n] / double(x.size()), my += y[n] / double(x.size());
    for (std::size_t n = 0; n < x.size(); ++n) sxx += (x[n] - mx) * (x[n] - mx), sxy += (x[n] - mx) * (y[n] - my);
    for (std::size_t n = 1; n < x.size(); ++n) square += (y[n] - y[n - 1]) * (y[n] - y[n - 1]); // of the walk
    const double walk = std::sqrt(square / x.back());                                           // per root second
    const double slope = sxy / sxx, of_a_walk = walk * std::sqrt(1.2 / x.back()); // of a fit to one: sqrt(6/5 s^2/T)
    EXPECT_LE(std::abs(slope), 3 * of_a_walk);
    RecordProperty("per_root_second", std::to_string(walk));
    std::printf("energy walks %.2e per root second; slope %.2e +- %.2e per second\n", walk, slope, of_a_walk);
}
// Haff (1983): T = T0/(1 + t/tau)^2, 1/tau = (1 - e^2) omega_E/(2 d), omega_E = 2 sqrt(pi) n sigma chi sqrt(T/m), in the
// homogeneous phase, t <= 5 tau: within 5 % (numerics V54). The midpoint method, since e of a dashpot is of first order under
// leapfrog. chi of Verlet & Levesque (1982): (1 - 7 phi/16)/(1 - phi)^2.
TEST(LongGas, OfInelasticDiscsCoolsByHaff)
{
    const double e = 0.9, fraction = 0.1, m = 0.1, r = 0.01;
    auto sim = gas<RungeKutta2>(32, fraction, Dashpot{.e = e});
    auto elastic = gas(32, fraction); // its velocities mix first: the law is for a Maxwellian
    elastic.run({.until = 1.5, .dt = 8e-5});
    auto& p = sim.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        const std::size_t from = index_of(elastic, p.id()[i]);
        p.put(position, i, elastic.particles().at(position, from)),
            p.put(velocity, i, elastic.particles().at(velocity, from));
    }
    sim.prepare();
    auto temperature = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < p.size(); ++i) sum += 0.5 * m * p.at(velocity, i).squaredNorm();
        return sum / double(p.size()); // m <v^2>/2 in two dimensions
    };
    const double n = fraction / (pi * r * r), chi = (1 - 7 * fraction / 16) / ((1 - fraction) * (1 - fraction));
    const double t0 = temperature();
    const double rate = 2 * std::sqrt(pi) * n * 2 * r * chi * std::sqrt(t0 / m), tau = 4 / ((1 - e * e) * rate);
    double furthest = 0;
    for (int k = 1; k <= 20; ++k) {
        sim.run({.until = 5 * tau * k / 20, .dt = 4e-5});
        const double law = t0 / std::pow(1 + sim.time() / tau, 2);
        furthest = std::max(furthest, std::abs(temperature() / law - 1));
    }
    EXPECT_LE(furthest, 0.05);
    std::printf("Haff: furthest %.3f, tau %.2f s\n", furthest, tau);
}

} // namespace
