// SPDX-License-Identifier: BSD-3-Clause
// Checkpoints from the hand of a stranger, for libFuzzer; bash tests/fuzz/run.sh builds and runs it.
#include "stranger.hpp"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size)
{
    fuzz::stranger({data, size});
    return 0;
}
