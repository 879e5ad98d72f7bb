// SPDX-License-Identifier: BSD-3-Clause
#include "support/passive.hpp"

#include <cstdlib>

#include <unistd.h>

namespace example {

void wait_passively(char** argv)
{
    if (std::getenv("OMP_WAIT_POLICY") != nullptr || setenv("OMP_WAIT_POLICY", "passive", 0) != 0) return;
    setenv("GOMP_SPINCOUNT", "10000", 0); // a tenth of a millisecond: what a barrier of two even threads takes
    execv("/proc/self/exe", argv);        // returns only if it could not: then this process goes on, spinning
}

} // namespace example
