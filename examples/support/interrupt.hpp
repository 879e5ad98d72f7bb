// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief SIGINT, SIGTERM and SIGUSR1 (which batch systems send before the time limit) as a question that the step loop
///        asks; a second one ends the program at once.
#pragma once

namespace example {

/// From now on the first of these signals is kept.
void catch_interrupts();
/// The signal that came, or 0.
int interrupt();

} // namespace example
