// SPDX-License-Identifier: BSD-3-Clause
#include "taylor_green.hpp"

namespace work_precision {
namespace {
const bool added = [] {
    const std::string kernel = "cubic_spline";
    add_shifted<2, CubicSpline<2>, RungeKutta2, Double>(kernel, 1.3);
    add_shifted<2, CubicSpline<2>, Leapfrog, Double>(kernel, 1.3);
    add_shifted<2, CubicSpline<2>, SymplecticEuler, Double>(kernel, 1.3);
    return true;
}();
} // namespace
} // namespace work_precision
