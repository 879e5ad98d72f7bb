// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The reference backend: one thread, tasks in order.
#pragma once

#include <cstddef>

namespace spate {

/// Runs tasks one after the other.
struct Serial {
    int cell = 0; ///< ranges along a cell's edge; 0: by dimension

    static constexpr const char* name = "serial";
    [[nodiscard]] int threads() const { return 1; }
    void check() const {}
    void for_each(std::size_t tasks, auto const& run) const
    {
        for (std::size_t k = 0; k < tasks; ++k) run(k);
    }
};

} // namespace spate
