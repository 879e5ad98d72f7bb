// SPDX-License-Identifier: BSD-3-Clause
#include <spate/core/reduction.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <random>
#include <vector>

namespace {
using spate::ExactSum;
constexpr double ulp = std::numeric_limits<double>::epsilon();

double sum_of(std::vector<double> const& x)
{
    ExactSum s;
    for (double v : x) s.add(v);
    return s.value();
}
std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

/// Random bits: every exponent from a to b, both signs.
std::vector<double> random(std::mt19937_64& random_bits, std::size_t n, int a, int b)
{
    std::vector<double> x(n);
    for (auto& v : x) {
        const double m = 1 + double(random_bits() >> 12) * 0x1p-52;
        v = std::ldexp((random_bits() & 1) != 0 ? -m : m, a + int(random_bits() % std::uint64_t(b - a + 1)));
    }
    return x;
}

TEST(ExactSum, OfNothingIsZero) { EXPECT_EQ(bits(ExactSum{}.value()), bits(0.0)); }

TEST(ExactSum, OfOneNumberIsThatNumber)
{
    std::mt19937_64 r(1);
    using Limits = std::numeric_limits<double>;
    std::vector<double> x = random(r, 1000, -1022, 1023);
    for (double v : {0.0, 1.0, -1.0, Limits::max(), Limits::lowest(), Limits::min(), Limits::denorm_min(),
                     -Limits::denorm_min(), Limits::min() - Limits::denorm_min(), 0x1p-1074 * 12345})
        x.push_back(v);
    for (double v : x) EXPECT_EQ(sum_of({v}), v) << v;
}

TEST(ExactSum, DoesNotDependOnTheOrder)
{
    std::mt19937_64 r(2);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<double> x = random(r, 500, -300, 300);
        const double s = sum_of(x);
        std::shuffle(x.begin(), x.end(), r);
        EXPECT_EQ(bits(sum_of(x)), bits(s));
        std::sort(x.begin(), x.end());
        EXPECT_EQ(bits(sum_of(x)), bits(s));
    }
}

TEST(ExactSum, DoesNotDependOnHowItIsSplit)
{
    std::mt19937_64 r(3);
    const std::vector<double> x = random(r, 1000, -60, 60);
    for (std::size_t parts : {2u, 3u, 7u, 1000u}) {
        std::vector<ExactSum> part(parts);
        for (std::size_t k = 0; k < x.size(); ++k) part[(k * 31) % parts].add(x[k]);
        ExactSum all;
        for (std::size_t k = parts; k-- > 0;) all += part[k];
        EXPECT_EQ(bits(all.value()), bits(sum_of(x)));
    }
}

TEST(ExactSum, EqualsIntegerArithmetic)
{
    std::mt19937_64 r(4);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<double> x;
        __extension__ __int128 exact = 0; // in units of 2^-40
        for (int k = 0; k < 1000; ++k) {
            const auto m = std::int64_t(r() >> 11) - (std::int64_t(1) << 52);
            const int e = int(r() % 40);
            x.push_back(std::ldexp(double(m), e - 40));
            exact += static_cast<decltype(exact)>(m) << e;
        }
        const double expected = std::ldexp(double(exact), -40); // the compiler rounds once
        EXPECT_LE(std::abs(sum_of(x) - expected), 2 * ulp * std::abs(expected));
    }
}

TEST(ExactSum, EqualsALongDoubleWhereThatIsExact)
{
    std::mt19937_64 r(5);
    for (int trial = 0; trial < 200; ++trial) {
        long double exact = 0; // 64 bits hold 40 addends of 53 bits that differ by up to 4 in exponent
        const std::vector<double> x = random(r, 40, 0, 4);
        for (double v : x) exact += static_cast<long double>(v);
        EXPECT_LE(std::abs(sum_of(x) - double(exact)), 2 * ulp * std::abs(double(exact)));
    }
}

TEST(ExactSum, KeepsWhatCancellationLeaves)
{
    EXPECT_EQ(sum_of({1e300, 1, -1e300}), 1.0);
    EXPECT_EQ(sum_of({1e300, -1e-300, -1e300}), -1e-300);
    EXPECT_EQ(sum_of({0x1p-1074, 0x1p1023, -0x1p1023}), 0x1p-1074);
    EXPECT_EQ(sum_of({1, 1e100, 1, -1e100}), 2.0);
    std::mt19937_64 r(6);
    std::vector<double> x = random(r, 10000, -500, 500);
    const std::size_t n = x.size();
    for (std::size_t k = 0; k < n; ++k) x.push_back(-x[k]);
    x.push_back(0.1);
    std::shuffle(x.begin(), x.end(), r);
    EXPECT_EQ(sum_of(x), 0.1);
}

TEST(ExactSum, OfNegativesIsTheNegative)
{
    std::mt19937_64 r(7);
    for (int trial = 0; trial < 100; ++trial) {
        std::vector<double> x = random(r, 100, -80, 80);
        const double s = sum_of(x);
        for (double& v : x) v = -v;
        EXPECT_EQ(sum_of(x), -s);
    }
    EXPECT_EQ(sum_of({-1, -2, -3.5}), -6.5);
    EXPECT_EQ(sum_of({-0x1p-1074, -0x1p-1074}), -0x1p-1073);
}

TEST(ExactSum, BearsAMillionAddendsWithoutACarry)
{
    ExactSum s;
    const double all_ones = 2 - ulp; // each digit takes its largest addend
    for (int k = 0; k < 1 << 20; ++k) s.add(all_ones);
    EXPECT_EQ(s.value(), std::ldexp(all_ones, 20));
}

TEST(ExactSum, IsNotANumberIfAnAddendIsNotFinite)
{
    for (double bad :
         {std::nan(""), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
        EXPECT_TRUE(std::isnan(sum_of({1, bad, 2})));
        ExactSum a, b;
        a.add(1), b.add(bad), a += b;
        EXPECT_TRUE(std::isnan(a.value()));
    }
}

} // namespace
