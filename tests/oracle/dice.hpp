// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Random numbers that are the same with every standard library.
#pragma once

#include <array>
#include <cstdint>
#include <random>

namespace spate::oracle {

class Dice {
public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double real(double a, double b) { return a + (b - a) * double(engine_() >> 11) * 0x1p-53; }
    int integer(int a, int b) { return a + int(engine_() % std::uint64_t(b - a + 1)); }
    bool chance(double p) { return real(0, 1) < p; }
    template <class T, std::size_t N>
    T of(std::array<T, N> const& a)
    {
        return a[std::size_t(integer(0, int(N) - 1))];
    }

private:
    std::mt19937_64 engine_;
};

} // namespace spate::oracle
