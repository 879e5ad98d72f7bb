// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Round numbers along an axis and how they are written: steps of 1, 2 or 5, a power of ten pulled out of
///        very large and very small ones. Draws nothing.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace spate::io::detail {

struct Ticks {
    int exponent = 0; ///< a label times 10^exponent is the value
    std::vector<double> values;
    std::vector<std::string> labels;
};

/// The smallest of 1, 2, 5 x 10^n that is not below `rough`.
inline double round_step(double rough)
{
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= rough * (1 - 1e-9)) return factor * power;
    return 10 * power;
}

/// With the decimal point in any locale.
inline std::string fixed(double value, int decimals)
{
    std::array<char, 64> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
    return {text.data(), end.ptr};
}

/// About `count` ticks from low to high; low < high.
inline Ticks ticks(double low, double high, double count)
{
    Ticks out;
    const double step = round_step((high - low) / std::max(count, 1.0));
    const double largest = std::max(std::abs(low), std::abs(high));
    if (largest >= 1e5 || largest < 1e-2) out.exponent = 3 * static_cast<int>(std::floor(std::log10(largest) / 3));
    const double unit = std::pow(10.0, out.exponent);
    const int decimals = std::clamp(-static_cast<int>(std::floor(std::log10(step / unit) + 1e-9)), 0, 9);
    const double last = std::floor(high / step + 1e-6);
    for (double k = std::ceil(low / step - 1e-6); k <= last; ++k) {
        out.values.push_back(k * step);
        out.labels.push_back(fixed(k == 0 ? 0.0 : k * step / unit, decimals));
    }
    return out;
}

/// The most ticks whose labels stay apart on `pixels`; `room(ticks)` is what one label needs.
template <class Room>
Ticks ticks_that_fit(double low, double high, double pixels, Room room)
{
    for (int count = 10; count > 1; --count) {
        Ticks out = ticks(low, high, count);
        if (out.values.size() < 2) break;
        if ((out.values[1] - out.values[0]) / (high - low) * pixels >= room(out)) return out;
    }
    return ticks(low, high, 1);
}

inline std::size_t longest_label(Ticks const& ticks)
{
    std::size_t longest = 1;
    for (std::string const& label : ticks.labels) longest = std::max(longest, label.size());
    return longest;
}

/// "pressure [10^3 Pa]"
inline std::string with_unit(std::string const& name, std::string const& unit, int exponent)
{
    std::string inside = exponent == 0 ? "" : "10^" + std::to_string(exponent);
    if (!inside.empty() && !unit.empty()) inside += " ";
    inside += unit;
    return inside.empty() ? name : name + (name.empty() ? "[" : " [") + inside + "]";
}

} // namespace spate::io::detail
