// expect: spate: wcsph takes a kernel first
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

struct Hat { // lacks g, the gradient
    static constexpr int dim = 2;
    static constexpr double radius = 1;
    double h;
    double sigma() const { return 3 / (3.14159265358979323846 * h * h); }
    static auto f(auto q) { return max(1 - q, 0); }
};
auto water = wcsph(Hat{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, PressureForce<2>{});
