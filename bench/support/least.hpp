// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief How time is taken: CPU time of the thread, the least of many turns. On a shared machine the mean says who else
/// was busy; the least says what the code costs.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>

#include <benchmark/benchmark.h>

namespace bench {

inline double cpu_seconds()
{
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}
inline double wall_seconds()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The least time of a call so far [s].
struct Least {
    double seconds = std::numeric_limits<double>::infinity();

    void of(auto const& call)
    {
        const double start = cpu_seconds();
        call();
        seconds = std::min(seconds, cpu_seconds() - start);
    }
    [[nodiscard]] double ns(double items) const { return 1e9 * seconds / items; }
};

/// The least time of a call over the turns of a benchmark, as its counter "ns" an item. A call shorter than about 50 us
/// would measure the clock: `calls` of them make a turn.
inline void least(benchmark::State& state, double items, int calls, auto const& call)
{
    Least time;
    for (auto _ : state) {
        time.of([&] {
            for (int k = 0; k < calls; ++k) call();
        });
    }
    state.counters["ns"] = time.ns(items * calls);
}

} // namespace bench
