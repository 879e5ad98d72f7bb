// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What an integrator is: it advances every evolving field by its rate, and says what it costs and bears.
#pragma once

#include <concepts>

namespace spate {

// clang-format off
template <class I>
concept Integrator = requires(double z) {
    { I::name } -> std::convertible_to<const char*>;
    { I::order } -> std::convertible_to<int>;              // of the global error, without contact switching
    { I::evaluations } -> std::convertible_to<int>;        // of the rates, a step
    { I::saves } -> std::convertible_to<bool>;             // needs the start of the step
    { I::ahead_velocity } -> std::convertible_to<double>;     // rates are taken at positions up to
    { I::ahead_acceleration } -> std::convertible_to<double>; // x + ahead_velocity v dt + ahead_acceleration a dt^2
    { I::imaginary_limit } -> std::convertible_to<double>; // largest omega dt without growth; 0: none
    { I::real_limit } -> std::convertible_to<double>;      // largest rate * dt of a decay
    { I::growth(z) } -> std::convertible_to<double>;       // amplitude growth a step at omega dt = z
};
// clang-format on

} // namespace spate
