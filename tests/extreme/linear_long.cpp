// SPDX-License-Identifier: BSD-3-Clause
#include "extreme/linear.hpp"

namespace {

using namespace linear;

TEST(LongLinear2d, SoundGrowsAndIsBoundedAsTheoryHasIt)
{
    all_rows<2>([](double h) { return sound<2>(h); });
}
TEST(LongLinear2d, ViscosityIsBoundedAsTheoryHasIt)
{
    all_rows<2>([](double h) { return linear::viscosity<2>(h); });
}
TEST(LongLinear3d, SoundGrowsAndIsBoundedAsTheoryHasIt)
{
    all_rows<3>([](double h) { return sound<3>(h); });
}
TEST(LongLinear3d, ViscosityIsBoundedAsTheoryHasIt)
{
    all_rows<3>([](double h) { return linear::viscosity<3>(h); });
}
TEST(LongLinear2d, BelowTheLimitAmplitudesStayBoundedFor1e5Steps) { expect_bounded(100000, 2); }

} // namespace
