// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What a backend is: who does the work. Tasks are independent; their order and their worker change no bit.
#pragma once

#include <concepts>
#include <cstddef>

namespace spate {

// clang-format off
template <class B>
concept Backend = requires(B const b, std::size_t tasks, void (*run)(std::size_t)) {
    { B::name } -> std::convertible_to<const char*>;
    { b.cell } -> std::convertible_to<int>;      // ranges along a cell's edge; 0: by dimension
    { b.threads() } -> std::convertible_to<int>; // workers of one process
    b.check();                                   // throws BadInput
    b.for_each(tasks, run);                      // run(k) for k < tasks, each once
};
// clang-format on

} // namespace spate
