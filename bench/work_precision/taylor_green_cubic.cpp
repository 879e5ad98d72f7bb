// SPDX-License-Identifier: BSD-3-Clause
#include "taylor_green.hpp"

namespace work_precision {
namespace {
const bool added = (add_vortices_with<CubicSpline<2>>("cubic_spline", 1.3), true);
} // namespace
} // namespace work_precision
