// SPDX-License-Identifier: BSD-3-Clause
#include "taylor_green.hpp"

namespace work_precision {
namespace {
const bool added = (add_vortices_with<WendlandC4<2>>("wendland_c4", 2), true);
} // namespace
} // namespace work_precision
