// SPDX-License-Identifier: BSD-3-Clause
// Skins by place: lists hold every pair within range at every step, wherever and however fast particles move.
#include "oracle/all_pairs.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace spate;

/// Looks at each state whose lists are current: counts the pairs within range, and those that no list holds.
struct Census {
    std::int64_t pairs = 0, missed = 0, looks = 0;
    bool skins_differ = false;

    void begin(auto const&) {}
    void end(auto const&) {}
    void step(auto const& sim)
    {
        auto const& s = sim.system();
        if (s.stale(s.template extremes<>(), 0, 0)) return;
        ++looks;
        s.each_species([&](auto target) {
            skins_differ = skins_differ || !s.template skins<target()>().uniform();
            s.each_species([&](auto source) {
                if constexpr (target() == 0 || source() == 0) one<target(), source()>(s);
            });
        });
    }

private:
    template <int t, int q, class System>
    void one(System const& s)
    {
        auto const& target = s.template species<t>();
        auto const& source = s.template species<q>();
        constexpr int dim = System::dim;
        Vec<dim, double> period{};
        for (int c = 0; c < dim; ++c) period[c] = s.grid().period(c);
        std::set<oracle::Pair> listed;
        const bool good = oracle::each_entry<dim>(
            s.template lists<t, q>(), target.bins, source.bins, source.particles.size(), width<typename System::V>,
            [&](oracle::Entry const& e) {
                listed.insert({target.particles.id()[e.i], source.particles.id()[e.j], e.shift});
            });
        ASSERT_TRUE(good);
        for (auto const& pair : oracle::all_pairs<dim>(target.particles, source.particles, t == q, period,
                                                       s.physics().interaction.range())) {
            ++pairs;
            missed += !listed.contains(pair);
        }
    }
};

constexpr double dx = 0.025, g = 9.81;
auto water(double height)
{
    return wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 10 * std::sqrt(2 * g * height)},
                 Continuity<2>{}, DensityDiffusion{.delta = 0.1}, PressureForce<2>{},
                 ArtificialViscosity{.alpha = 0.05}, Gravity<2>{{0, -g}});
}
void expect_none_missed(auto& sim, std::int64_t steps)
{
    Census census;
    sim.run({.steps = steps, .cfl = 0.2}, census);
    EXPECT_EQ(census.missed, 0) << "of " << census.pairs;
    EXPECT_GT(census.looks, steps / 2);
    EXPECT_GE(sim.system().rebuilds(), 20);
    EXPECT_TRUE(census.skins_differ);
}

TEST(Skins, MissNoPairOfADamBreakBetweenWalls)
{
    Bce tank(Box<2>{{}, {{0.8, 0.6}}}, dx, Adami{.suction = false}, open(top));
    Simulation dam(water(0.4), RungeKutta2{}, tank);
    dam.fill(Box<2>{{}, {{0.3, 0.4}}}, dx, hydrostatic);
    expect_none_missed(dam, 1500);
}
TEST(Skins, MissNoPairOfAJetThatCrossesStillWaterAndAPeriod)
{
    const Box<2> box{{}, {{0.6, 0.5}}};
    Simulation sea(water(0.4), Leapfrog{}, Periodic(box));
    sea.fill(box, dx, [](auto& p, std::size_t i) {
        const auto x = p.at(position, i);
        const bool jet = std::abs(x[1] - 0.26) < 0.06;
        p.put(velocity, i, {{jet ? 2.5 : 0, std::abs(x[0] - 0.1) < 0.05 ? -1.5 : 0}});
    });
    expect_none_missed(sea, 500);
}

// A pair of drops fast against each other in a tank of still ones: only their patches reach far.
TEST(Skins, AreThinWhereNothingMoves)
{
    auto slots = [](bool local) {
        const Box<2> box{{}, {{1, 1}}};
        Simulation sim(water(0.4), RungeKutta2{}, Periodic(box), Serial{}, Double{}, NoWatch{},
                       {.skin = 0.2, .local = local});
        sim.fill(box, dx, [](auto& p, std::size_t i) {
            if (i == 5 || i == 6) p.put(velocity, i, {{i == 5 ? 1.0 : -1.0, 0}});
        });
        sim.run({.steps = 1, .dt = 1e-9});
        return double(sim.system().template lists<0, 0>().slots());
    };
    // On a lattice the range, 2.4 dx, holds 20 neighbours, with the whole skin, 2.88 dx, it is 24; blocks round up.
    EXPECT_LT(slots(true) / slots(false), 21.5 / 24);
    EXPECT_GT(slots(true) / slots(false), 20.0 / 24);
}
// Nothing moves yet: nothing is known of who will.
TEST(Skins, AreWholeEverywhereAtRest)
{
    const Box<2> box{{}, {{1, 1}}};
    Simulation sim(water(0.4), RungeKutta2{}, Periodic(box));
    sim.fill(box, dx);
    sim.run({.steps = 1, .dt = 1e-9});
    EXPECT_DOUBLE_EQ(sim.system().template skins<0>().least(), sim.system().neighbours().skin);
}

} // namespace
