// SPDX-License-Identifier: BSD-3-Clause
// X07: more neighbours than a list may hold, or than there is memory for, are a typed stop.
#include <spate/spate.hpp>

#include <cstdio>
#include <fstream>
#include <random>

#include <sys/resource.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace spate;
using testing::HasSubstr;

struct CountNeighbours {
    static constexpr Fields adds{acceleration};
    void operator()(auto& i, auto const&, auto const& ij) const { i[acceleration] += 1e-9 * ij.grad_w; }
};

/// A thin lattice, and so many within a tenth of one range in its midst.
auto crowd(std::size_t many, Neighbours neighbours = {})
{
    Simulation s(physics(Smoothing<CubicSpline<2>>{{.h = 0.02}}, Uniform{mass, 1}, CountNeighbours{}), Leapfrog{},
                 Open{}, Serial{}, Double{}, Watch{}, neighbours);
    for (int k = 0; k < 20; ++k)
        for (int l = 0; l < 20; ++l) s.add({0.03 * k, 0.03 * l}, {1, 2});
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> in(0, 0.004);
    for (std::size_t k = 0; k < many; ++k) s.add({0.3 + in(random), 0.3 + in(random)}, {1, 2});
    return s;
}

TEST(Crowd, X07OfMoreNeighboursThanAllowedIsAStopThatNamesOneOfThem)
{
    auto s = crowd(600, {.most = 500});
    try {
        s.run({.steps = 1, .dt = 1e-6});
        FAIL() << "went on";
    }
    catch (NeighbourOverflow const& stop) {
        auto const& f = stop.facts();
        EXPECT_GE(f.particle, 0);
        EXPECT_EQ(f.species, 0);
        EXPECT_EQ(f.limit, 500);
        EXPECT_GT(f.value, 500);
        EXPECT_LE(f.value, 609);                  // and those of the lattice
        EXPECT_NEAR(f.position[0], 0.302, 0.044); // in it, or of the lattice and in reach of all of it
        EXPECT_EQ(f.velocity[1], 2);
        EXPECT_THAT(stop.what(), HasSubstr("its number of neighbours"));
    }
}
TEST(Crowd, X07OfAsManyAsAllowedGoesOn)
{
    auto s = crowd(600, {.most = 620});
    s.run({.steps = 2, .dt = 1e-6});
    EXPECT_EQ(s.steps(), 2);
}
/// Lets this process have so much more memory than it has.
void allow(std::size_t more)
{
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit limit{};
    getrlimit(RLIMIT_AS, &limit);
    limit.rlim_cur = pages * std::size_t(sysconf(_SC_PAGESIZE)) + more;
    setrlimit(RLIMIT_AS, &limit);
}
// 8000 that all see each other: 256 MB of lists.
TEST(CrowdDeathTest, X07OfMoreThanMemoryHoldsIsAStop)
{
    auto run = [] {
        allow(100 << 20);
        try {
            crowd(8000).run({.steps = 1, .dt = 1e-6});
        }
        catch (NeighbourOverflow const& stop) {
            std::fputs(stop.what(), stderr);
            std::_Exit(3);
        }
        std::_Exit(0);
    };
    EXPECT_EXIT(run(), testing::ExitedWithCode(3), "NeighbourOverflow at step 0.*more memory than there is");
}

} // namespace
