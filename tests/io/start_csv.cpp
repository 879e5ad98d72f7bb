// SPDX-License-Identifier: BSD-3-Clause
#include "spate/io/start_csv.hpp"

#include <functional>

#include <gmock/gmock.h>

#include "io/small_tank.hpp"

namespace {

using namespace spate;
using testing::HasSubstr;

class StartCsv : public small_tank::InFolder {
protected:
    std::filesystem::path file(std::string const& content) const
    {
        const auto path = folder / "start.csv";
        std::ofstream(path, std::ios::binary) << content;
        return path;
    }
    static std::string sentence(std::function<void()> const& read)
    {
        try {
            read();
        }
        catch (BadInput const& e) {
            return e.what();
        }
        return "no complaint";
    }
    std::string refusal(std::string const& content) const
    {
        const auto path = file(content);
        return sentence([&] { io::start_csv<2>(path); });
    }
};

TEST_F(StartCsv, ReadsEachBitOfEachNumber)
{
    const auto s = io::start_csv<2>(file("0.1,0.30000000000000004,-1e-300,+2.5E3\n1,2,3,4\n"));
    ASSERT_EQ(s.size(), 2u);
    EXPECT_EQ(s.x[0], (Vec<2, double>{0.1, 0.1 + 0.2}));
    EXPECT_EQ(s.v[0], (Vec<2, double>{-1e-300, 2500}));
    EXPECT_EQ(s.x[1], (Vec<2, double>{1, 2}));
    EXPECT_EQ(s.v[1], (Vec<2, double>{3, 4}));
    EXPECT_TRUE(s.radius.empty());
    EXPECT_TRUE(s.mass.empty());
    EXPECT_FALSE(s.box);
}
TEST_F(StartCsv, ReadsThreeDimensions)
{
    const auto s = io::start_csv<3>(file("1,2,3,4,5,6"));
    EXPECT_EQ(s.x.at(0), (Vec<3, double>{1, 2, 3}));
    EXPECT_EQ(s.v.at(0), (Vec<3, double>{4, 5, 6}));
}
TEST_F(StartCsv, HeadingNamesTheColumns)
{
    const auto s = io::start_csv<2>(file("# a heap\r\n\r\nradius, vy,vx , y,x\r\n0.5,4,3,2,1 # the first\r\n\r\n"));
    ASSERT_EQ(s.size(), 1u);
    EXPECT_EQ(s.x[0], (Vec<2, double>{1, 2}));
    EXPECT_EQ(s.v[0], (Vec<2, double>{3, 4}));
    EXPECT_EQ(s.radius, std::vector<double>{0.5});
    EXPECT_TRUE(s.mass.empty());
}
TEST_F(StartCsv, NamesTheLineThatCannotBeRead)
{
    const std::string at = " in line 3 of " + (folder / "start.csv").string() + " is ";
    const std::string good = "# positions\n1,2,3,4\n";
    EXPECT_THAT(refusal(good + "1,2,3"), HasSubstr("number of columns" + at + "3; allowed is 4: x, y, vx, vy"));
    EXPECT_THAT(refusal(good + "1,2,3,4,5,6"), HasSubstr("number of columns" + at + "6"));
    EXPECT_THAT(refusal(good + "1,2,,4"), HasSubstr("vx" + at + "\"\"; allowed is a finite number"));
    EXPECT_THAT(refusal(good + "1,2 3,3,4"), HasSubstr("y" + at + "\"2 3\""));
    for (auto* bad : {"nan", "inf", "-inf", "1e999", "0x1", "1.5m", "--1", "1;"})
        EXPECT_THAT(refusal(good + bad + ",2,3,4"), HasSubstr("x" + at + "\"" + bad + "\"")) << bad;
    EXPECT_THAT(refusal("x,y,vx,vy,mass\n1,2,3,4,1\n1,2,3,4,-1"),
                HasSubstr("mass" + at + "-1; allowed is a number above 0"));
}
TEST_F(StartCsv, RefusesAHeadingThatItCannotFollow)
{
    const std::string at = "the heading in line 1 of " + (folder / "start.csv").string() + " is ";
    EXPECT_THAT(refusal("x,y,z,vx,vy,vz\n1,2,3,4,5,6"), HasSubstr(at + "\"z\"; allowed is x, y, vx, vy"));
    EXPECT_THAT(refusal("x,y,vx\n1,2,3"), HasSubstr(at + "without vy; allowed is one with x, y, vx, vy"));
    EXPECT_THAT(refusal("x,y,vx,vy,x\n1,2,3,4,5"), HasSubstr(at + "\"x\" twice"));
}
TEST_F(StartCsv, RefusesAFileThatGivesNoParticle)
{
    EXPECT_THAT(refusal(""), HasSubstr("start.csv is empty; allowed is one particle a line: x, y, vx, vy"));
    EXPECT_THAT(refusal("# only a comment\n\n"), HasSubstr("start.csv is empty"));
    EXPECT_THAT(refusal("x,y,vx,vy\n"), HasSubstr("start.csv is without particles"));
    EXPECT_THAT(sentence([&] { io::start_csv<2>(folder / "none.csv"); }),
                HasSubstr("none.csv is No such file or directory; allowed is a file to be read"));
    EXPECT_THAT(sentence([&] { io::start_csv<2>(folder); }), HasSubstr(" is Is a directory; allowed"));
}
TEST_F(StartCsv, ParticlesKeepTheOrderOfTheFileInTheirIds)
{
    Simulation box(dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}), Leapfrog{},
                   Periodic(Box<2>{{0, 0}, {1, 1}}), Serial{});
    const auto path = file("x,y,vx,vy,radius\n0.9,0.5,1,0,0.01\n0.1,0.5,2,0,0.01\n0.5,0.5,3,0,0.01\n");
    io::start_csv<2>(path).add_to(box);
    box.run({.steps = 1, .dt = 1e-5}); // sorts
    ASSERT_EQ(box.particles().size(), 3u);
    const double speed[] = {1, 2, 3};
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(box.particles().at(velocity, i)[0], speed[box.particles().id()[i]]) << i;
}
TEST_F(StartCsv, RadiusOfTheFileMustBeThatOfEqualGrains)
{
    Simulation box(dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}), Leapfrog{},
                   Periodic(Box<2>{{0, 0}, {1, 1}}), Serial{});
    const auto path = file("x,y,vx,vy,radius\n0.9,0.5,1,0,0.01\n0.1,0.5,2,0,0.02\n");
    EXPECT_THAT(sentence([&] { io::start_csv<2>(path).add_to(box); }),
                HasSubstr("radius of particle 1 of the start file is 0.02; allowed is that of the model, 0.01 m"));
    EXPECT_TRUE(box.particles().empty());
}

} // namespace
