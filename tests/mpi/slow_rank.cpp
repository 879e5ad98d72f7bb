// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: a process that gets half of its time gets half as much to do. Costs are measured by the clock, as in a run.
#include "spate/backend/mpi.hpp"
#include "spate/spate.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <ctime>
#include <thread>

#include <pthread.h>

namespace {

using namespace spate;

/// Lets the thread that made it sleep half of the time, whatever it does: in turns of a millisecond.
class HalfAsleep {
public:
    HalfAsleep()
    {
        struct sigaction action {};
        action.sa_handler = [](int) {
            const timespec turn{0, 1'000'000};
            nanosleep(&turn, nullptr);
        };
        action.sa_flags = SA_RESTART;
        sigaction(SIGUSR2, &action, &before_);
        clock_ = std::thread([this, sleeper = pthread_self()] {
            while (!done_) {
                std::this_thread::sleep_for(std::chrono::milliseconds(2));
                pthread_kill(sleeper, SIGUSR2);
            }
        });
    }
    HalfAsleep(HalfAsleep const&) = delete;
    HalfAsleep& operator=(HalfAsleep const&) = delete;
    ~HalfAsleep()
    {
        done_ = true;
        clock_.join();
        sigaction(SIGUSR2, &before_, nullptr);
    }

private:
    struct sigaction before_ {};
    std::atomic<bool> done_{false};
    std::thread clock_;
};

struct Seen {
    double imbalance = 0; ///< time in tasks of cells, the cost that is balanced here: largest over the mean
    double slow = 0;      ///< share of all pairs of the last rank, which is half asleep
    double step = 0;      ///< wall time [s]
    double awake = 1;     ///< least share of the time that another rank had a processor
    std::int64_t cuts = 0;
    std::uint64_t hash = 0;
};
/// The share of a fifth of a second that this thread has a processor for, if it wants to.
double awake()
{
    auto cpu = [] {
        timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
    };
    using Clock = std::chrono::steady_clock;
    const double before = cpu();
    const auto start = Clock::now(), end = start + std::chrono::milliseconds(200);
    while (Clock::now() < end) {}
    return (cpu() - before) / std::chrono::duration<double>(Clock::now() - start).count();
}
/// Water in one corner of a tank; the first steps are for shares to settle.
Seen corner(Balance balance)
{
    const MpiRanks ranks;
    std::optional<HalfAsleep> slow;
    if (ranks.rank() == ranks.count() - 1) slow.emplace();
    constexpr double dx = 0.0025, g = 9.81, height = 0.5;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 10 * std::sqrt(2 * g * height)},
                       Continuity<2>{}, PressureForce<2>{}, ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -g}});
    Bce tank(Box<2>{{}, {{2, 1}}}, dx, Adami{}, open(top));
    Simulation sim(water, RungeKutta2{}, tank, Mpi{Serial{}, 4, balance});
    sim.fill(Box<2>{{}, {{0.5, height}}}, dx, hydrostatic);
    auto& p = sim.particles();
    for (std::size_t i = 0; i < p.size(); ++i) p.put(velocity, i, {{4 * p.at(position, i)[0], 0}}); // already falling
    sim.run({.steps = 150, .cfl = 0.2});
    const double busy = sim.system().parts().report().busy;
    double least = awake();
    const auto start = std::chrono::steady_clock::now();
    constexpr int steps = 150;
    sim.run({.steps = steps, .cfl = 0.2});
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    least = std::min(least, awake());
    auto const& s = sim.system();
    const auto ns = std::int64_t(1e9 * (s.parts().report().busy - busy));
    const auto most = ranks.all(ns, agree::Most{}), sum = ranks.all(ns, agree::Sum{});
    const auto pairs = std::int64_t(s.template lists<0, 0>().pairs() + s.template lists<0, 1>().pairs() +
                                    s.template lists<1, 0>().pairs());
    const auto of_slow = ranks.all(slow ? pairs : 0, agree::Sum{}), of_all = ranks.all(pairs, agree::Sum{});
    return {double(most) * ranks.count() / double(sum),
            double(of_slow) / double(of_all),
            ranks.all(wall.count(), agree::Most{}) / steps,
            ranks.all(slow ? 1 : least, agree::Least{}),
            s.parts().report().cuts,
            sim.state_hash()};
}

// Of two ranks the slow one takes 4/3 of the mean if both have as many pairs, and has a third of them if both take as long.
TEST(LongSlowRank, GetsLess)
{
    const Seen off = corner({.every = 0}), on = corner({.every = 1, .tolerated = 1, .a_particle = 0});
    if (MpiRanks().rank() == 0)
        for (Seen const& s : {off, on})
            std::printf("time of the slowest rank %.3f of the mean, pairs of the slow one %.3f of all, %.2f ms a step, "
                        "%lld cuts; others had a processor for %.2f of the time\n",
                        s.imbalance, s.slow, 1e3 * s.step, static_cast<long long>(s.cuts), s.awake);
    EXPECT_EQ(on.hash, off.hash);
    EXPECT_EQ(off.cuts, 0);
    EXPECT_GT(on.cuts, 0);
    if (std::min(on.awake, off.awake) < 0.95) GTEST_SKIP() << "other programs take the processors of ranks";
    EXPECT_GT(off.imbalance, 1.2);
    EXPECT_LT(on.imbalance, 1.1);
    EXPECT_LT(on.step, off.step);
}

} // namespace
