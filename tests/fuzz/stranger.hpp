// SPDX-License-Identifier: BSD-3-Clause
// What a stranger's checkpoint may hold, made from bytes: by libFuzzer (checkpoint.cpp), or by numbers that are always the same
// (tests/io/checkpoint_file.cpp). The first byte says how: 0 the rest is the file; 1 the rest are edits of a good file; 2
// edits of what a good file holds, under a checksum that is right.
#pragma once

#include "spate/io/checkpoint.hpp"
#include "spate/spate.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace fuzz {

using namespace spate;

inline auto little_tank()
{
    constexpr double dx = 0.1;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 30}, Continuity<2>{}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -9.81}});
    Simulation tank(water, RungeKutta2{}, Bce(Box<2>{{0, 0}, {1, 1}}, dx, Adami{}, open(top)), Serial{});
    tank.fill(Box<2>{{0, 0}, {0.5, 0.5}}, dx, hydrostatic);
    tank.run({.steps = 30});
    return tank;
}

inline void insist(bool holds, char const* what)
{
    if (holds) return;
    std::fprintf(stderr, "broken: %s\n", what);
    std::abort();
}

/// Reads numbers from the fuzzer's bytes; zeros when they are used up.
class Numbers {
public:
    explicit Numbers(std::span<std::uint8_t const> bytes) : bytes_(bytes) {}
    [[nodiscard]] bool more() const { return !bytes_.empty(); }
    template <class T>
    T next()
    {
        T value{};
        const std::size_t n = std::min(sizeof(T), bytes_.size());
        std::memcpy(&value, bytes_.data(), n);
        bytes_ = bytes_.subspan(n);
        return value;
    }

private:
    std::span<std::uint8_t const> bytes_;
};

inline void expect_refused(std::span<std::byte const> bytes)
{
    try {
        (void)io::checkpoint_in(bytes, "fuzz.h5");
        insist(false, "a wrong file was taken");
    }
    catch (BadInput const&) {
    }
}

inline void edit(io::State& state, Numbers& n)
{
    auto at = state.tables.begin();
    std::advance(at, n.next<std::uint16_t>() % state.tables.size());
    const auto what = n.next<std::uint8_t>();
    if (what == 255) {
        state.tables.erase(at);
        return;
    }
    std::visit(
        [&]<class T>(std::vector<T>& v) {
            const std::size_t k = v.empty() ? 0 : n.next<std::uint16_t>() % v.size();
            if (what < 160 && !v.empty()) v[k] = n.next<T>();
            else if (what < 180 && !v.empty()) std::swap(v[k], v[n.next<std::uint16_t>() % v.size()]);
            else if (what < 200) v.resize(n.next<std::uint16_t>() % 500);
            else if (what < 220) v.push_back(n.next<T>());
            else if (!v.empty()) v.erase(v.begin() + std::ptrdiff_t(k));
        },
        at->second.values);
    if (what >= 240) at->second.columns = 1 + n.next<std::uint8_t>() % 4;
}

/// Ends the program if a wrong file is taken, or a refusal changes the scene.
inline void stranger(std::span<std::uint8_t const> bytes)
{
    auto const* const data = bytes.data();
    const std::size_t size = bytes.size();
    static auto tank = little_tank();
    static const io::State good = io::state_of(tank);
    static const auto file = [] {
        const auto path = std::filesystem::temp_directory_path() / ("spate_fuzz_" + std::to_string(::getpid()) + ".h5");
        io::write_checkpoint(path, good);
        std::vector<std::byte> content(std::filesystem::file_size(path));
        std::ifstream(path, std::ios::binary)
            .read(reinterpret_cast<char*>(content.data()), std::streamsize(content.size()));
        std::filesystem::remove(path);
        return content;
    }();
    if (size == 0) return;
    Numbers n({data + 1, size - 1});
    if (data[0] % 3 == 0) expect_refused(std::as_bytes(std::span(data + 1, size - 1)));
    else if (data[0] % 3 == 1) {
        auto some = file;
        const auto length = n.next<std::uint32_t>();
        if (length % 4 == 0) some.resize(length % some.size());
        while (n.more() && !some.empty()) some[n.next<std::uint32_t>() % some.size()] ^= n.next<std::byte>();
        if (some == file) return;
        expect_refused(some);
    }
    else {
        io::State state = good;
        while (n.more() && !state.tables.empty()) edit(state, n);
        try {
            io::resume(tank, state);
        }
        catch (BadInput const&) {
            insist(io::state_of(tank).tables == good.tables, "a refusal changed the scene");
            return;
        }
        try {
            tank.run({.steps = 2});
        }
        catch (Stop const&) { // such as a velocity that nobody has
        }
        io::resume(tank, good);
    }
}

} // namespace fuzz
