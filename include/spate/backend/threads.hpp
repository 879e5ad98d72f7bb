// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Threads by OpenMP: tasks are handed out as threads become free; no task writes what another one writes.
#pragma once

#include "spate/core/errors.hpp"

#include <cstddef>
#include <exception>
#include <memory>
#include <type_traits>

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
    /// Calls task(what, k) for each k; compiled once, whatever the task.
    [[gnu::noinline]] void share(std::size_t tasks, void (*task)(void const*, std::size_t), void const* what) const
    {
        const int team = threads();
        if (team == 1 || tasks < 2) {
            for (std::size_t k = 0; k < tasks; ++k) task(what, k);
            return;
        }
        std::exception_ptr first;
#pragma omp parallel for schedule(dynamic) num_threads(team)
        for (std::size_t k = 0; k < tasks; ++k) {
            try {
                task(what, k);
            }
            catch (...) {
#pragma omp critical(spate_threads_exception)
                if (!first) first = std::current_exception();
            }
        }
        if (first) std::rethrow_exception(first);
    }
};

} // namespace spate
