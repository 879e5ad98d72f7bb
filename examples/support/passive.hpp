// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Threads that wait for work sleep instead of spinning: on a busy core spinning costs a hundred times more.
#pragma once

namespace example {

/// OpenMP reads OMP_WAIT_POLICY when the program is loaded: unless it is set, sets it to passive and starts again.
void wait_passively(char** argv);

} // namespace example
