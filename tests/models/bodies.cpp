// SPDX-License-Identifier: BSD-3-Clause
// Bodies that move by the forces on them: a disc that sinks in a box (Glowinski et al. 2001; Wan & Turek 2006), a raft at the
// draught of Archimedes and at the heel of its metacentre, a body of the density of water: numerics V33, V35, V36.
#include "models/case.hpp"
#include "models/internal_flow.hpp"
#include "models/results.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace spate;
using At = Vec<2, double>;

double length(auto const& v) { return std::sqrt(v.squaredNorm()); }
auto const& body_of(auto const& scene) { return scene.system().boundary().bodies()[0]; }

// ---- V33
/// The largest Reynolds number rho_s D U/mu of a disc of 0.25 cm that starts from rest in a box of 2 cm by 6 cm, all in units
/// of centimetre, gram and second. The fluid has no weight: of the disc's what the fluid's would bear is taken away, the
/// same in a closed box.
/// \param n  spacings in its diameter    \param fastest  speed that the speed of sound is chosen for    \param until  [s]
double sink(int n, double rho_s, double mu, double fastest, double until)
{
    constexpr double D = 0.25, g = 981;
    const double dx = D / n;
    const Sphere<2> disc{{1, 4}, D / 2};
    const Box<2> box{{0, 0}, {2, 6}};
    double area = 0; // of the points of the lattice in it
    for (double x = dx / 2; x < 2; x += dx)
        for (double y = 3.5 + dx / 2; y < 4.5; y += dx) area += disc.distance({x, y}) <= 1e-9 * dx ? dx * dx : 0;
    const Floating<2> law{.density = rho_s, .load = {{0, -(rho_s - 1) * area * g}}};
    Simulation s(models::internal_flow(dx, 1, mu, fastest), SymplecticEuler{},
                 Bce(box, dx, Adami{}, no_slip, obstacle(disc, law)), Threads{});
    s.fill(box, dx);
    auto file = models::results("sinking_disc_" + std::to_string(n) + "_" + text(rho_s) + ".csv", "t,y,v,Re");
    double most = 0;
    constexpr int rows = 100;
    for (int k = 1; k <= rows; ++k) {
        s.run({.until = until * k / rows});
        auto const& b = body_of(s);
        const double Re = rho_s * D * length(b.state.velocity) / mu;
        most = std::max(most, Re);
        file << s.time() << ',' << b.place()[1] << ',' << b.state.velocity[1] << ',' << Re << '\n';
    }
    return most;
}
constexpr auto reynolds = "error of the largest Reynolds number";
TEST(LongSinkingDisc, HasTheReynoldsNumberOfGlowinskiWhenCoarse)
{
    const models::Case c("V33", "rho_s = 1.25, mu = 0.1", 10);
    c.told(reynolds, std::abs(sink(10, 1.25, 0.1, 6, 0.6) / 17.27 - 1));
}
TEST(LongSinkingDisc, HasTheReynoldsNumberOfGlowinski) // 5 %: numerics V33
{
    const models::Case c("V33", "rho_s = 1.25, mu = 0.1", 20);
    c.at_most(reynolds, std::abs(sink(20, 1.25, 0.1, 6, 0.6) / 17.27 - 1), 0.05);
}
TEST(LongSinkingDisc, SinksFasterThanGlowinskisAtTheHigherReynoldsNumber) // 10 %: numerics V33
{
    const models::Case c("V33", "rho_s = 1.5, mu = 0.01", 20);
    c.known_gap(reynolds, std::abs(sink(20, 1.5, 0.01, 12, 0.33) / 438.6 - 1), "V33 Reynolds number rho_s 1.5");
}

// ---- V35, V36
constexpr double rho0 = 1000, dx = 0.02, gravity = 9.81, level = 0.4, breadth = 0.32,
                 height = 0.16; // of a raft, 16 by 8 dx
constexpr double c0 = 28;       // 10 sqrt(2 g level)

/// A raft with its foot at a height, in a tank of a metre.
auto raft(double foot, double alpha, Floating<2> const& law)
{
    auto water = wcsph(WendlandC2<2>{.h = 1.5 * dx}, Tait{.rho0 = rho0, .c0 = c0}, Continuity<2>{},
                       DensityDiffusion{.delta = 0.1}, PressureForce<2>{}, ArtificialViscosity{.alpha = alpha},
                       Gravity<2>{{0, -gravity}});
    const Box<2> solid{{0.34, foot}, {0.34 + breadth, foot + height}};
    Simulation s(water, Leapfrog{}, Bce(Box<2>{{0, 0}, {1, 0.8}}, dx, Adami{}, open(top), obstacle(solid, law)));
    s.fill(Box<2>{{0, 0}, {1, level}}, dx, hydrostatic);
    return s;
}
/// How a raft lies over the last second of a run.
struct Lie {
    double from;                      ///< [s]
    double most = 0, sum = 0;         ///< depth of its foot over that of Archimedes, off by [m]
    double angle = 0, turned = 0;     ///< mean, largest [degrees]
    double highest = -1, lowest = 10; ///< of its centre [m]
    int rows = 0;
    void begin(auto&) {}
    void end(auto&)
    {
        if (rows > 0) sum /= rows, angle /= rows, rows = 0;
    }
    void step(auto& s)
    {
        if (s.time() < from) return;
        auto const& b = body_of(s);
        const double water = double(s.particles().size()) * dx * dx, borne = b.mass / rho0; // areas [m^2]
        const double off = water + borne - (b.place()[1] - height / 2) - borne / breadth;
        const double turn = b.state.attitude.angle * 180 / std::numbers::pi;
        most = std::max(most, std::abs(off)), turned = std::max(turned, std::abs(turn));
        highest = std::max(highest, b.place()[1]), lowest = std::min(lowest, b.place()[1]);
        sum += off, angle += turn, ++rows;
    }
};
/// Begins a spacing too high, and rests after a while: draught within half a spacing, heave below a hundredth of its height,
/// roll below 0.2 degrees: numerics V35.
TEST(LongRaft, ComesToRestAtTheDraughtOfArchimedes)
{
    for (double share : {0.5, 0.7, 0.9}) {
        const models::Case c("V35", "raft of " + text(share) + " of the density of water", 8);
        auto s = raft(dx * std::round((level - share * height) / dx) + dx, 0.2, {.density = share * rho0});
        Lie lie{.from = 9};
        s.run({.until = 10}, lie);
        c.at_most("draught off by [dx]", std::abs(lie.sum) / dx, 0.5);
        c.at_most("heave [height]", (lie.highest - lie.lowest) / height, 0.01);
        c.at_most("roll [degrees]", lie.turned, 0.2);
    }
}
/// Its centre of mass is beside its middle by e: tan phi (GM + BM/2 tan^2 phi) = e, the formula of wall-sided ships. The roll
/// of the plan is the gate, since it has none for a heel.
TEST(LongRaft, HeelsByItsMetacentre)
{
    const double e = 0.004, draught = height / 2, BM = breadth * breadth / (12 * draught), GM = BM - draught / 2;
    double tangent = e / GM;
    for (int k = 0; k < 20; ++k) tangent = e / (GM + BM / 2 * tangent * tangent);
    const double heel = std::atan(tangent) * 180 / std::numbers::pi;
    const models::Case c("V35", "raft of half the density, its mass beside its middle", 8);
    auto s = raft(level - draught, 0.2, {.density = rho0 / 2, .centre = At{{0.5 + e, level}}});
    Lie lie{.from = 5};
    s.run({.until = 6}, lie);
    c.told("heel by theory [degrees]", heel);
    c.at_most("heel off by [degrees]", std::abs(-lie.angle - heel), 0.2);
}
/// A body of the density of water at rest in it: 1e-3 sqrt(g L) for 1e4 steps: numerics V36.
TEST(LongNeutralBody, StaysAtRest)
{
    const models::Case c("V36", "raft of the density of water", 8);
    auto s = raft(0.1, 0.1, {.density = rho0});
    double most = 0;
    for (int k = 0; k < 1000; ++k) {
        s.run({.steps = 10});
        most = std::max(most, length(body_of(s).state.velocity));
    }
    c.at_most("largest speed [sqrt(g L)]", most / std::sqrt(gravity * height), 1e-3);
    c.told("way [dx]", length(body_of(s).state.shift) / dx);
}

} // namespace
