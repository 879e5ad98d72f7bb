// SPDX-License-Identifier: BSD-3-Clause
#include "spate/io/start_lammps.hpp"

#include <functional>
#include <sstream>

#include <gmock/gmock.h>

#include "io/small_tank.hpp"

namespace {

using namespace spate;
using testing::HasSubstr;

/// As a script writes it for atom_style sphere: discs of 0.01 m and 0.1 kg in the order of nobody.
const std::string by_hand = R"(three discs

3 atoms
1 atom types
0 0.5 xlo xhi
0.25 1 ylo yhi
-0.01 0.01 zlo zhi

Atoms

2 1 0.02 23873.24146 0.25 0.5 0
1 1 0.02 23873.24146 0.125 0.75 0
3 1 0.02 23873.24146 0.375 0.5 0

Velocities

1 1 2 0 0 0 0
3 5 6 0 0 0 0
2 3 4 0 0 0 0
)";
/// What write_data of LAMMPS (29 Sep 2021) wrote.
const std::string written = R"(LAMMPS data file via write_data, version 29 Sep 2021, timestep = 3

2 atoms
1 atom types

0 0.1 xlo xhi
0 0.1 ylo yhi
-0.01 0.01 zlo zhi

Atoms # sphere

1 1 0.02 23873.24146 0.011092573664951942 0.02006008900028058 0 0 0 0
2 1 0.02 23873.24146 0.030138208339506655 0.019939910999470283 0 0 -1 0

Velocities

1 -0.21396617882446176 0.20096265920504125 0 0 0 0
2 0.6088366785546896 -0.20096267237530896 0 0 0 7
)";

std::string replaced(std::string text, std::string const& what, std::string const& by)
{
    const auto at = text.find(what);
    EXPECT_NE(at, text.npos) << what;
    return text.replace(at, what.size(), by);
}

class StartLammps : public small_tank::InFolder {
protected:
    template <int Dim = 2>
    io::Start<Dim> read(std::string const& content) const
    {
        const auto path = folder / "start.data";
        std::ofstream(path, std::ios::binary) << content;
        return io::start_lammps<Dim>(path);
    }
    template <int Dim = 2>
    std::string refusal(std::string const& content) const
    {
        try {
            read<Dim>(content);
        }
        catch (BadInput const& e) {
            return e.what();
        }
        return "no complaint";
    }
    /// With one place of the good file changed.
    template <int Dim = 2>
    std::string refusal(std::string const& what, std::string const& by) const
    {
        return refusal<Dim>(replaced(by_hand, what, by));
    }
};

TEST_F(StartLammps, ParticlesComeInTheOrderOfTheAtomsNumbers)
{
    const auto s = read(by_hand);
    ASSERT_EQ(s.size(), 3u);
    const Vec<2, double> x[] = {{0.125, 0.75}, {0.25, 0.5}, {0.375, 0.5}}, v[] = {{1, 2}, {3, 4}, {5, 6}};
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(s.x[k], x[k]) << k;
        EXPECT_EQ(s.v[k], v[k]) << k;
        EXPECT_EQ(s.radius[k], 0.01);
        EXPECT_NEAR(s.mass[k], 0.1, 1e-10); // the density has ten digits
    }
    EXPECT_TRUE(s.spin.empty());
    EXPECT_EQ(s.box->lo, (Vec<2, double>{0, 0.25}));
    EXPECT_EQ(s.box->hi, (Vec<2, double>{0.5, 1}));
}
TEST_F(StartLammps, ReadsWhatLammpsWrites)
{
    const auto s = read(written);
    ASSERT_EQ(s.size(), 2u);
    EXPECT_EQ(s.x[1], (Vec<2, double>{0.030138208339506655, 0.019939910999470283}));
    EXPECT_EQ(s.v[0], (Vec<2, double>{-0.21396617882446176, 0.20096265920504125}));
    ASSERT_EQ(s.spin.size(), 2u);
    EXPECT_EQ(s.spin[0], (Vec<3, double>{0, 0, 0}));
    EXPECT_EQ(s.spin[1], (Vec<3, double>{0, 0, 7}));
}
TEST_F(StartLammps, ReadsThreeDimensions)
{
    const auto s = read<3>(replaced(by_hand, "0.375 0.5 0\n", "0.375 0.5 0.005 1 -2 0\n"));
    EXPECT_EQ(s.x.at(2), (Vec<3, double>{0.375, 0.5, 0.005}));
    EXPECT_EQ(s.box->hi, (Vec<3, double>{0.5, 1, 0.01}));
}
TEST_F(StartLammps, WithoutVelocitiesAllAreAtRest)
{
    const auto s = read(by_hand.substr(0, by_hand.find("Velocities")));
    for (auto const& v : s.v) EXPECT_EQ(v, (Vec<2, double>{0, 0}));
    EXPECT_EQ(s.size(), 3u);
}
TEST_F(StartLammps, ATiltedBoxIsRefusedAndAFlatTiltIsNone)
{
    const std::string box = "-0.01 0.01 zlo zhi\n";
    EXPECT_THAT(refusal(box, box + "0.1 0 0 xy xz yz\n"),
                HasSubstr("the box in line 8 of " + (folder / "start.data").string() +
                          " is tilted (0.1 0 0 xy xz yz); allowed is a box of right angles"));
    EXPECT_EQ(refusal(box, box + "0 0 0 xy xz yz\n"), "no complaint");
    EXPECT_THAT(refusal("0 0.5 xlo xhi", "1 0.5 0 avec"), HasSubstr("is tilted"));
}
TEST_F(StartLammps, OtherUnitsAndStylesAreRefused)
{
    const std::string title = "three discs";
    EXPECT_THAT(refusal(title, "LAMMPS data file, timestep = 3, units = lj"),
                HasSubstr("the units in line 1 of " + (folder / "start.data").string() + " is lj; allowed is si"));
    EXPECT_EQ(refusal(title, "LAMMPS data file, timestep = 3, units = si"), "no complaint");
    EXPECT_THAT(refusal("Atoms", "Atoms # atomic"), HasSubstr("the atom_style in line 9"));
    EXPECT_THAT(refusal("Velocities", "Bonds"), HasSubstr("the section in line 15"));
    EXPECT_THAT(refusal("3 atoms\n", "3 atoms\n4 bonds\n"), HasSubstr("the header in line 4"));
    EXPECT_EQ(refusal("3 atoms\n", "3 atoms\n0 bonds\n"), "no complaint");
}
TEST_F(StartLammps, NamesTheLineThatCannotBeRead)
{
    const std::string first = "2 1 0.02 23873.24146 0.25 0.5 0\n", at = " in line 11 of ";
    auto atom = [&](std::string const& line) { return refusal(first, line + "\n"); };
    EXPECT_THAT(atom("2 1 0.02 23873.24146 0.25 0.5"), HasSubstr("the number of words" + at));
    EXPECT_THAT(atom("2 1 0.02 23873.24146 0.25 0.5 0 0"), HasSubstr("the number of words" + at));
    EXPECT_THAT(atom("2 1 0.02 23873.24146 0,25 0.5 0"), HasSubstr("x" + at));
    EXPECT_THAT(atom("2 1 0.02 23873.24146 0.25 nan 0"), HasSubstr("y" + at));
    EXPECT_THAT(atom("2 2 0.02 23873.24146 0.25 0.5 0"), HasSubstr("the type" + at));
    EXPECT_THAT(atom("2 1 0 23873.24146 0.25 0.5 0"), HasSubstr("the diameter" + at));
    EXPECT_THAT(atom("2 1 0.02 -1 0.25 0.5 0"), HasSubstr("the density" + at));
    EXPECT_THAT(atom("2.5 1 0.02 23873.24146 0.25 0.5 0"), HasSubstr("the number of the atom" + at));
    EXPECT_THAT(atom("0 1 0.02 23873.24146 0.25 0.5 0"), HasSubstr("the number of the atom" + at));
    EXPECT_THAT(refusal("1 1 2 0 0 0 0", "1 1 2 0 0 0"), HasSubstr("the number of words in line 17 of "));
    EXPECT_THAT(refusal("1 1 2 0 0 0 0", "1 1 z 0 0 0 0"), HasSubstr("vy in line 17 of "));
    EXPECT_THAT(refusal("0 0.5 xlo xhi", "0.5 0.5 xlo xhi"), HasSubstr("xhi in line 5 of "));
    EXPECT_THAT(refusal("0 0.5 xlo xhi", "0.5 0.7 ylo xhi"), HasSubstr("the header in line 5 of "));
}
TEST_F(StartLammps, CountsItsAtoms)
{
    EXPECT_THAT(refusal("3 atoms", "4 atoms"), HasSubstr("with 3 entries of Atoms; allowed is 4, as in its header"));
    EXPECT_THAT(refusal("3 atoms", "2 atoms"), HasSubstr("the section in line 13"));
    EXPECT_THAT(refusal("3 atoms\n", ""), HasSubstr("without the number of atoms"));
    EXPECT_THAT(refusal("0 0.5 xlo xhi\n", ""), HasSubstr("without a box"));
    EXPECT_THAT(refusal("2 1 0.02", "1 1 0.02"), HasSubstr("with atom 1 twice"));
    EXPECT_THAT(refusal("2 3 4 0", "4 3 4 0"), HasSubstr("with a velocity of atom 2 too few or too many"));
    EXPECT_THAT(refusal("\n\n0 atoms\n"), HasSubstr("without particles"));
}
TEST_F(StartLammps, AFlatSceneTakesNoThirdDimension)
{
    EXPECT_THAT(refusal("0.25 0.5 0\n", "0.25 0.5 0.001\n"), HasSubstr("atom 2 leaves the plane z = 0"));
    EXPECT_THAT(refusal("1 1 2 0 0 0 0", "1 1 2 3 0 0 0"), HasSubstr("atom 1 leaves the plane z = 0"));
    EXPECT_THAT(refusal("1 1 2 0 0 0 0", "1 1 2 0 3 0 0"), HasSubstr("atom 1 leaves the plane z = 0"));
}
TEST_F(StartLammps, StartsAScene)
{
    Simulation box(dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}), Leapfrog{},
                   Periodic(Box<2>{{0, 0}, {1, 1}}), Serial{});
    read(by_hand).add_to(box);
    ASSERT_EQ(box.particles().size(), 3u);
    EXPECT_EQ(box.particles().at(position, 2), (Vec<2, double>{0.375, 0.5}));
    EXPECT_NEAR(box.momentum()[0], 0.1 * (1 + 3 + 5), 1e-15);
}

TEST_F(StartLammps, SpinGoesToGrainsThatTurnAndToNoOther)
{
    const auto start = read(written);
    const Box<2> box{{0, 0}, {1, 1}};
    Simulation rough(dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}, Friction{.mu = 0.5}), Leapfrog{},
                     Periodic(box), Serial{});
    start.add_to(rough);
    EXPECT_EQ(rough.particles().at(angular_velocity, 0)[0], 0);
    EXPECT_EQ(rough.particles().at(angular_velocity, 1)[0], 7);
    Simulation smooth(dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}), Leapfrog{}, Periodic(box),
                      Serial{});
    EXPECT_THROW(start.add_to(smooth), BadInput);
    read(by_hand).add_to(smooth);
    EXPECT_EQ(smooth.particles().size(), 3u);
}
// What a mixture cannot do without.
TEST_F(StartLammps, SizesGoToGrainsOfManySizes)
{
    Simulation sim(dem<2>(Mixture{.largest = 0.02}, LinearSpring{.k = 1e5}), Leapfrog{},
                   Periodic(Box<2>{{0, 0}, {1, 1}}), Serial{});
    read(replaced(by_hand, "1 1 0.02", "1 1 0.04")).add_to(sim);
    EXPECT_EQ(sim.particles().at(radius, 0), 0.02);
    EXPECT_EQ(sim.particles().at(radius, 1), 0.01);
    EXPECT_NEAR(sim.particles().at(mass, 0), 0.8, 1e-9);
    sim.run({.steps = 1, .dt = 1e-5});
}

} // namespace
