// SPDX-License-Identifier: BSD-3-Clause
// Who enters, where and with which id, and who leaves, do not depend on who computes.
#include "scenes.hpp"

#include "spate/io/resume.hpp"

#include <gtest/gtest.h>

namespace {

using namespace scenes;

/// Rough grains enter on the left of a periodic channel, collide, and leave on the right.
template <class Precision = Double, class W = Watch, class Backend>
auto channel_with(Backend backend)
{
    Simulation sim(dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}, Dashpot{.e = 0.9}, Friction{.mu = 0.5},
                          Gravity<2>{{0, -9.81}}),
                   Leapfrog{}, Periodic(Box<2>{{}, {{1, 0.5}}}, open(left, right)), backend, Precision{}, W{});
    for (int n = 0; n < 20; ++n) sim.add({{0.5 + 0.001 * n, 0.01 + n * 0.024}});
    return sim;
}
auto source()
{
    return Pour(Box<2>{{{0.02, 0}}, {{0.3, 0.5}}}, {.rate = 2000, .seed = 4}, [](auto& p, std::size_t i, Draw& draw) {
        p.put(velocity, i, {{2 * draw(), draw() - 0.5}});
    });
}
auto sink() { return Outlet(HalfSpace<2>{{{0.8, 0}}, {{-1, -0.1}}}); }

template <class Precision = Double, class W = Watch, class Backend>
Outcome channel(Backend backend, std::int64_t piece = 1 << 30)
{
    auto sim = channel_with<Precision, W>(backend);
    auto pour = source();
    auto end = sink();
    constexpr std::int64_t steps = 4000;
    while (sim.steps() < steps) sim.run({.steps = std::min(piece, steps - sim.steps()), .dt = 2e-4}, pour, end);
    EXPECT_GT(pour.particles(), 500);
    EXPECT_GT(end.particles(), 50);
    EXPECT_EQ(sim.particles().size(), std::size_t(20 + pour.particles() - end.particles()));
    return {sim.state_hash() + std::uint64_t(end.particles()), sim.system().rebuilds()};
}
Outcome const& of_channel()
{
    static const Outcome r = channel(Threads{1});
    return r;
}
/// Water runs out of a tank through an open side.
template <class Backend>
Outcome spill(Backend backend)
{
    constexpr double dx = 0.02, g = 9.81, height = 0.3;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 10 * std::sqrt(2 * g * height)},
                       Continuity<2>{}, DensityDiffusion{.delta = 0.1}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.05}, Gravity<2>{{0, -g}});
    const Box<2> tank{{}, {{0.4, 0.4}}};
    Simulation sim(water, RungeKutta2{}, Bce(tank, dx, Adami{}, open(top, right)), backend);
    sim.fill(Box<2>{{}, {{0.4, height}}}, dx, hydrostatic);
    Outlet out(beyond(tank, right));
    sim.run({.steps = 600, .cfl = 0.2}, out);
    EXPECT_GT(out.particles(), 20);
    return {sim.state_hash(), sim.system().rebuilds()};
}

TEST(BitsOfExchange, OfAChannelDoNotDependOnThreads)
{
    EXPECT_GE(of_channel().rebuilds, 100);
    for (int threads : {2, 3, 7}) EXPECT_EQ(channel(Threads{threads}).hash, of_channel().hash) << threads;
}
TEST(BitsOfExchange, OfAChannelDoNotDependOnCells)
{
    for (int cell : {1, 3, 16}) EXPECT_EQ(channel(Threads{2, cell}).hash, of_channel().hash) << "cell " << cell;
}
TEST(BitsOfExchange, OfAChannelDoNotDependOnPiecesPacksOrWatch)
{
    EXPECT_EQ(channel(Threads{1}, 37).hash, of_channel().hash);
    EXPECT_EQ((channel<ScalarOf<Double>, NoWatch>(Serial{}).hash), of_channel().hash);
}
// Another scene, filled as at the start, goes on where the first was after 1700 steps.
TEST(BitsOfExchange, OfAChannelAreThoseOfOneThatGoesOn)
{
    auto first = channel_with(Threads{1});
    auto pour = source();
    auto end = sink();
    first.run({.steps = 1700, .dt = 2e-4}, pour, end);
    const auto state = io::state_of(first, pour, end);
    auto second = channel_with(Threads{2, 3});
    auto again = source();
    auto sink_again = sink();
    io::resume(second, state, again, sink_again);
    second.run({.steps = 2300, .dt = 2e-4}, again, sink_again);
    EXPECT_EQ(second.state_hash() + std::uint64_t(sink_again.particles()), of_channel().hash);
}
TEST(BitsOfExchange, OfASpillDoNotDependOnThreads)
{
    const auto reference = spill(Threads{1});
    EXPECT_GE(reference.rebuilds, 10);
    for (int threads : {2, 3, 7}) EXPECT_EQ(spill(Threads{threads, 2}).hash, reference.hash) << threads;
}

} // namespace
