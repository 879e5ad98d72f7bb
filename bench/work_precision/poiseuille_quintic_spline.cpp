// SPDX-License-Identifier: BSD-3-Clause
#include "poiseuille.hpp"

namespace work_precision {
namespace {
const bool added = (add_channels<QuinticSpline<2>>("quintic_spline", 1), true);
} // namespace
} // namespace work_precision
