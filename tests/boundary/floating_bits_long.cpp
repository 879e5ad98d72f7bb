// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/floating_bits.hpp"

namespace {

using namespace floating_bits;

TEST(LongFloatingBits, DependOnNobody) { expect_bits(Leapfrog{}, Double{}); }

} // namespace
