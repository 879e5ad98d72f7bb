// SPDX-License-Identifier: BSD-3-Clause
// What is measured of contacts: each of them, how many a grain has, and the stress that they carry.
#include "spate/measure/contacts.hpp"

#include "physics/grains.hpp"
#include "spate/io/history.hpp"
#include "spate/measure/coordination.hpp"
#include "spate/measure/stress.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>

namespace {

using namespace grains;

constexpr double m = 0.1, r = 0.01, k = 1e5;

/// side^Dim grains on a square lattice that is pressed together, in a periodic box.
template <int Dim, class Backend = Serial>
auto lattice(int side, double overlap, Backend backend = {})
{
    const double pitch = 2 * r - overlap;
    Vec<Dim, double> size;
    for (int c = 0; c < Dim; ++c) size[c] = side * pitch;
    Simulation sim(dem<Dim>({.mass = m, .radius = r}, LinearSpring{.k = k}), Leapfrog{}, Periodic(Box<Dim>{{}, size}),
                   backend);
    std::size_t n = 1;
    for (int c = 0; c < Dim; ++c) n *= std::size_t(side);
    for (std::size_t i = 0; i < n; ++i) {
        Vec<Dim, double> x;
        std::size_t rest = i;
        for (int c = 0; c < Dim; ++c, rest /= std::size_t(side))
            x[c] = (double(rest % std::size_t(side)) + 0.3) * pitch;
        sim.add(x);
    }
    sim.prepare();
    return sim;
}
template <int Dim>
Box<Dim> box_of(auto const& sim)
{
    return sim.system().grid().box();
}

TEST(Contacts, OfTwoGrainsByHand)
{
    Simulation sim(dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k}), Leapfrog{}, Periodic(Box<2>{{0, 0}, {1, 1}}),
                   Serial{});
    sim.add({0.999, 0.5});
    sim.add({0.011, 0.517}); // (12, 17) mm away, across the face
    sim.add({0.5, 0.5});
    sim.prepare();
    EXPECT_TRUE(contacts(sim).empty());
    auto const& id = sim.particles().id();
    const auto second = std::size_t(std::find(id.begin(), id.end(), 1u) - id.begin());
    sim.particles().put(position, second, {0.008, 0.512}); // (9, 12) mm
    sim.prepare();
    const auto list = contacts(sim);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0].i, 0u);
    EXPECT_EQ(list[0].j, 1u);
    EXPECT_NEAR(list[0].overlap, 0.005, 1e-15);
    EXPECT_NEAR(list[0].branch[0], -0.009, 1e-15);
    EXPECT_NEAR(list[0].branch[1], -0.012, 1e-15);
    EXPECT_NEAR(list[0].force[0], -0.6 * k * 0.005, 1e-10 * k);
    EXPECT_NEAR(list[0].force[1], -0.8 * k * 0.005, 1e-10 * k);
    EXPECT_EQ(Coordination{}(sim), 2.0 / 3);
}
/// Rough grains of many sizes in the middle of a collision.
auto rough(auto backend)
{
    Simulation sim(dem<3>(Mixture{.largest = r}, LinearSpring{.k = k}, Dashpot{.e = 0.7}, Friction{.mu = 0.4}),
                   Leapfrog{}, Open{}, backend, Double{}, NoWatch{});
    scatter<3>(sim, {.side = 5}, 5);
    sim.run({.steps = 60, .dt = 5e-5});
    return sim;
}
// What moves the grains is what the list says, springs that are remembered and all.
TEST(Contacts, TheirForcesAreThoseThatAccelerate)
{
    auto sim = rough(Serial{});
    const auto before = sim.state_hash();
    const auto list = contacts(sim);
    EXPECT_EQ(sim.state_hash(), before);
    ASSERT_GT(list.size(), 40u);
    sim.system().rates(sim.system().kicked);
    std::map<std::uint32_t, Vec<3, double>> force;
    double scale = 0;
    for (auto const& c : list) {
        force[c.i] += c.force, force[c.j] -= c.force;
        scale = std::max(scale, std::sqrt(c.force.squaredNorm()));
    }
    auto const& p = sim.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto f = force[p.id()[i]] - p.at(mass, i) * p.at(acceleration, i);
        EXPECT_LT(std::sqrt(f.squaredNorm()), 1e-13 * scale) << i;
    }
    for (std::size_t n = 1; n < list.size(); ++n)
        EXPECT_LT(std::pair(list[n - 1].i, list[n - 1].j), std::pair(list[n].i, list[n].j));
    for (auto const& c : list) EXPECT_LT(c.i, c.j);
}
TEST(Coordination, OfLattices)
{
    auto square = lattice<2>(6, 1e-4), apart = lattice<2>(6, -1e-4);
    EXPECT_EQ(Coordination{}(square), 4);
    EXPECT_EQ(Coordination{}(apart), 0);
    auto cubic = lattice<3>(5, 1e-4);
    EXPECT_EQ(Coordination{}(cubic), 6);
}
// Each line of grains carries k overlap, and there is one in each pitch^(Dim - 1).
TEST(Stress, OfAPressedLattice)
{
    const double overlap = 1e-4, pitch = 2 * r - overlap;
    auto plane = lattice<2>(6, overlap);
    const auto s2 = Stress{box_of<2>(plane)}(plane);
    EXPECT_LT((s2 - k * overlap / pitch * Eigen::Matrix2d::Identity()).norm(), 1e-10 * s2.norm());
    auto space = lattice<3>(5, overlap);
    const auto s3 = Stress{box_of<3>(space)}(space);
    EXPECT_LT((s3 - k * overlap / (pitch * pitch) * Eigen::Matrix3d::Identity()).norm(), 1e-10 * s3.norm());
}
// Grains that fly by each other press as a gas does: n m <v v>; that all move together is no stress.
TEST(Stress, OfAGasIsItsMotionAgainstItself)
{
    auto gas = lattice<2>(6, -1e-3);
    const auto box = box_of<2>(gas);
    EXPECT_EQ(Stress{box}(gas).norm(), 0);
    const Vec<2, double> u{30, -7}, v{2, 0.5};
    for (std::size_t i = 0; i < gas.particles().size(); ++i) gas.particles().put(velocity, i, u + (i % 2 ? v : -v));
    gas.prepare();
    const double n = double(gas.particles().size()) / (box.size()[0] * box.size()[1]);
    Eigen::Matrix2d vv;
    vv << v[0] * v[0], v[0] * v[1], v[1] * v[0], v[1] * v[1];
    const auto s = Stress{box}(gas);
    EXPECT_LT((s - n * m * vv).norm(), 1e-12 * n * m * u.squaredNorm());
}
TEST(Stress, OfPartsAddsUpToThatOfTheWhole)
{
    auto sim = rough(Serial{});
    for (std::size_t i = 0; i < sim.particles().size(); ++i) sim.particles().put(velocity, i, {});
    sim.prepare();
    const Box<3> whole{{-1, -1, -1}, {1, 1, 1}}, low{{-1, -1, -1}, {1, 0.0021, 1}}, high{{-1, 0.0021, -1}, {1, 1, 1}};
    const auto s = Stress{whole}(sim);
    const double share = 1.0021 / 2;
    EXPECT_GT(s.trace(), 0);
    EXPECT_LT((s - share * Stress{low}(sim) - (1 - share) * Stress{high}(sim)).norm(), 1e-14 * s.norm());
    EXPECT_GT(Stress{low}(sim).norm(), 0.01 * s.norm());
    EXPECT_GT(Stress{high}(sim).norm(), 0.01 * s.norm());
}
// sigma V = -sum of x . f over the grains (virial): from the accelerations, not from the contacts.
TEST(Stress, ItsTraceIsTheVirial)
{
    auto sim = rough(Serial{});
    for (std::size_t i = 0; i < sim.particles().size(); ++i) sim.particles().put(velocity, i, {});
    sim.prepare();
    const auto s = Stress{Box<3>{{-1, -1, -1}, {1, 1, 1}}}(sim);
    sim.system().rates(sim.system().kicked);
    Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
    auto const& p = sim.particles();
    for (std::size_t i = 0; i < p.size(); ++i)
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) virial(a, b) += p.at(mass, i) * p.at(acceleration, i)[a] * p.at(position, i)[b];
    EXPECT_LT((8 * s - virial).norm(), 1e-12 * virial.norm());
}
TEST(Stress, DoesNotDependOnWhoAdds)
{
    auto one = rough(Serial{});
    auto three = rough(Threads{.count = 3, .cell = 2});
    const Box<3> box{{-0.05, -0.05, -0.05}, {0.03, 0.05, 0.05}};
    EXPECT_EQ(Stress{box}(one), Stress{box}(three));
    const auto a = contacts(one), b = contacts(three);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t n = 0; n < a.size(); ++n) {
        EXPECT_EQ(a[n].i, b[n].i);
        EXPECT_EQ(a[n].j, b[n].j);
        EXPECT_EQ(a[n].force, b[n].force);
    }
}
TEST(Stress, IsColumnsOfAHistory)
{
    const auto folder = std::filesystem::temp_directory_path() / ("spate_stress_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    auto sim = lattice<2>(6, 1e-4);
    sim.run({.steps = 1, .dt = 1e-6}, io::History(folder, 0, Coordination{}, Stress{box_of<2>(sim)}));
    std::ifstream in(folder / "history.csv");
    std::string head, row;
    std::getline(in, head), std::getline(in, row);
    EXPECT_TRUE(head.ends_with(",max_speed,coordination,stress_xx,stress_xy,stress_yx,stress_yy")) << head;
    EXPECT_EQ(std::count(head.begin(), head.end(), ','), std::count(row.begin(), row.end(), ','));
    EXPECT_NE(row.find(",4,502.5"), row.npos) << row; // k overlap / pitch = 10 N / 19.9 mm
    std::filesystem::remove_all(folder);
}

} // namespace
