// SPDX-License-Identifier: BSD-3-Clause
// Bodies that float keep their bits: with a scheme that saves, in float.
// Leapfrog in double: floating_bits_long.cpp, and on threads and ranks tests/extreme/bodies.cpp.
#include "boundary/floating_bits.hpp"

namespace {

using namespace floating_bits;

TEST(FloatingBits, DependOnNobody) { expect_bits(RungeKutta2{}, Float{}); }
// The hash knows of the bodies, and a state without them is refused.
TEST(FloatingBits, AreInTheState)
{
    End half = run(RungeKutta2{}, Float{}, Threads{1}, 40);
    const auto hash = run(RungeKutta2{}, Float{}, Threads{1}, 0, &half.state).hash;
    EXPECT_EQ(hash, half.hash);
    io::State other = half.state;
    bool found = false;
    for (auto& [name, table] : other.tables)
        if (name.find("body 1 angular momentum") != std::string::npos)
            if (auto* value = std::get_if<std::vector<double>>(&table.values)) value->front() *= 2, found = true;
    EXPECT_TRUE(found);
    EXPECT_NE(run(RungeKutta2{}, Float{}, Threads{1}, 0, &other).hash, hash);
    std::erase_if(other.tables, [](auto const& t) { return t.first.find("body 1") != std::string::npos; });
    EXPECT_THROW(run(RungeKutta2{}, Float{}, Threads{1}, 0, &other), BadInput);
}

} // namespace
