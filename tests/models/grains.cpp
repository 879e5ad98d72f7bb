// SPDX-License-Identifier: BSD-3-Clause
// Grains against closed solutions: bounces, two in a press, a ball that slips and then rolls.
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

} // namespace
