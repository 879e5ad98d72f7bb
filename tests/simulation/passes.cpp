// SPDX-License-Identifier: BSD-3-Clause
// Passes that wait for each other leave the bits of passes that do not, and nobody sees a particle that still waits.
#include "spate/spate.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace spate;

constexpr int side = 30; // discs along each axis of a box
constexpr double r = 0.01, pitch = 2.05 * r;
const Box<2> box{{}, {{side * pitch, side* pitch}}};
constexpr LinearSpring spring{.k = 1e5};

/// Discs in a box: cells of one range, so that most packs belong to several cells.
template <class I, class Grains, class W, class Backend>
auto discs(I, Grains grains, W walls, Backend backend)
{
    using S = System<Grains, W, Backend, Double>;
    S s(grains, walls, backend, Discs::neighbours, I::saves);
    auto& p = s.mobile();
    p.resize(side * side - 3);
    std::mt19937 random(7);
    auto uniform = [&] { return double(random()) / 2147483648.0 - 1; };
    for (std::size_t i = 0; i < p.size(); ++i) {
        p.put(position, i, {{(double(i % side) + 0.5) * pitch, (double(i / side) + 0.5) * pitch}});
        p.put(velocity, i, {{uniform(), uniform()}});
    }
    s.use(Grid<2>(box, Edges<2>(Edge::wall), 2 * r * Discs::neighbours.bin_edge(), Discs::neighbours.finer, 1));
    s.resized();
    return s;
}
template <class I, class Backend>
auto smooth_discs(I integrator, Backend backend)
{
    return discs(integrator, dem<2>({.mass = 0.1, .radius = r}, spring), Walls(box), backend);
}
/// Something is kept of pairs and at walls.
template <class I, class Backend>
auto rough_discs(I integrator, Backend backend)
{
    const Dashpot dashpot{.e = 0.7};
    const Friction friction{.mu = 0.5};
    return discs(integrator, dem<2>({.mass = 0.1, .radius = r}, spring, dashpot, friction),
                 Walls(box, contact(spring, dashpot, friction)), backend);
}
/// Water that nothing holds.
template <class I, class Backend>
auto water(I, Backend backend)
{
    constexpr int n = 9;
    constexpr double dx = 0.01;
    const auto fluid = wcsph(CubicSpline<3>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 20}, Continuity<2>{},
                             PressureForce<2>{}, ArtificialViscosity{.alpha = 0.1}, Gravity<3>{{0, 0, -9.81}});
    using S = System<std::remove_cv_t<decltype(fluid)>, Open, Backend, Double>;
    const Neighbours how{};
    S s(fluid, Open{}, backend, how, I::saves);
    auto& p = s.mobile();
    p.value(mass) = 1000 * dx * dx * dx;
    p.resize(n * n * n);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec<3, double> x{{double(i % n) * dx, double(i / n % n) * dx, double(i / n / n) * dx}};
        p.put(position, i, x), p.put(velocity, i, {{x[1], -x[2], 2 * x[0]}}), p.put(density, i, 1000 + x[0]);
    }
    s.use(Grid<3>({{}, {}}, Edges<3>(Edge::open), fluid.interaction.range() * how.bin_edge(), how.finer, 1));
    s.resized();
    return s;
}
/// The state after some steps, and the extremes as a pass and as a look.
template <class I>
std::uint64_t after(auto s, I integrator, double dt, bool put_off)
{
    constexpr bool reflects = decltype(s)::reflects;
    for (int k = 0; k < 40; ++k) {
        if (k % 8 == 0) s.rebuild();
        if (put_off) s.put_off();
        integrator.step(s, dt);
        if constexpr (reflects) s.reflect();
        s.look();
        s.finish();
        const Extremes seen = s.seen(), now = s.extremes();
        EXPECT_EQ(seen.speed, now.speed);
        EXPECT_EQ(seen.moved, now.moved);
        EXPECT_EQ(seen.acceleration, now.acceleration);
        EXPECT_EQ(seen.least_move, now.least_move);
        EXPECT_EQ(seen.most_velocity, now.most_velocity);
        EXPECT_EQ(seen.poison, 0);
    }
    if constexpr (reflects) {
        EXPECT_FALSE(s.lost());
    }
    return s.state_hash();
}

template <class I>
class Passes : public testing::Test {};
using Integrators = testing::Types<ForwardEuler, SymplecticEuler, Leapfrog, RungeKutta2>;
TYPED_TEST_SUITE(Passes, Integrators);

TYPED_TEST(Passes, OfDiscsLeaveTheSameBitsWhetherTheyWaitOrNot)
{
    const TypeParam integrator;
    const auto eager = after(smooth_discs(integrator, Serial{}), integrator, 5e-5, false);
    EXPECT_EQ(after(smooth_discs(integrator, Serial{}), integrator, 5e-5, true), eager);
    EXPECT_EQ(after(smooth_discs(integrator, Threads{.count = 3}), integrator, 5e-5, true), eager);
}
TYPED_TEST(Passes, OfRoughDiscsLeaveTheSameBitsWhetherTheyWaitOrNot)
{
    const TypeParam integrator;
    const auto eager = after(rough_discs(integrator, Serial{}), integrator, 5e-5, false);
    EXPECT_EQ(after(rough_discs(integrator, Serial{}), integrator, 5e-5, true), eager);
    EXPECT_EQ(after(rough_discs(integrator, Threads{.count = 3}), integrator, 5e-5, true), eager);
}
TYPED_TEST(Passes, OfWaterLeaveTheSameBitsWhetherTheyWaitOrNot)
{
    const TypeParam integrator;
    const auto eager = after(water(integrator, Serial{}), integrator, 1e-4, false);
    EXPECT_EQ(after(water(integrator, Serial{}), integrator, 1e-4, true), eager);
    EXPECT_EQ(after(water(integrator, Threads{.count = 3}), integrator, 1e-4, true), eager);
}

TEST(WaitingPasses, AreOverForThoseWhoAskForParticles)
{
    auto s = smooth_discs(SymplecticEuler{}, Serial{});
    s.rebuild();
    const auto x = s.mobile().at(position, 5), v = s.mobile().at(velocity, 5);
    s.put_off();
    s.advance(s.drifting, 0.5);
    EXPECT_EQ(std::as_const(s).mobile().at(position, 5), x);
    EXPECT_EQ(s.mobile().at(position, 5), x + 0.5 * v);
}

// What a scene has seen along with a step is what it finds when it looks again.
TEST(WaitingPasses, SeeTheStateThatTheStepAfterBeginsWith)
{
    auto run = [](bool look_again) {
        const Box<2> small{{}, {{0.2, 0.2}}};
        Simulation sim(dem<2>({.mass = 0.1, .radius = r}, spring), SymplecticEuler{}, Walls(small));
        for (int i = 0; i < 60; ++i)
            sim.add({{0.02 + 0.02 * (i % 8), 0.02 + 0.02 * (i / 8)}}, {{1.0 - 0.03 * i, 0.5 - 0.02 * i}});
        for (int k = 0; k < 400; ++k) {
            if (look_again) sim.particles();
            sim.step({.dt = 1e-4});
        }
        return std::pair{sim.state_hash(), sim.system().rebuilds()};
    };
    EXPECT_EQ(run(false), run(true));
    EXPECT_GT(run(false).second, 3);
}

} // namespace
