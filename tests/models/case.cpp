// SPDX-License-Identifier: BSD-3-Clause
#include "models/case.hpp"

#include <gtest/gtest-spi.h>

#include <filesystem>
#include <sstream>

namespace {

/// What is written to the table of all cases while `judge` runs, and how many assertions fail in it.
struct Told {
    std::string rows;
    int failures = 0;
};
template <class F>
Told told_of(F judge)
{
    const auto folder = std::filesystem::temp_directory_path() / ("spate_case_" + std::to_string(std::clock()));
    std::filesystem::create_directories(folder);
    const char* before = std::getenv("SPATE_RESULTS");
    const std::string kept = before == nullptr ? "" : before;
    ::setenv("SPATE_RESULTS", folder.c_str(), 1);
    Told told;
    {
        ::testing::TestPartResultArray results;
        {
            ::testing::ScopedFakeTestPartResultReporter catcher(
                ::testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &results);
            judge();
        }
        for (int k = 0; k < results.size(); ++k) told.failures += results.GetTestPartResult(k).failed();
    }
    before == nullptr ? ::unsetenv("SPATE_RESULTS") : ::setenv("SPATE_RESULTS", kept.c_str(), 1);
    std::ifstream file(folder / "measured.csv");
    std::stringstream text;
    text << file.rdbuf();
    told.rows = text.str();
    std::filesystem::remove_all(folder);
    return told;
}

TEST(Case, WritesANumberWithItsGateWhetherItIsMetOrNot)
{
    const Told t = told_of([] {
        const models::Case c("V99", "a scene, with a comma", 40);
        c.at_most("error", 0.02, 0.01);
        c.at_most("error", 0.005, 0.01);
        c.at_least("order", 1.5, 1.8);
        c.told("loss", 0.3);
    });
    EXPECT_EQ(t.failures, 2);
    const std::string head = "Case.WritesANumberWithItsGateWhetherItIsMetOrNot,V99,\"a scene, with a comma\",";
    EXPECT_NE(t.rows.find(head + "\"error\",40,0.02,<=,0.01,missed,"), std::string::npos) << t.rows;
    EXPECT_NE(t.rows.find(head + "\"error\",40,0.005,<=,0.01,met,"), std::string::npos) << t.rows;
    EXPECT_NE(t.rows.find(head + "\"order\",40,1.5,>=,1.8,missed,"), std::string::npos) << t.rows;
    EXPECT_NE(t.rows.find(head + "\"loss\",40,0.3,,,told,"), std::string::npos) << t.rows;
}
TEST(Case, WritesAKnownGapWithTheGateOfItsTable)
{
    const auto gap = spate::oracle::table("known_gaps.csv").at(0);
    const Told t = told_of(
        [&] { models::Case("V99", "a scene", 20).known_gap("drift", std::stod(gap.at("reached")), gap.at("gap")); });
    EXPECT_EQ(t.failures, 0);
    EXPECT_NE(t.rows.find(",known gap,"), std::string::npos) << t.rows;
}

} // namespace
