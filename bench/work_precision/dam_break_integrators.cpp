// SPDX-License-Identifier: BSD-3-Clause
#include "dam_break.hpp"

namespace work_precision {
namespace {
const bool added = [] {
    const std::string kernel = "cubic_spline";
    const Adami wall{.suction = false};
    add_dam<2, CubicSpline<2>, SymplecticEuler, Double>(kernel, 1.2, wall);
    add_dam<2, CubicSpline<2>, Leapfrog, Double>(kernel, 1.2, wall);
    add_dam<2, CubicSpline<2>, RungeKutta2, Float>(kernel, 1.2, wall);
    return true;
}();
} // namespace
} // namespace work_precision
