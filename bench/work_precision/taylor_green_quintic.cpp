// SPDX-License-Identifier: BSD-3-Clause
#include "taylor_green.hpp"

namespace work_precision {
namespace {
const bool added = [] {
    const std::string kernel = "quintic_spline";
    add_shifted<2, QuinticSpline<2>, RungeKutta2, Double>(kernel, 1);
    add_shifted<2, QuinticSpline<2>, Leapfrog, Double>(kernel, 1);
    add_shifted<2, QuinticSpline<2>, SymplecticEuler, Double>(kernel, 1);
    return true;
}();
} // namespace
} // namespace work_precision
