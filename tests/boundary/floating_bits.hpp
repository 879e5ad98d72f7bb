// SPDX-License-Identifier: BSD-3-Clause
// Bodies that float, on threads, on ranks, and across a checkpoint: one scene type of each backend.
#pragma once

#include "spate/boundary/floating.hpp"

#include <spate/backend/virtual_ranks.hpp>
#include <spate/io/resume.hpp>
#include <spate/spate.hpp>

#include <gtest/gtest.h>

namespace floating_bits {

using namespace spate;
using At = Vec<2, double>;

struct End {
    std::uint64_t hash = 0;
    std::int64_t rebuilds = 0;
    double angle = 0, height = 0;
    io::State state;
};
/// A raft that is hit by water and turns, and a block that falls on it; the tank is periodic across.
template <class I, class Precision, class Backend>
End run(I integrator, Precision precision, Backend backend, std::int64_t steps, io::State const* from = nullptr)
{
    constexpr double dx = 0.02;
    const BodyContact contact{.k = 1e5, .c = 20};
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 25}, Continuity<2>{}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.1}, LaminarViscosity{.mu = 0.5}, Gravity<2>{{0, -9.81}});
    Bce tank(Box<2>{{0, 0}, {0.8, 0.6}}, dx, Adami{}, open(top), periodic(x_axis), no_slip,
             obstacle(Box<2>{{0.1, 0.14}, {0.34, 0.24}},
                      Floating<2>{.density = 400, .velocity = {{2, 0}}, .contact = contact}),
             obstacle(Box<2>{{0.5, 0}, {0.56, 0.06}}),
             obstacle(Sphere<2>{{0.2, 0.34}, 0.09},
                      Floating<2>{.density = 2000, .velocity = {{2, -1}}, .spin = -8, .contact = contact}));
    Simulation sim(water, integrator, tank, backend, precision);
    sim.fill(Box<2>{{0, 0}, {0.8, 0.2}}, dx, hydrostatic);
    if (from) io::resume(sim, *from);
    sim.run({.steps = steps});
    auto const& bodies = sim.system().boundary().bodies();
    return {sim.state_hash(), sim.system().rebuilds(), bodies[0].state.attitude.angle, bodies[1].place()[1],
            io::state_of(sim)};
}
template <class I, class Precision>
End on_ranks(int count, I integrator, Precision precision, std::int64_t steps, io::State const* from = nullptr,
             Balance balance = {})
{
    std::vector<End> ends(std::size_t(count), End{});
    const io::State nothing;
    VirtualRanks(count).run([&](auto rank) {
        io::State const* mine = from && rank.rank() != 0 ? &nothing : from;
        ends[std::size_t(rank.rank())] = run(integrator, precision, OnRank{rank, Serial{}, 2, balance}, steps, mine);
    });
    for (auto const& end : ends) {
        EXPECT_EQ(end.hash, ends[0].hash);
        EXPECT_EQ(end.angle, ends[0].angle); // each rank has all bodies
        EXPECT_EQ(end.height, ends[0].height);
    }
    return ends[0];
}
inline constexpr std::int64_t steps = 240, cut = 133;

template <class I, class Precision>
void expect_bits(I integrator, Precision precision)
{
    const End whole = run(integrator, precision, Threads{1}, steps);
    EXPECT_GE(whole.rebuilds, 5);
    EXPECT_GT(std::abs(whole.angle), 1e-3);
    EXPECT_LT(whole.height, 0.33);
    EXPECT_EQ(run(integrator, precision, Threads{2, 1}, steps).hash, whole.hash);
    const Balance often{.every = 1, .by_pairs = true, .forced = 9};
    EXPECT_EQ(on_ranks(3, integrator, precision, steps, nullptr, often).hash, whole.hash);
    const End half = run(integrator, precision, Threads{2, 2}, cut);
    EXPECT_NE(half.hash, whole.hash);
    EXPECT_EQ(run(integrator, precision, Threads{1}, steps - cut, &half.state).hash, whole.hash);
    EXPECT_EQ(on_ranks(3, integrator, precision, steps - cut, &half.state).hash, whole.hash);
    const End of_ranks = on_ranks(3, integrator, precision, cut);
    EXPECT_EQ(of_ranks.hash, half.hash);
    const End again = run(integrator, precision, Threads{1}, steps - cut, &of_ranks.state);
    EXPECT_EQ(again.hash, whole.hash);
    EXPECT_EQ(again.angle, whole.angle);
}

} // namespace floating_bits
