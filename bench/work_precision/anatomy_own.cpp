// SPDX-License-Identifier: BSD-3-Clause
// Features that add a pass or change what positions follow; and the base in float.
#include "anatomy.hpp"

namespace work_precision {
namespace {
const bool added = [] {
    add_feature<Float>("base");
    add_feature<Double>("+TensileCorrection", TensileCorrection{});
    add_feature<Double>("+Xsph", Xsph{});
    add_feature<Double>("+Shifting", Shifting{.mach = 0.1});
    add_feature<Double>("+SurfaceShifting", SurfaceShifting{.mach = 0.1});
    return true;
}();
} // namespace
} // namespace work_precision
