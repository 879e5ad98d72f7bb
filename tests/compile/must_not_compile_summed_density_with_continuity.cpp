// expect: spate: density is summed or follows continuity
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

void scene()
{
    (void)wcsph(CubicSpline<3>{}, Tait{.rho0 = 1000, .c0 = 20}, SummationDensity{}, Continuity<2>{},
                PressureForce<2>{});
}
