// SPDX-License-Identifier: BSD-3-Clause
// Walls that grains touch: a wall is a grain of infinite mass, planes, tilted and moving ones, discs and cylinders; energy is kept
// at edges and corners; what friction keeps of a contact is kept at walls too.
#include <spate/spate.hpp>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace spate;

constexpr double m = 0.1, r = 0.01, k = 1e5; // kg, m, N/m
const Box<2> box{{0, 0}, {0.2, 0.1}};
constexpr LinearSpring spring{.k = k};
const double omega = std::sqrt(k / m); // of a contact with a wall: m_ij = m

template <class... Options>
auto discs(Options... options)
{
    return Simulation(dem<2>({.mass = m, .radius = r}, spring), Leapfrog{}, Walls(box, options...));
}
/// A face that moves, a plane that turns and a round wall, of springs; the other faces reflect. Those that a test does not
/// ask for are out of the way, so that all of them are one type of scene.
struct Rooms {
    double speed = 0, omega = 0; ///< of the left face [m/s], of the plane about the origin [1/s]
    HalfSpace<2> plane{{0, -10}, {0, 1}};
    Sphere<2> round{{0, 0}, 10};
    Box<2> box = ::box;
};
auto room(Rooms const& a)
{
    return Simulation(dem<2>({.mass = m, .radius = r}, spring), Leapfrog{},
                      Walls(a.box, contact(left, Steady<2>{.velocity = {a.speed, 0}}, spring),
                            contact(a.plane, Rotation<2>{.centre = {0, 0}, .omega = a.omega}, spring),
                            contact(inside_out(a.round), spring)));
}
/// A grain, and walls, with friction; in space or in the plane.
template <int Dim, class... Wall>
auto rough(Dashpot dashpot, Friction friction, Vec<Dim, double> g, Threads threads, Wall... wall)
{
    return Simulation(dem<Dim>({.mass = m, .radius = r}, spring, dashpot, friction, Gravity<Dim>{g}), Leapfrog{},
                      Walls(wall...), threads);
}

// A head-on impact lasts pi / omega, goes v / omega deep, and the force at the turn is v sqrt(k m): docs/models/dem.md, m_ij = m.
TEST(SpringWall, IsAGrainOfInfiniteMass)
{
    auto s = discs(contact(spring));
    const double v = 0.5, dt = std::numbers::pi / omega / 2000;
    s.add({r, 0.05}, {-v, 0});
    double deepest = 0, hardest = 0;
    for (int n = 0; n < 2000; ++n) {
        s.run({.steps = 1, .dt = dt});
        deepest = std::max(deepest, r - s.particles().at(position, 0)[0]);
        hardest = std::max(hardest, -s.wall_force()[0]);
    }
    EXPECT_NEAR(deepest, v / omega, 1e-5 * v / omega);
    EXPECT_NEAR(hardest, v * std::sqrt(k * m), 1e-5 * v * std::sqrt(k * m));
    EXPECT_NEAR(s.particles().at(position, 0)[0], r, 1e-5 * v / omega); // it leaves after half a period
    EXPECT_NEAR(s.particles().at(velocity, 0)[0], v, 1e-5 * v);
    EXPECT_DOUBLE_EQ(s.stiffness().contact_frequency, std::sqrt(2 * k / m)); // two grains are stiffer
}
// X20: a disc in a corner touches two walls at once; each is a potential of its own, so that energy is theirs to keep. Leapfrog has
// order 2: its error at z = omega dt is at most z^2/4 of the energy.
TEST(SpringWall, KeepsEnergyInEdgesAndCorners)
{
    for (double angle : {0.3, std::numbers::pi / 4, 1.2}) {
        const double dt = 1e-5, z = omega * dt;
        auto s = discs(contact(spring));
        s.add({r, r}, {-0.5 * std::cos(angle), -0.5 * std::sin(angle)});
        double worst = 0, stored = 0;
        for (int n = 0; n < 200; ++n) {
            s.run({.steps = 1, .dt = dt});
            const auto e = s.energy();
            worst = std::max(worst, std::abs(e.total() / (0.5 * m * 0.25) - 1)), stored = std::max(stored, e.internal);
        }
        EXPECT_LE(worst, z * z / 4 / (1 - z * z / 4)) << angle;
        EXPECT_GT(stored, 0.9 * 0.5 * m * 0.25 * std::min(1.0, 2 * std::sin(angle) * std::cos(angle)));
    }
    const Dashpot none{.e = 1};
    const Friction smooth{.mu = 0};
    auto s = rough<3>(none, smooth, {}, {1}, Box<3>{{0, 0, 0}, {0.1, 0.1, 0.1}}, contact(spring, none, smooth));
    s.add({r, r, r}, {-0.3, -0.3, -0.3});
    s.add({0.1 - r, 0.1 - r, r}, {0.2, 0.3, 0.1});
    const double before = s.energy().total(), z = omega * 1e-5;
    for (int n = 0; n < 100; ++n) {
        s.run({.steps = 4, .dt = 1e-5});
        EXPECT_NEAR(s.energy().total(), before, before * z * z / 4 / (1 - z * z / 4));
    }
}
// A square that is turned by 45 degrees, of four tilted planes, gives what a square along the axes gives, turned.
TEST(SpringWall, MayBeTilted)
{
    const double c = std::sqrt(0.5);
    const auto turned = [&](Vec<2, double> x) { return Vec<2, double>{c * (x[0] - x[1]), c * (x[0] + x[1])}; };
    auto plane = [&](Vec<2, double> x, Vec<2, double> n) {
        return contact(HalfSpace<2>{.point = turned(x), .normal = turned(n)}, spring);
    };
    Simulation tilted(dem<2>({.mass = m, .radius = r}, spring), Leapfrog{},
                      Walls(Box<2>{{-1, -1}, {1, 1}}, plane({0, 0}, {2, 0}), plane({0.2, 0}, {-1, 0}),
                            plane({0, 0}, {0, 3}), plane({0, 0.1}, {0, -1})));
    auto straight = discs(contact(spring));
    const Vec<2, double> x0{0.05, 0.03}, v0{0.5, -0.3}, x1{0.15, 0.06}, v1{-0.2, 0.4};
    tilted.add(turned(x0), turned(v0)), tilted.add(turned(x1), turned(v1));
    straight.add(x0, v0), straight.add(x1, v1);
    for (int n = 0; n < 5; ++n) {
        tilted.run({.steps = 2000, .dt = 2e-5}), straight.run({.steps = 2000, .dt = 2e-5});
        for (std::size_t i = 0; i < 2; ++i) {
            std::size_t j = 0;
            while (straight.particles().id()[j] != tilted.particles().id()[i]) ++j;
            const auto x = turned(straight.particles().at(position, j)) - tilted.particles().at(position, i);
            EXPECT_LE(std::sqrt(x.squaredNorm()), 1e-9);
        }
    }
}
// Within a disc, and in space a cylinder with two ends, energy and the angular momentum about the axis are kept.
TEST(SpringWall, MayBeRound)
{
    auto s = room({.round = {{0, 0}, 0.1}, .box = {{-1, -1}, {1, 1}}});
    s.add({0.03, 0.01}, {0.4, 0.3}), s.add({-0.05, 0.01}, {0.1, -0.3});
    auto spin = [](auto const& p) {
        double sum = 0;
        for (std::size_t i = 0; i < p.size(); ++i) sum += cross(p.at(position, i), p.at(velocity, i))[0];
        return sum;
    };
    const double energy = s.energy().total(), about = spin(s.particles());
    s.run({.steps = 50000, .dt = 1e-5});
    s.make_lists_current();
    EXPECT_NEAR(s.energy().total(), energy, energy * 1e-4);
    EXPECT_NEAR(spin(s.particles()), about, std::abs(about) * 1e-10);

    const Cylinder drum{.foot = {0, 0, 0}, .radius = 0.1, .height = 0.2, .axis = 2};
    Simulation d(dem<3>({.mass = m, .radius = r}, spring), Leapfrog{},
                 Walls(Box<3>{{-1, -1, -1}, {1, 1, 1}}, contact(inside_out(drum), spring)));
    d.add({0.03, 0.01, 0.05}, {0.4, 0.3, 0.3}), d.add({-0.05, 0.01, 0.05}, {0.1, -0.3, -0.2});
    const double before = d.energy().total();
    d.run({.steps = 50000, .dt = 1e-5});
    d.make_lists_current();
    EXPECT_NEAR(d.energy().total(), before, before * 1e-4);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(drum.distance(d.particles().at(position, i)), -0.9 * r);
}
// The solids' feet: distance is that of the solid, and the normal its gradient.
TEST(Foot, IsTheGradientOfTheDistance)
{
    std::mt19937 random{7};
    std::uniform_real_distribution<double> u(-1, 1);
    auto expect = [&](auto const& solid, Vec<3, double> const& x) {
        const auto at = foot<double>(solid, x);
        EXPECT_NEAR(at.distance, solid.distance(x), 1e-14);
        EXPECT_NEAR(at.n.squaredNorm(), 1, 1e-12);
        for (int c = 0; c < 3; ++c) {
            Vec<3, double> a = x, b = x;
            a[c] -= 1e-6, b[c] += 1e-6;
            EXPECT_NEAR(at.n[c], (solid.distance(b) - solid.distance(a)) / 2e-6, 1e-6);
        }
    };
    const Cylinder standing{.foot = {0.1, 0, -0.3}, .radius = 0.4, .height = 0.7, .axis = 2};
    for (int n = 0; n < 200; ++n) {
        const Vec<3, double> x{u(random), u(random), u(random)};
        expect(HalfSpace<3>{{0.1, 0.2, 0.3}, {1, -2, 2}}, x);
        expect(Sphere<3>{{0.1, 0.2, 0.3}, 0.5}, x);
        expect(standing, x);
        expect(inside_out(standing), x);
    }
}
// A piston that moves at u sends back at 2 u - v what comes at v, and it does work: nothing is compared with the start.
TEST(SpringWall, MayMove)
{
    const double u = 0.3, v = -0.4;
    auto s = room({.speed = u});
    EXPECT_TRUE(s.driven());
    s.add({0.1, 0.05}, {v, 0});
    s.run({.until = 0.2, .dt = 1e-5});
    EXPECT_NEAR(s.particles().at(velocity, 0)[0], 2 * u - v, 1e-4);
    // One that turns: a plane through the origin that sweeps a disc along has v = omega x at the point of contact.
    auto turning = room({.omega = 2, .plane = {{0, 0}, {0, 1}}});
    turning.add({0.1, r}, {0, 0});
    const double dt = std::numbers::pi / omega / 400;
    turning.run({.steps = 450, .dt = dt});
    EXPECT_NEAR(turning.particles().at(velocity, 0)[1], 2 * 2 * 0.1, 0.03 * 0.4); // the arm changes on the way
}
// One face springs, the others reflect.
TEST(SpringWall, StandsBesideElasticOnes)
{
    auto s = room({});
    s.add({0.1, 0.05}, {0.5, 0.2});
    s.run({.steps = 40000, .dt = 1e-5});
    EXPECT_NEAR(s.energy().total(), 0.5 * m * (0.25 + 0.04), 1e-6);
    EXPECT_THROW(Walls(box, contact(right, spring), contact(right, spring)), BadInput);
    EXPECT_THROW(Walls(box, contact(top, spring), open(top)), BadInput);
}
// V48 on a floor: a disc that slips at u0 rolls at 2 u0/3 after u0/(3 mu g); a sphere at 5 u0/7 after 2 u0/(7 mu g). On a belt that
// moves at u0 a disc at rest ends with u0/3.
TEST(SpringWall, LetsAGrainRoll)
{
    const double u0 = 0.5, mu = 0.3, g = 9.81;
    const Dashpot dashpot{.e = 0.5};
    const Friction friction{.mu = mu};
    const auto wall = contact(spring, dashpot, friction);
    const double rest = r - m * g / k;
    {
        auto s = rough<2>(dashpot, friction, {0, -g}, {1}, Box<2>{{0, 0}, {2, 1}}, wall, open(top));
        s.add({0.5, rest}, {u0, 0});
        s.run({.until = 0.9 * u0 / (3 * mu * g), .dt = 2e-5});
        EXPECT_NEAR(s.wall_force()[0], mu * m * g, 5e-4 * mu * m * g); // it still slips
        EXPECT_NEAR(s.wall_force()[1], -m * g, 1e-9);
        s.run({.until = 0.3, .dt = 2e-5});
        EXPECT_NEAR(s.particles().at(velocity, 0)[0], 2 * u0 / 3, 2e-3 * u0);
        EXPECT_NEAR(s.particles().at(angular_velocity, 0)[0] * r, -2 * u0 / 3, 2e-3 * u0);
    }
    {
        auto s = rough<3>(dashpot, friction, {0, 0, -g}, {1}, Box<3>{{0, 0, 0}, {2, 2, 1}}, wall, open(top));
        s.add({0.5, 0.5, rest}, {0.6 * u0, 0.8 * u0, 0});
        s.run({.until = 0.3, .dt = 2e-5});
        EXPECT_NEAR(s.particles().at(velocity, 0)[0], 0.6 * 5 * u0 / 7, 2e-3 * u0);
        EXPECT_NEAR(s.particles().at(velocity, 0)[1], 0.8 * 5 * u0 / 7, 2e-3 * u0);
    }
    {
        auto s = rough<2>(dashpot, friction, {0, -g}, {1}, Box<2>{{0, 0}, {2, 1}}, open(top),
                          contact(bottom, Steady<2>{.velocity = {u0, 0}}, spring, dashpot, friction));
        s.add({0.5, rest});
        s.run({.until = 0.3, .dt = 2e-5});
        EXPECT_NEAR(s.particles().at(velocity, 0)[0], u0 / 3, 2e-3 * u0);
    }
}
TEST(SpringWall, AddsNoFieldWithoutFriction)
{
    EXPECT_EQ(to_string(discs(contact(spring)).particles().fields), "position velocity acceleration build_position");
}
// Grains with friction in a closed box: the same bits for any number of threads, and for walls as for pairs.
TEST(SpringWall, BitsDoNotDependOnThreads)
{
    auto run = [](int threads, int cell) {
        const Dashpot dashpot{.e = 0.7};
        const Friction friction{.mu = 0.5};
        auto s = rough<2>(dashpot, friction, {1, -9.81}, {threads, cell}, Box<2>{{0, 0}, {0.4, 0.3}},
                          contact(spring, dashpot, friction));
        std::mt19937 random{3};
        std::uniform_real_distribution<double> u(-1, 1);
        for (int a = 0; a < 15; ++a)
            for (int b = 0; b < 10; ++b) s.add({0.02 + 0.024 * a, 0.02 + 0.024 * b}, {u(random), u(random)});
        s.run({.steps = 1500, .dt = 5e-5});
        return s.state_hash();
    };
    const auto one = run(1, 0);
    EXPECT_EQ(run(2, 0), one);
    EXPECT_EQ(run(3, 2), one);
}
// Two grains alike but for the spring that the floor has of one of them are in other states.
TEST(SpringWall, StateHashKnowsWhatIsKept)
{
    const Dashpot dashpot{.e = 0.7};
    const Friction friction{.mu = 0.5};
    auto s = rough<2>(dashpot, friction, {0, -9.81}, {1}, Box<2>{{0, 0}, {2, 1}}, contact(spring, dashpot, friction),
                      open(top));
    s.add({0.5, r - 1e-5}, {0.1, 0});
    s.run({.steps = 20, .dt = 2e-5});
    const KeptAtWall<TangentialSpring, 1> kept; // by axis: of the floor
    const auto was = s.particles().at(kept, 0);
    EXPECT_NE(was[0], 0);
    const auto hash = s.state_hash();
    s.particles().put(kept, 0, {std::nextafter(was[0], 0.0)});
    EXPECT_NE(s.state_hash(), hash);
    s.particles().put(kept, 0, was);
    EXPECT_EQ(s.state_hash(), hash);
}

} // namespace
