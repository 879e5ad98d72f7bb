// SPDX-License-Identifier: BSD-3-Clause
#include <spate/backend/threads.hpp>

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace {
using namespace spate;

/// How often each of so many tasks was done.
std::vector<std::atomic<int>> done_by(Threads const& threads, std::size_t tasks)
{
    std::vector<std::atomic<int>> done(tasks);
    threads.for_each(tasks, [&](std::size_t k) { ++done[k]; });
    return done;
}

TEST(Threads, DoEachTaskOnce)
{
    for (const int count : {1, 2, 3, 7, 64})
        for (const std::size_t tasks : {0u, 1u, 2u, 5u, 63u, 1000u})
            for (auto const& times : done_by(Threads{count}, tasks))
                ASSERT_EQ(times, 1) << count << " threads, " << tasks << " tasks";
}

TEST(Threads, DoTheTasksOfThoseWhoAreMissing)
{
    std::atomic<int> wrong = 0;
#pragma omp parallel num_threads(2)
    { // within a parallel region OpenMP gives one thread to each that asks for three
        for (auto const& times : done_by(Threads{3}, 100)) wrong += times != 1;
    }
    EXPECT_EQ(wrong, 0);
}

TEST(Threads, HelpOneThatIsHeldUp)
{
    constexpr int tasks = 100;
    std::atomic<int> done = 0;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    Threads{2}.for_each(tasks, [&](std::size_t k) {
        if (k == 0) // until others have done all the tasks of this thread but this one
            while (done < tasks - 1 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
        ++done;
        if (k == 0) {
            EXPECT_EQ(done, tasks);
        }
    });
}

TEST(Threads, PassOnWhatATaskThrows)
{
    std::atomic<int> done = 0;
    try {
        Threads{3}.for_each(100, [&](std::size_t k) {
            if (k == 40) throw BadInput("forty", "40", "another number");
            ++done;
        });
        FAIL() << "what a task throws is lost";
    }
    catch (BadInput const& e) {
        EXPECT_NE(std::string(e.what()).find("forty"), std::string::npos);
    }
    EXPECT_EQ(done, 99) << "others are done all the same";
}

} // namespace
