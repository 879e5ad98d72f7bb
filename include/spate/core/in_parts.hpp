// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Loops over a range whose parts may be done in any order, or at the same time: f(first, last) for each part.
#pragma once

#include <cstddef>

namespace spate {

/// The range is one part.
struct InOnePart {
    void operator()(std::size_t n, auto const& f) const { f(std::size_t(0), n); }
};
/// The workers of a backend share parts of like length.
template <class Workers>
struct InParts {
    Workers const& workers;

    void operator()(std::size_t n, auto const& f) const
    {
        const std::size_t parts = 4 * std::size_t(workers.threads()); // some for those who are done sooner
        workers.for_each(parts, [&](std::size_t k) { f(n * k / parts, n * (k + 1) / parts); });
    }
};
template <class Workers>
InParts(Workers const&) -> InParts<Workers>;

} // namespace spate
