// expect: spate: wcsph needs exactly one equation of state
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

auto water = wcsph(CubicSpline<2>{.h = 0.012}, Continuity<2>{}, PressureForce<2>{});
