// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A parameter that the model fills in from another term unless the user gives it.
#pragma once

#include <limits>

namespace spate {

/// "As the rest of the model says": a speed of sound or a reference density comes from the equation of state.
inline constexpr double from_model = std::numeric_limits<double>::quiet_NaN();

} // namespace spate
