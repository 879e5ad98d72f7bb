// expect: spate: a term is called with one particle
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

struct Nothing {
    double k;
};
auto water =
    wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, PressureForce<2>{}, Nothing{1});
