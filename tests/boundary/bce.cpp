// SPDX-License-Identifier: BSD-3-Clause
// Which markers there are, and that walls of every state hold a fluid.
#include "spate/boundary/bce.hpp"

#include <spate/spate.hpp>

#include <gtest/gtest.h>

#include <map>

namespace {

using namespace spate;
using At = Vec<2, double>;

constexpr double dx = 0.1, range = 2.4 * dx; // three layers

/// Markers by point of the lattice, counted from the lower corner; fails where a marker is off the lattice.
template <int Dim, class B>
std::map<std::array<int, 3>, int> placed(B const& tank)
{
    std::map<std::array<int, 3>, int> at;
    tank.place(range, [&](Vec<Dim, double> const& x, int part) {
        std::array<int, 3> k{};
        for (int c = 0; c < Dim; ++c) {
            const double s = (x[c] - tank.template box<Dim>()->lo[c]) / dx - 0.5;
            k[std::size_t(c)] = int(std::lround(s));
            EXPECT_NEAR(s, k[std::size_t(c)], 1e-9);
        }
        EXPECT_EQ(at.count(k), 0u); // one marker at a point
        at[k] = part;
    });
    return at;
}
const Box<2> field{{-0.3, 1}, {0.7, 1.6}}; // 10 by 6 points
const Box<3> room{{0, 0, 0}, {1, 0.6, 0.5}};

TEST(Bce, LinesTheBoxWithTheLayersOfTheRangeCornersToo)
{
    auto count = [](auto const& tank) { return placed<2>(tank).size(); };
    EXPECT_EQ(Bce(field, dx, Adami{}).layers(range), 3);
    EXPECT_EQ(Bce(field, dx, Adami{}).layers(2 * dx), 2); // a support of two spacings ends at the second layer
    EXPECT_EQ(count(Bce(field, dx, Adami{})), 16u * 12 - 60);
    EXPECT_EQ(count(Bce(field, dx, Adami{}, open(top))), 16u * 9 - 60);
    EXPECT_EQ(count(Bce(field, dx, Adami{}, open(top, left))), 13u * 9 - 60);
    EXPECT_EQ(count(Bce(field, dx, Adami{}, periodic(x_axis))), 10u * 6);
    EXPECT_EQ(placed<3>(Bce(room, dx, ByContinuity{})).size(), 16u * 12 * 11 - 300);
    EXPECT_EQ(placed<3>(Bce(room, dx, ByContinuity{}, open(top), periodic(y_axis))).size(), 6u * (16 * 8 - 50));
    const auto at = placed<2>(Bce(field, dx, Adami{}, open(top)));
    EXPECT_EQ(at.count({-3, -3, 0}), 1u); // the corner below
    EXPECT_EQ(at.count({-3, 5, 0}), 1u);
    EXPECT_EQ(at.count({-1, 6, 0}), 0u); // above the open top
    EXPECT_EQ(at.count({0, 0, 0}), 0u);
}
TEST(Bce, HasAtLeastTheLayersAskedForAndTheRangeNeeds)
{
    EXPECT_EQ(Bce(field, dx, Adami{}, layers(5)).layers(range), 5);
    EXPECT_EQ(Bce(field, dx, Adami{}, layers(2)).layers(range), 3);
    EXPECT_EQ(placed<2>(Bce(field, dx, Adami{}, layers(5))).size(), 20u * 16 - 60);
    EXPECT_EQ(placed<2>(Bce(field, dx, Adami{}, layers(2), open(nowhere))).size(), 16u * 12 - 60);
    EXPECT_NEAR(Bce(field, dx, Adami{}, layers(5)).thickness(range), 0.5, 1e-12);
    EXPECT_THROW((void)layers(0), BadInput);
    EXPECT_THROW((Bce(field, dx, Adami{}, lid(nowhere, 1.0, 0.0))), BadInput);
}
TEST(Bce, FillsAnObstacleAsDeepAsTheRange)
{
    const Box<2> wide{{0, 0}, {3, 2}};
    // 10 by 9 points, of which 4 by 3 are deeper than three layers
    const auto at = placed<2>(Bce(wide, dx, Adami{}, obstacle(Box<2>{{1, 0.5}, {2, 1.4}})));
    std::size_t inside = 0;
    for (auto const& [k, part] : at) inside += part == 1;
    EXPECT_EQ(inside, 10u * 9 - 4 * 3);
    EXPECT_EQ(at.count({10, 5, 0}), 1u); // a corner
    EXPECT_EQ(at.count({13, 8, 0}), 0u); // the middle
    EXPECT_EQ(at.count({9, 5, 0}), 0u);
    // Two of them: a point belongs to the first that holds it.
    const auto two =
        placed<2>(Bce(wide, dx, Adami{}, obstacle(Box<2>{{1, 0}, {1.3, 1}}), obstacle(Box<2>{{1.1, 0}, {1.6, 0.4}})));
    std::array<std::size_t, 3> parts{};
    for (auto const& [k, part] : two) ++parts[std::size_t(part)];
    EXPECT_EQ(parts[1], 3u * 10);
    EXPECT_EQ(parts[2], 3u * 4);
}
// Every point of the lattice is a particle or a marker, but for those deep in the solid.
template <int Dim, class S>
void expect_whole(Box<Dim> const& box, S solid)
{
    auto water =
        wcsph(CubicSpline<Dim>{.h = range / 2}, LinearEos{.rho0 = 1, .c0 = 1}, Continuity<2>{}, PressureForce<2>{});
    Bce tank(box, dx, Adami{}, obstacle(solid));
    std::size_t markers = 0, deep = 0, points = 1;
    tank.place(range, [&](auto const&, int part) { markers += part == 1; });
    for (int c = 0; c < Dim; ++c) points *= std::size_t(std::lround(box.size()[c] / dx));
    for (std::size_t k = 0; k < points; ++k) {
        Vec<Dim, double> x;
        std::size_t rest = k;
        for (int c = 0; c < Dim; ++c) {
            const auto n = std::size_t(std::lround(box.size()[c] / dx));
            x[c] = box.lo[c] + (double(rest % n) + 0.5) * dx, rest /= n;
        }
        deep += solid.distance(x) <= -3 * dx;
    }
    Simulation s(water, RungeKutta2{}, tank);
    EXPECT_EQ(s.fill(box, dx) + markers + deep, points);
    EXPECT_GT(markers, 0u);
    for (std::size_t i = 0; i < s.particles().size(); ++i) EXPECT_GT(solid.distance(s.particles().at(position, i)), 0);
}
TEST(Bce, LeavesNoPointOut)
{
    const Box<2> plane{{0, 0}, {2, 1.5}};
    expect_whole(plane, Sphere<2>{{1, 0.7}, 0.5});
    expect_whole(plane, Sphere<2>{{1.05, 0.75}, 0.2}); // points of the lattice on its surface
    expect_whole(plane, Wedge<2>{{0.5, 0}, 1, 0.5});
    expect_whole(plane, HalfSpace<2>{{0, 0.5}, {1, 2}});
    expect_whole(plane, inside_out(Sphere<2>{{1, 0.75}, 0.7}));
    expect_whole(plane, subtract(Box<2>{{0.5, 0}, {1.5, 1}}, Sphere<2>{{1, 1}, 0.3}));
    const Box<3> space{{0, 0, 0}, {1.2, 1, 1}};
    expect_whole(space, Sphere<3>{{0.6, 0.5, 0.5}, 0.4});
    expect_whole(space, unite(Cylinder{{0.6, 0.5, 0}, 0.2, 0.8}, Box<3>{{0, 0, 0}, {0.3, 1, 0.2}}));
}
TEST(Bce, RefusesWhatIsNoWall)
{
    EXPECT_THROW((Bce(field, dx, Adami{}, open(top), lid(top, 1.0, 0.0))), BadInput);
    EXPECT_THROW((Bce(field, dx, Adami{}, lid(top, 1.0, 0.1))), BadInput); // out of its plane
    EXPECT_THROW((Bce(field, dx, Adami{}, lid(front, 1.0, 0.0))), BadInput);
    EXPECT_THROW((void)obstacle(Sphere<2>{{0, 0}, -1}), BadInput);
    EXPECT_THROW((void)obstacle(unite(Sphere<2>{{0, 0}, 1}, HalfSpace<2>{{0, 0}, {0, 0}})), BadInput);
}

// ---- walls of every state hold water at rest on a floor with a step and a ramp (numerics V20)
template <class State>
class Floor : public ::testing::Test {};
using States = ::testing::Types<Adami, Extrapolated, ByContinuity>;
TYPED_TEST_SUITE(Floor, States);

constexpr double H = 0.8, g = 1, spacing = H / 20;
template <class State>
auto over_a_step_and_a_ramp()
{
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * spacing}, Tait{.rho0 = 1000, .c0 = 10 * std::sqrt(g * H)},
                       Continuity<2>{}, DensityDiffusion{.delta = 0.1}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -g}});
    const Box<2> box{{0, 0}, {2, 1.2}};
    Simulation s(water, RungeKutta2{},
                 Bce(box, spacing, State{}, open(top),
                     obstacle(unite(Box<2>{{0, 0}, {0.4, 0.32}}, Wedge<2>{{0.8, 0}, 1.2, 0.4}))));
    s.fill(Box<2>{{0, 0}, {2, H}}, spacing, hydrostatic);
    return s;
}
TYPED_TEST(Floor, HoldsStillWater)
{
    auto s = over_a_step_and_a_ramp<TypeParam>();
    const std::size_t n = s.particles().size();
    s.run({.until = 10 * std::sqrt(H / g), .cfl = 0.2});
    s.refresh();
    double speed = 0;
    auto const& p = s.particles();
    for (std::size_t i = 0; i < n; ++i) speed = std::max(speed, std::sqrt(p.at(velocity, i).squaredNorm()));
    EXPECT_EQ(Leaks{spacing}(s), 0);
    EXPECT_LE(speed, 0.01 * std::sqrt(g * H));
    // The weight is borne, and nothing is left to the sides; what is still accelerated is below 1 % of g (V20 over a period).
    const double weight = double(n) * p.at(mass, 0) * g;
    const At force = WallForce{}(s);
    EXPECT_NEAR(force[1] / -weight, 1, 0.01);
    EXPECT_NEAR(force[0] / weight, 0, 0.01);
}
// What the walls do to the fluid is what they report.
TYPED_TEST(Floor, TakesTheMomentumThatItGives)
{
    auto s = over_a_step_and_a_ramp<TypeParam>();
    auto& p = s.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        const At x = p.at(position, i);
        p.put(velocity, i, At{0.2 * std::sin(9 * x[1]), 0.2 * std::cos(7 * x[0])});
    }
    s.run({.steps = 10, .cfl = 0.2});
    s.refresh();
    const At force = WallForce{}(s);
    s.system().rates(Fields{velocity});
    At sum{};
    double size = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        sum += p.at(mass, i) * p.at(acceleration, i);
        size += p.at(mass, i) * std::sqrt(p.at(acceleration, i).squaredNorm());
    }
    const double weight = double(p.size()) * p.at(mass, 0) * g;
    EXPECT_NEAR(sum[0], -force[0], 1e-12 * size);
    EXPECT_NEAR(sum[1], -force[1] - weight, 1e-12 * size);
}

// A dam breaks onto a column, a ramp and a ball: nobody gets through.
TYPED_TEST(Floor, LetsNothingThroughInADamBreak)
{
    constexpr double height = 0.4, fine = height / 20;
    const double c0 = 10 * std::sqrt(2 * 9.81 * height);
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * fine}, Tait{.rho0 = 1000, .c0 = c0}, Continuity<2>{},
                       DensityDiffusion{.delta = 0.1}, PressureForce<2>{}, ArtificialViscosity{.alpha = 0.1},
                       Gravity<2>{{0, -9.81}});
    TypeParam state;
    if constexpr (requires { state.suction; }) state.suction = false;
    const Box<2> box{{0, 0}, {1.2, 0.8}};
    Simulation s(water, RungeKutta2{},
                 Bce(box, fine, state, open(top), obstacle(Box<2>{{0.5, 0}, {0.6, 0.12}}),
                     obstacle(Wedge<2>{{0.9, 0}, 0.3, 0.2}), obstacle(Sphere<2>{{0.75, 0.3}, 0.08})));
    s.fill(Box<2>{{0, 0}, {0.3, height}}, fine, hydrostatic);
    double most = 0, front = 0;
    while (s.time() < 0.8) {
        s.run({.until = s.time() + 0.02, .cfl = 0.2});
        most = std::max(most, Leaks{fine}(s)), front = std::max(front, Front{fine}(s));
    }
    EXPECT_EQ(most, 0);
    EXPECT_GT(front, 0.9); // up to the ramp
}

// Of Extrapolated, continuity too sees the mirrored velocity: a fluid that falls on a wall is pressed by it as by a fluid that
// comes against it at the same speed.
TEST(Extrapolated, ShowsContinuityTheMirroredVelocity)
{
    const Box<2> box{{0, 0}, {1, 1}};
    auto rate_at_the_floor = [&](auto state) {
        auto fluid =
            wcsph(CubicSpline<2>{.h = 1.2 * dx}, LinearEos{.rho0 = 1, .c0 = 10}, Continuity<2>{}, PressureForce<2>{});
        Simulation s(fluid, RungeKutta2{}, Bce(box, dx, state, periodic(x_axis)));
        s.fill(Box<2>{{0, 0}, {1, 0.6}}, dx, [](auto& p, std::size_t i) { p.put(velocity, i, At{0, -1}); });
        s.make_lists_current();
        s.system().rates(Fields{density});
        return s.particles().at(density_rate, 0);
    };
    const double own = rate_at_the_floor(Adami{}), mirrored = rate_at_the_floor(Extrapolated{});
    EXPECT_GT(own, 0);
    EXPECT_NEAR(mirrored / own, 2, 1e-12); // the fluid at -1, the wall at 0 or at 2 0 + 1
}

} // namespace
