// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What a case of the validation plan is judged by: a number and its gate, asserted, and written down for the table of
/// all cases (bench/validation) in the same call, so that no number is typed.
#pragma once

#include "models/known_gap.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

namespace models {

/// One scene at one resolution. Made before its run, since the CPU time of its rows is counted from there on.
class Case {
public:
    /// \param id     of the validation plan, such as V15
    /// \param scene  in a few words
    /// \param n      spacings in the length of the case; 0: of no one resolution, as an order is
    Case(std::string id, std::string scene, int n) : id_(std::move(id)), scene_(std::move(scene)), n_(n) {}

    /// An error from above.
    void at_most(std::string const& what, double value, double gate) const
    {
        EXPECT_LE(value, gate) << id_ << ", " << scene_ << ", " << what << ", n " << n_;
        row(what, value, "<=", gate, value <= gate ? "met" : "missed");
    }
    /// An order from below.
    void at_least(std::string const& what, double value, double gate) const
    {
        EXPECT_GE(value, gate) << id_ << ", " << scene_ << ", " << what << ", n " << n_;
        row(what, value, ">=", gate, value >= gate ? "met" : "missed");
    }
    /// A number for which the plan has no gate.
    void told(std::string const& what, double value) const { row(what, value, "", 0, "told"); }
    /// A gate from above that is not met: a row of tests/data/known_gaps.csv.
    void known_gap(std::string const& what, double value, std::string const& name) const
    {
        row(what, value, "<=", gap_of(name).gate, "known gap");
        models::known_gap(name, value);
    }

private:
    std::string id_, scene_;
    int n_;
    std::clock_t start_ = std::clock();

    void row(std::string const& what, double value, char const* sense, double gate, char const* status) const
    {
        const double cpu = double(std::clock() - start_) / CLOCKS_PER_SEC;
        std::printf("%s, %s, n %d: %s %.4g %s\n", id_.c_str(), scene_.c_str(), n_, what.c_str(), value, status);
        const char* folder = std::getenv("SPATE_RESULTS");
        if (folder == nullptr) return;
        std::ofstream file(std::string(folder) + "/measured.csv", std::ios::app);
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        file << test->test_suite_name() << '.' << test->name() << ',' << id_ << ",\"" << scene_ << "\",\"" << what
             << "\"," << n_ << ',' << value << ',' << sense << ',';
        if (*sense != 0) file << gate;
        file << ',' << status << ',' << cpu << '\n';
    }
};

} // namespace models
