// SPDX-License-Identifier: BSD-3-Clause
#include "taylor_green.hpp"

namespace work_precision {
namespace {
const bool added = (add_vortices_with<QuinticSpline<2>>("quintic_spline", 1), true);
} // namespace
} // namespace work_precision
