// expect: spate: wcsph needs exactly one equation of state
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

auto water = wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, LinearEos{.rho0 = 1000, .c0 = 10},
                   Continuity<2>{}, PressureForce<2>{});
