// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Threads that wait for work spin for a tenth of a millisecond at most, then sleep: to sleep at once costs two threads a
/// tenth of their speed, to go on spinning costs a hundred times more on a busy core.
#pragma once

namespace example {

/// OpenMP reads OMP_WAIT_POLICY and GOMP_SPINCOUNT when the program is loaded: unless the first is set, sets both and starts
/// again.
void wait_passively(char** argv);

} // namespace example
