// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Threads by OpenMP: each begins with the same tasks in every loop, and helps others when it is done; no task writes
/// what another one writes.
#pragma once

#include "spate/core/errors.hpp"

#include <atomic>
#include <cstddef>
#include <exception>
#include <memory>
#include <type_traits>
#include <vector>

#include <omp.h>

namespace spate {

/// Runs tasks on several threads of one process.
struct Threads {
    int count = 0; ///< threads; 0: as many as OpenMP offers
    int cell = 0;  ///< ranges along a cell's edge; 0: by dimension

    static constexpr const char* name = "threads";
    [[nodiscard]] int threads() const { return count > 0 ? count : omp_get_max_threads(); }
    [[gnu::cold]] void check() const
    {
        require(count >= 0 && count <= 4096, "Threads.count", count, "0 (all) to 4096");
    }
    void for_each(std::size_t tasks, auto const& run) const
    {
        using Run = std::remove_cvref_t<decltype(run)>;
        share(
            tasks, [](void const* what, std::size_t k) { (*static_cast<Run const*>(what))(k); }, std::addressof(run));
    }

private:
    /// Tasks with which a thread begins, and what is left of them; a line of the cache of its own.
    struct alignas(64) Stretch {
        std::atomic<std::size_t> next = 0;
        std::size_t end = 0;
    };
    /// Calls task(what, k) for each k; compiled once, whatever the task. What a task wrote in one loop is read by that task in the
    /// next: it is near the thread that begins with the same stretch each time.
    [[gnu::noinline]] void share(std::size_t tasks, void (*task)(void const*, std::size_t), void const* what) const
    {
        const auto team = static_cast<std::size_t>(threads());
        if (team == 1 || tasks < 2) {
            for (std::size_t k = 0; k < tasks; ++k) task(what, k);
            return;
        }
        std::exception_ptr first;
        std::vector<Stretch> stretches(team);
        for (std::size_t t = 0; t < team; ++t)
            stretches[t].next = tasks * t / team, stretches[t].end = tasks * (t + 1) / team;
#pragma omp parallel num_threads(int(team))
        for (std::size_t t = 0; t < team; ++t) { // its own first
            auto& stretch = stretches[(static_cast<std::size_t>(omp_get_thread_num()) + t) % team];
            for (std::size_t k; (k = stretch.next.fetch_add(1, std::memory_order_relaxed)) < stretch.end;) {
                try {
                    task(what, k);
                }
                catch (...) {
#pragma omp critical(spate_threads_exception)
                    if (!first) first = std::current_exception();
                }
            }
        }
        if (first) std::rethrow_exception(first);
    }
};

} // namespace spate
