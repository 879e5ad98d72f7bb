// SPDX-License-Identifier: BSD-3-Clause
#include "dam_break.hpp"

namespace work_precision {
namespace {
const bool added = [] {
    const Adami wall{.suction = false};
    add_dam<2, WendlandC2<2>, RungeKutta2, Double>("wendland_c2", 2, wall);
    add_dam<2, QuinticSpline<2>, RungeKutta2, Double>("quintic_spline", 1, wall);
    add_dam<1, CubicSpline<2>, RungeKutta2, Double>("cubic_spline", 1.2, wall);
    return true;
}();
} // namespace
} // namespace work_precision
