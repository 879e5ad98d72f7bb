// SPDX-License-Identifier: BSD-3-Clause
#include "support/interrupt.hpp"

#include <csignal>

namespace example {

namespace {
volatile std::sig_atomic_t signal_that_came = 0;

extern "C" void keep(int signal)
{
    signal_that_came = signal;
    std::signal(signal, SIG_DFL);
}
} // namespace

void catch_interrupts()
{
    std::signal(SIGINT, keep);
    std::signal(SIGTERM, keep);
    std::signal(SIGUSR1, keep);
}
int interrupt() { return signal_that_came; }

} // namespace example
