// SPDX-License-Identifier: BSD-3-Clause
#include "spate/io/snapshots.hpp"

#include "io/small_tank.hpp"

namespace {

using namespace spate;
using io::Snapshots;

class SnapshotsTest : public small_tank::InFolder {};

TEST(CloudOf, HoldsAllSpeciesInTheOrderOfTheirIds)
{
    auto tank = small_tank::scene();
    tank.refresh();
    const io::Cloud cloud = io::cloud_of(tank);
    auto const& fluid = tank.particles();
    auto const& wall = tank.system().species<1>().particles;
    ASSERT_EQ(cloud.size(), fluid.size() + wall.size());
    std::vector<std::string> names;
    for (auto const& c : cloud.columns) names.push_back(c.name);
    EXPECT_EQ(names,
              (std::vector<std::string>{"velocity", "density", "pressure"})); // neither rates nor what is uniform
    auto same = [&](auto const& p, std::size_t first, std::uint8_t species) {
        for (std::size_t i = 0; i < p.size(); ++i) {
            const std::size_t k = first + p.id()[i];
            ASSERT_EQ(cloud.id[k], p.id()[i]);
            EXPECT_EQ(cloud.species[k], species);
            EXPECT_EQ(cloud.points[3 * k], float(p.at(position, i)[0]));
            EXPECT_EQ(cloud.points[3 * k + 1], float(p.at(position, i)[1]));
            EXPECT_EQ(cloud.points[3 * k + 2], 0);
            EXPECT_EQ(cloud.columns[0].values[3 * k + 1], float(p.at(velocity, i)[1]));
            EXPECT_EQ(cloud.columns[1].values[k], float(p.at(density, i)));
            EXPECT_EQ(cloud.columns[2].values[k], float(p.at(pressure, i)));
        }
    };
    same(fluid, 0, 0);
    same(wall, fluid.size(), 1);
}

TEST_F(SnapshotsTest, AreWrittenAtEvenTimesAndAtTheEnd)
{
    auto tank = small_tank::scene();
    Snapshots snapshots(folder, "tank", 1 / 1024.0);
    tank.run({.steps = 9, .dt = 1 / 4096.0}, snapshots);
    EXPECT_EQ(snapshots.count(), 4u); // t = 0, 4/4096, 8/4096, 9/4096
    EXPECT_EQ(snapshots.last(), folder / "tank_000003.hdf");
    for (auto* name : {"tank_000000.hdf", "tank_000001.hdf", "tank_000002.hdf", "tank_000003.hdf", "tank.hdf.series"})
        EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
    EXPECT_FALSE(std::filesystem::exists(folder / "tank_000004.hdf"));
}

TEST_F(SnapshotsTest, AreOneOfTheLastStateIfNoIntervalIsGiven)
{
    auto tank = small_tank::scene();
    Snapshots snapshots(folder, "tank", 0);
    tank.run({.steps = 3}, snapshots);
    EXPECT_EQ(snapshots.count(), 1u);
    EXPECT_THROW(Snapshots(folder, "tank", -1), BadInput);
}

} // namespace
