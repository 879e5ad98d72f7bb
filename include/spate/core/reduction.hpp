// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Sums that do not depend on the order of their addends: needed wherever a sum can change or stop a run.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace spate {

/// The exact sum of doubles, in integers (after Neal 2015, "Fast exact summation using small and large superaccumulators"):
/// 32-bit digits with carries kept in 64, so that 2^30 addends need no carry. Not finite addends are counted apart.
class ExactSum {
public:
    void add(double x)
    {
        const auto bits = std::bit_cast<std::uint64_t>(x);
        const int exponent = int((bits >> 52) & 0x7ff);
        if (exponent == 0x7ff) {
            ++not_finite_;
            return;
        }
        std::uint64_t mantissa = bits & ((std::uint64_t(1) << 52) - 1);
        if (exponent > 0) mantissa |= std::uint64_t(1) << 52;
        const int shift = exponent > 0 ? exponent - 1 : 0; // in units of 2^-1074
        const int digit = shift / 32, within = shift % 32;
        const std::uint64_t low = mantissa << within, high = within == 0 ? 0 : mantissa >> (64 - within);
        const std::int64_t sign = (bits >> 63) != 0 ? -1 : 1;
        const auto k = std::size_t(digit);
        digit_[k] += sign * std::int64_t(low & 0xffffffffu);
        digit_[k + 1] += sign * std::int64_t(low >> 32);
        digit_[k + 2] += sign * std::int64_t(high);
    }
    ExactSum& operator+=(ExactSum const& b)
    {
        for (std::size_t k = 0; k < digit_.size(); ++k) digit_[k] += b.digit_[k];
        not_finite_ += b.not_finite_;
        return *this;
    }
    /// The sum to a few units in the last place, the same for every order of adding; NaN if an addend was not finite.
    [[nodiscard]] double value() const
    {
        if (not_finite_ > 0) return std::nan("");
        auto d = digit_;
        carry(d);
        const bool negative = d.back() < 0;
        if (negative) { // digits of one sign: no cancellation below
            for (std::size_t k = 0; k < d.size(); ++k) d[k] = -digit_[k];
            carry(d);
        }
        double sum = 0;
        for (std::size_t k = d.size(); k-- > 0;) sum += std::ldexp(double(d[k]), int(32 * k) - 1074);
        return negative ? -sum : sum;
    }

private:
    using Digits = std::array<std::int64_t, 68>;
    static void carry(Digits& d)
    {
        for (std::size_t k = 0; k + 1 < d.size(); ++k) {
            const std::int64_t c = d[k] >> 32;
            d[k] -= c * (std::int64_t(1) << 32);
            d[k + 1] += c;
        }
    }
    Digits digit_{};
    std::int64_t not_finite_ = 0;
};

} // namespace spate
