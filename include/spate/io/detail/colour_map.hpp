// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A number from 0 to 1 as a colour: viridis (van der Walt and Smith 2015), even to the eye and in grey print.
///        Not a choice of maps.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace spate::io::detail {

struct Rgb {
    std::uint8_t r, g, b;
    bool operator==(Rgb const&) const = default;
};

/// a at f = 0, b at f = 1.
inline Rgb mix(Rgb a, Rgb b, double f)
{
    const auto channel = [f](double from, double to) {
        return static_cast<std::uint8_t>(std::lround(from + f * (to - from)));
    };
    return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

/// Every sixteenth colour of the table of 256, joined by straight lines.
inline Rgb viridis(double fraction)
{
    constexpr std::array<Rgb, 17> knots{{{68, 1, 84},
                                         {72, 24, 106},
                                         {71, 45, 123},
                                         {66, 64, 134},
                                         {59, 82, 139},
                                         {51, 99, 141},
                                         {44, 114, 142},
                                         {38, 130, 142},
                                         {33, 145, 140},
                                         {31, 160, 136},
                                         {40, 174, 128},
                                         {63, 188, 115},
                                         {94, 201, 98},
                                         {132, 212, 75},
                                         {173, 220, 48},
                                         {216, 226, 25},
                                         {253, 231, 37}}};
    const double place = std::clamp(fraction, 0.0, 1.0) * (knots.size() - 1);
    const std::size_t k = std::min(static_cast<std::size_t>(place), knots.size() - 2);
    return mix(knots[k], knots[k + 1], place - static_cast<double>(k));
}

} // namespace spate::io::detail
