// SPDX-License-Identifier: BSD-3-Clause
// Elastic planes: a particle in a box goes the way that it would go through mirrored boxes.
#include "spate/boundary/walls.hpp"

#include <spate/spate.hpp>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace spate;
using At = Vec<2, double>;

const Box<2> box{{0, 0}, {1, 0.5}};

/// x unfolded over mirrored boxes of a length, and the sign of the velocity there.
double folded(double x, double L, double& sign)
{
    const double period = std::fmod(std::fmod(x, 2 * L) + 2 * L, 2 * L);
    sign = period < L ? 1 : -1;
    return period < L ? period : 2 * L - period;
}
/// Smoothed particles that do not see each other.
template <class I, class Backend = Serial>
auto gas(I integrator, Backend backend = {})
{
    auto fluid = physics(Smoothing<CubicSpline<2>>{{.h = 0.01}}, Uniform{mass, 1}, Gravity<2>{{0, 0}});
    Simulation s(fluid, integrator, Walls(box), backend);
    s.fill(box, 0.05, [](auto& p, std::size_t i) {
        std::mt19937 random{std::uint32_t(i)};
        std::uniform_real_distribution<double> u(-1, 1);
        p.put(velocity, i, At{u(random), u(random)});
    });
    return s;
}
template <class I>
void expect_mirrored(I integrator)
{
    auto s = gas(integrator);
    auto const& p = s.particles();
    std::vector<At> x0(p.size()), v0(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) x0[p.id()[i]] = p.at(position, i), v0[p.id()[i]] = p.at(velocity, i);
    const double until = 3;
    s.run({.until = until, .dt = 0.02});
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto id = p.id()[i];
        for (int c = 0; c < 2; ++c) {
            double sign = 0;
            const double x = folded(x0[id][c] + until * v0[id][c], box.hi[c], sign);
            EXPECT_NEAR(p.at(position, i)[c], x, 1e-13);
            EXPECT_EQ(p.at(velocity, i)[c], sign * v0[id][c]); // the speed is kept to the last bit
        }
    }
}
TEST(Walls, ReflectSmoothedParticlesAsAMirrorDoes)
{
    expect_mirrored(SymplecticEuler{});
    expect_mirrored(RungeKutta2{});
    expect_mirrored(Leapfrog{});
}
TEST(Walls, BitsDoNotDependOnThreads)
{
    auto one = gas(RungeKutta2{}), two = gas(RungeKutta2{});
    auto three = gas(RungeKutta2{}, Threads{3});
    for (auto* s : {&one, &two}) s->run({.steps = 100, .dt = 0.02});
    three.run({.steps = 100, .dt = 0.02});
    EXPECT_EQ(one.state_hash(), two.state_hash());
    EXPECT_EQ(one.state_hash(), three.state_hash());
}
TEST(Walls, TurnACornerInOneStep)
{
    const Walls w(box);
    At x{1.1, -0.2}, v{3, -4};
    EXPECT_EQ(w.reflect(x, v, 0), Walls<2>::Bounce::some);
    EXPECT_NEAR(x[0], 0.9, 1e-15);
    EXPECT_NEAR(x[1], 0.2, 1e-15);
    EXPECT_EQ(v, (At{-3, 4}));
}
TEST(Walls, TouchAGrainAtItsSurface)
{
    const Walls w(box, open(top));
    At x{0.04, 7}, v{-1, 1};
    EXPECT_EQ(w.reflect(x, v, 0.05), Walls<2>::Bounce::some);
    EXPECT_NEAR(x[0], 0.06, 1e-15);
    EXPECT_EQ(x[1], 7); // over the open top
    EXPECT_EQ(v, (At{1, 1}));
    // A grain of radius 0.05 goes to and fro over 0.9 and 0.4.
    Simulation s(dem<2>({.mass = 0.1, .radius = 0.05}, LinearSpring{.k = 1e4}), SymplecticEuler{}, Walls(box));
    s.add({0.5, 0.25}, {1, 0.3});
    s.run({.until = 5, .dt = 1e-3});
    double sign = 0;
    EXPECT_NEAR(s.particles().at(position, 0)[0], 0.05 + folded(0.45 + 5, 0.9, sign), 1e-11);
    EXPECT_NEAR(s.particles().at(position, 0)[1], 0.05 + folded(0.2 + 1.5, 0.4, sign), 1e-11);
}
TEST(Walls, SendNoneBackThatIsOnItsWayIn)
{
    At x{-0.1, 0.2}, v{2, 0};
    Walls(box).reflect(x, v, 0);
    EXPECT_EQ(v, (At{2, 0}));
}
TEST(Walls, StopWhatBouncesTooOften)
{
    auto s = gas(SymplecticEuler{});
    s.particles().put(velocity, 3, At{1e4, 0});
    EXPECT_THROW(s.run({.steps = 1, .dt = 0.02}), OutOfDomain);
    EXPECT_THROW((Walls(Box<2>{{0, 0}, {0, 1}})), BadInput);
}
// Water between elastic planes: nobody gets out, and the planes do no work on what they reflect.
TEST(Walls, HoldAFluid)
{
    constexpr double dx = 0.025;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 20}, Continuity<2>{}, PressureForce<2>{},
                       DensityDiffusion{.delta = 0.1}, ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -1}});
    Simulation s(water, Leapfrog{}, Walls(box, open(top)));
    s.fill(Box<2>{{0, 0}, {0.5, 0.4}}, dx, hydrostatic);
    s.run({.until = 1, .cfl = 0.25});
    EXPECT_EQ(Leaks{dx}(s), 0);
    double beyond = -1;
    for (std::size_t i = 0; i < s.particles().size(); ++i)
        beyond = std::max(beyond, s.system().boundary().beyond<2>(s.particles().at(position, i)));
    EXPECT_LE(beyond, 0);
    EXPECT_GT(Front{dx}(s), 0.8); // it has flowed
    EXPECT_LE(s.report().energy_rise, 0.01);
}

} // namespace
