// SPDX-License-Identifier: BSD-3-Clause
#include "extreme/linear.hpp"

namespace {

using namespace linear;

TEST(Linear1d, SoundGrowsAndIsBoundedAsTheoryHasIt)
{
    all_rows<1>([](double h) { return sound<1>(h); });
}
TEST(Linear1d, ViscosityIsBoundedAsTheoryHasIt)
{
    all_rows<1>([](double h) { return linear::viscosity<1>(h); });
}
TEST(Linear2d, SoundGrowsAndIsBoundedAsTheoryHasIt)
{
    all_rows<2>([](double h) { return sound<2>(h); }, true);
}
TEST(Linear2d, ViscosityIsBoundedAsTheoryHasIt)
{
    all_rows<2>([](double h) { return linear::viscosity<2>(h); }, true);
}

// In float a wave is followed over one and a half decades; 1e-3 of it is 1e4 roundings of the density.
TEST(LinearFloat, SoundGrowsAsTheoryHasIt)
{
    constexpr double h = 1.3;
    kernel = 0;
    const Mode mode = stiffest_sound<2>(h);
    for (integrator = forward_euler; integrator <= runge_kutta2; ++integrator)
        for (int threads : {1, 2}) {
            const double z = AnyIntegrator::limit() > 0 ? 2.1 : 0.9, exact = theory(z);
            const double measured = growth<2, Float>(h, mode, 1, 0, z / mode.symbol, 4, 8, 2e-5, threads);
            EXPECT_NEAR(measured, exact, 0.05 * exact) << integrators[integrator];
            EXPECT_EQ(measured, (growth<2, Float>(h, mode, 1, 0, z / mode.symbol, 4, 8, 2e-5, 3 - threads)));
        }
}
TEST(Linear2d, BelowTheLimitAmplitudesStayBounded) { expect_bounded(2000, 1); }

} // namespace
