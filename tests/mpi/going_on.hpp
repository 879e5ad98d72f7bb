// SPDX-License-Identifier: BSD-3-Clause
// Scenes that are cut in two by a checkpoint, on one process and on many: compiled once for the folder, in going_on.cpp.
#pragma once

#include "io/scenes_that_go_on.hpp"
#include "spate/backend/mpi.hpp"

namespace going_on {

/// So many threads on each; one of them works like Serial.
using Processes = Mpi<Threads>;
using Keep = std::function<void(io::AnyScene&)>;

extern template End run<Column>(Serial, std::int64_t, io::State const*, Keep const&);
extern template End run<Hopper>(Serial, std::int64_t, io::State const*, Keep const&);
extern template End run<Column>(Processes, std::int64_t, io::State const*, Keep const&);
extern template End run<Hopper>(Processes, std::int64_t, io::State const*, Keep const&);

} // namespace going_on
