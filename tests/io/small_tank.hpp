// SPDX-License-Identifier: BSD-3-Clause
// A little water in a tank, and a folder that is gone after the test: for the tests of outputs.
#pragma once

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <spate/spate.hpp>

namespace small_tank {

inline constexpr double dx = 0.05;

template <class Backend = spate::Serial>
auto scene(Backend backend = {})
{
    using namespace spate;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 30}, Continuity<2>{}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -9.81}});
    Simulation tank(water, RungeKutta2{}, Bce(Box<2>{{0, 0}, {1, 1}}, dx, Adami{}, open(top)), backend);
    tank.fill(Box<2>{{0, 0}, {0.5, 0.5}}, dx, hydrostatic);
    return tank;
}

/// Lets files grow to `bytes` only, as a full disk would.
class SmallDisk {
public:
    explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN))
    {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit small{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &small);
    }
    SmallDisk(SmallDisk const&) = delete;
    SmallDisk& operator=(SmallDisk const&) = delete;
    ~SmallDisk()
    {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    rlimit before_{};
    void (*handler_)(int);
};

class InFolder : public testing::Test {
protected:
    void SetUp() override
    {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder = std::filesystem::temp_directory_path() / (std::string("spate_") + test->test_suite_name() + "_" +
                                                           test->name() + "_" + std::to_string(::getpid()));
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    static std::string content(std::filesystem::path const& file)
    {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    std::filesystem::path folder;
};

} // namespace small_tank
