// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief SIGINT and SIGTERM as a question that the step loop asks; a second one ends the program at once.
#pragma once

namespace example {

/// From now on the first SIGINT or SIGTERM is kept.
void catch_interrupts();
/// The signal that came, or 0.
int interrupt();

} // namespace example
