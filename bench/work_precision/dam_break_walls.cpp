// SPDX-License-Identifier: BSD-3-Clause
#include "dam_break.hpp"

namespace work_precision {
namespace {
const bool added = [] {
    const std::string kernel = "cubic_spline";
    add_dam<2, CubicSpline<2>, RungeKutta2, Double>(kernel, 1.2, Adami{.suction = false});
    add_dam<2, CubicSpline<2>, RungeKutta2, Double>(kernel, 1.2, Extrapolated{.suction = false});
    add_dam<2, CubicSpline<2>, RungeKutta2, Double>(kernel, 1.2, ByContinuity{});
    return true;
}();
} // namespace
} // namespace work_precision
