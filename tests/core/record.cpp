// SPDX-License-Identifier: BSD-3-Clause
#include <spate/core/array.hpp>
#include <spate/core/record.hpp>

#include <gtest/gtest.h>

namespace {
using namespace spate;

using Flow = Layout<3, Fields<Position, Velocity, Density, Pressure>>;
static_assert(Flow::count == 8 && Flow::stride == 8);
static_assert(Flow::offset<Position> == 0 && Flow::offset<Velocity> == 3 && Flow::offset<Density> == 6 &&
              Flow::offset<Pressure> == 7 && Flow::offset<Mass> == -1);
// A record is a multiple of 4 values, or at most 2: it never straddles more cache lines than it must. One of more than 8 has
// several lines anyway, and is only even.
static_assert(Layout<3, Fields<>>::stride == 1);
static_assert(Layout<1, Fields<Position>>::stride == 1);
static_assert(Layout<2, Fields<Position>>::stride == 2);
static_assert(Layout<3, Fields<Position>>::stride == 4);
static_assert(Layout<2, Fields<Position, Velocity>>::stride == 4);
static_assert(Layout<3, Fields<Position, Velocity, Density, Pressure, Mass>>::stride == 10);
static_assert(Layout<3, Fields<Position, Velocity, Acceleration, Density, Pressure>>::stride == 12);

// A record is its values: nothing for a name, nothing for a base.
static_assert(sizeof(Record<3, double, Fields<Position, Density>>) == 4 * sizeof(double));
static_assert(sizeof(Record<2, float, Fields<Position, Velocity>>) == 4 * sizeof(float));

template <class V>
class RecordOf : public ::testing::Test {};
using Values = ::testing::Types<double, Scalar<float>, Pack<double>, Pack<float>>;
TYPED_TEST_SUITE(RecordOf, Values);

TYPED_TEST(RecordOf, IsGatheredFieldByField)
{
    using V = TypeParam;
    using T = scalar_t<V>;
    using L = Layout<2, Fields<Density, Position, Mass, Velocity>>;
    constexpr auto w = std::size_t(width<V>);
    static_assert(L::count == 6 && L::stride == 8);
    Array<T> packed(std::size_t(40 * L::stride));
    for (std::size_t k = 0; k < packed.size(); ++k) packed[k] = T(k);
    std::int32_t at[w];
    for (std::size_t k = 0; k < w; ++k) at[k] = std::int32_t((7 * k + 3) % 40) * L::stride;
    const auto r = gathered<V>(packed.data(), at, L{});
    auto expect = [&](V const& v, int offset) {
        alignas(64) T lane[w];
        store(lane, v);
        for (std::size_t k = 0; k < w; ++k) EXPECT_EQ(lane[k], T(at[k] + offset));
    };
    expect(r[density], 0);
    expect(r[position][0], 1);
    expect(r[position][1], 2);
    expect(r[mass], 3);
    expect(r[velocity][0], 4);
    expect(r[velocity][1], 5);
}

TYPED_TEST(RecordOf, IsCleared)
{
    using V = TypeParam;
    Record<3, V, Fields<Acceleration, DensityRate>> r;
    r[density_rate] = V(1);
    for (int c = 0; c < 3; ++c) r[acceleration][c] = V(2);
    clear(r);
    EXPECT_EQ(largest(V(spate::abs(r[density_rate]))), 0);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(largest(V(spate::abs(r[acceleration][c]))), 0);
}

TEST(Record, KnowsItsFields)
{
    using R = Record<2, double, Fields<Position, Mass>>;
    EXPECT_TRUE(R::has<Mass>);
    EXPECT_FALSE(R::has<Density>);
    EXPECT_EQ(to_string(R::fields), "position mass");
}

} // namespace
