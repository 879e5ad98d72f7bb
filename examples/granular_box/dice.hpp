// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Random numbers that are the same on every machine and in Python: what numpy.random.default_rng(seed) draws.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

namespace granular {

/// PCG64 (O'Neill 2014: 128-bit linear congruence, XSL-RR output), seeded by the hash of numpy's SeedSequence (O'Neill 2015).
class Dice {
public:
    explicit Dice(std::uint64_t seed)
    {
        const auto word = seeded(seed);
        const Wide start = Wide(word[0]) << 64 | word[1], stream = Wide(word[2]) << 64 | word[3];
        increment_ = stream << 1 | 1;
        step();
        state_ += start;
        step();
    }
    std::uint64_t bits()
    {
        step();
        const auto x = std::uint64_t(state_ >> 64) ^ std::uint64_t(state_);
        const auto turn = unsigned(state_ >> 122);
        return x >> turn | x << ((64 - turn) & 63);
    }
    /// In [low, high).
    double uniform(double low, double high) { return low + (high - low) * (double(bits() >> 11) * 0x1p-53); }
    /// The numbers 0 to n - 1 in random order (Fisher & Yates 1938).
    std::vector<std::uint32_t> permutation(std::uint32_t n)
    {
        std::vector<std::uint32_t> order(n);
        std::iota(order.begin(), order.end(), 0u);
        for (std::uint32_t i = n; i-- > 1;) std::swap(order[i], order[below_or(i)]);
        return order;
    }

private:
    __extension__ using Wide = unsigned __int128;

    void step() { state_ = state_ * (Wide(0x2360ED051FC65DA4u) << 64 | 0x4385DF649FCCF645u) + increment_; }
    /// Half of 64 bits at a time, the lower one first.
    std::uint32_t half()
    {
        if (kept_) {
            kept_ = false;
            return std::uint32_t(rest_ >> 32);
        }
        rest_ = bits();
        kept_ = true;
        return std::uint32_t(rest_);
    }
    /// 0 to `most`, each as likely: draws of as many bits as needed, those that are too large again.
    std::uint32_t below_or(std::uint32_t most)
    {
        std::uint32_t mask = most;
        for (int s = 1; s < 32; s *= 2) mask |= mask >> s;
        for (;;)
            if (const std::uint32_t draw = half() & mask; draw <= most) return draw;
    }
    static std::array<std::uint64_t, 4> seeded(std::uint64_t seed)
    {
        std::array<std::uint32_t, 4> pool{};
        std::uint32_t hash = 0x43b0d7e5u;
        auto mixed = [&](std::uint32_t x, std::uint32_t factor) {
            x ^= hash;
            hash *= factor;
            x *= hash;
            return x ^ x >> 16;
        };
        const std::array<std::uint32_t, 4> entropy{std::uint32_t(seed), std::uint32_t(seed >> 32), 0, 0};
        for (std::size_t i = 0; i < 4; ++i) pool[i] = mixed(entropy[i], 0x931e8875u);
        for (std::size_t from = 0; from < 4; ++from)
            for (std::size_t to = 0; to < 4; ++to) {
                if (from == to) continue;
                const std::uint32_t x = 0xca01f9ddu * pool[to] - 0x4973f715u * mixed(pool[from], 0x931e8875u);
                pool[to] = x ^ x >> 16;
            }
        std::array<std::uint64_t, 4> word{};
        hash = 0x8b51f9ddu;
        for (std::size_t i = 0; i < 8; ++i)
            word[i / 2] |= std::uint64_t(mixed(pool[i % 4], 0x58f38dedu)) << (32 * (i % 2));
        return word;
    }

    Wide state_ = 0, increment_ = 0;
    std::uint64_t rest_ = 0;
    bool kept_ = false;
};

} // namespace granular
