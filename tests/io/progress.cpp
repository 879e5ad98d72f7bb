// SPDX-License-Identifier: BSD-3-Clause
#include "spate/io/progress.hpp"

#include <algorithm>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

namespace {

using spate::io::Progress;

/// All that progress looks at.
struct Clockwork {
    double t = 0;
    std::int64_t n = 0;
    double time() const { return t; }
    std::int64_t steps() const { return n; }
};

std::string told(double until, std::int64_t steps, Progress::Shown shown, int run)
{
    std::ostringstream out;
    Progress progress(until, steps, shown, out);
    Clockwork scene;
    progress.begin(scene);
    for (int k = 1; k <= run; ++k) {
        scene = {k * 0.001, k};
        progress.step(scene);
    }
    progress.end(scene);
    return out.str();
}
constexpr auto unlimited = std::numeric_limits<std::int64_t>::max();
auto lines(std::string const& text) { return std::count(text.begin(), text.end(), '\n'); }

TEST(Progress, TellsEachTenthOnceWithoutATerminal)
{
    const auto text = told(1, unlimited, Progress::Shown::tenths, 1000);
    EXPECT_EQ(lines(text), 10);
    EXPECT_EQ(text.find(" 10 %  t = 0.1 s  step 100  0 s left"), 0u) << text;
    EXPECT_NE(text.find("100 %  t = 1 s  step 1000  0 s left"), std::string::npos) << text;
}

TEST(Progress, GoesByStepsIfTheyEndTheRun)
{
    EXPECT_EQ(lines(told(std::numeric_limits<double>::infinity(), 50, Progress::Shown::tenths, 50)), 10);
}

TEST(Progress, RenewsOneLineInATerminal)
{
    const auto text = told(1, unlimited, Progress::Shown::live, 1000);
    EXPECT_EQ(lines(text), 1);
    EXPECT_EQ(text.front(), '\r');
    EXPECT_NE(text.find("100 %"), std::string::npos);
}

TEST(Progress, IsSilentWhenAsked) { EXPECT_EQ(told(1, unlimited, Progress::Shown::nothing, 1000), ""); }

} // namespace
