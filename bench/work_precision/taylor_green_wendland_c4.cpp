// SPDX-License-Identifier: BSD-3-Clause
#include "taylor_green.hpp"

namespace work_precision {
namespace {
const bool added = [] {
    const std::string kernel = "wendland_c4";
    add_shifted<2, WendlandC4<2>, RungeKutta2, Double>(kernel, 2);
    add_shifted<2, WendlandC4<2>, Leapfrog, Double>(kernel, 2);
    add_shifted<2, WendlandC4<2>, SymplecticEuler, Double>(kernel, 2);
    return true;
}();
} // namespace
} // namespace work_precision
