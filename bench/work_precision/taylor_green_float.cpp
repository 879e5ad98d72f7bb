// SPDX-License-Identifier: BSD-3-Clause
// In float: numerics D.4.
#include "taylor_green.hpp"

namespace work_precision {
namespace {
const bool added = [] {
    add_shifted<2, QuinticSpline<2>, SymplecticEuler, Float>("quintic_spline", 1);
    add_shifted<2, WendlandC4<2>, SymplecticEuler, Float>("wendland_c4", 2);
    add_shifted<2, WendlandC2<2>, SymplecticEuler, Float>("wendland_c2", 2);
    return true;
}();
} // namespace
} // namespace work_precision
