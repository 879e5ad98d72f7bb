// SPDX-License-Identifier: BSD-3-Clause
#include <spate/core/vec.hpp>

#include <gtest/gtest.h>

namespace {
using namespace spate;

template <class V>
class VecOf : public ::testing::Test {};
using Values = ::testing::Types<double, Scalar<float>, Pack<double>, Pack<float>>;
TYPED_TEST_SUITE(VecOf, Values);

template <class V>
double first(V const& v)
{
    alignas(64) scalar_t<V> lane[std::size_t(width<V>)];
    store(lane, v);
    for (int k = 1; k < width<V>; ++k) EXPECT_EQ(lane[k], lane[0]);
    return double(lane[0]);
}

TYPED_TEST(VecOf, HasTheArithmeticOfAVectorSpace)
{
    using V = TypeParam;
    const Vec<3, V> a{{V(1), V(-2), V(4)}}, b{{V(0.5), V(8), V(-1)}};
    const auto s = a + b, d = a - b, m = -a, t = V(2) * a, u = a * V(2);
    const double sum[] = {1.5, 6, 3}, difference[] = {0.5, -10, 5}, of_a[] = {1, -2, 4};
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(first(s[c]), sum[c]);
        EXPECT_EQ(first(d[c]), difference[c]);
        EXPECT_EQ(first(m[c]), -of_a[c]);
        EXPECT_EQ(first(t[c]), 2 * of_a[c]);
        EXPECT_EQ(first(u[c]), 2 * of_a[c]);
    }
    EXPECT_EQ(first(a.dot(b)), 0.5 - 16 - 4);
    EXPECT_EQ(first(a.squaredNorm()), 21);
    EXPECT_EQ(first((Vec<1, V>{{V(3)}}).dot(Vec<1, V>{{V(-2)}})), -6);
    EXPECT_EQ(first((Vec<2, V>{{V(3), V(4)}}).squaredNorm()), 25);
    Vec<3, V> x = a;
    x += b;
    x -= a;
    for (int c = 0; c < 3; ++c) EXPECT_EQ(first(x[c]), first(b[c]));
}

TYPED_TEST(VecOf, TakesAConstantVectorInAllLanes)
{
    using V = TypeParam;
    const Vec<2, int> g{{3, -4}};
    Vec<2, V> x{{V(1), V(1)}};
    x += g;
    EXPECT_EQ(first(x[0]), 4);
    EXPECT_EQ(first(x[1]), -3);
    const Vec<2, V> y = broadcast<V>(Vec<2, double>{{0.25, -8}});
    EXPECT_EQ(first(y[0]), 0.25);
    EXPECT_EQ(first(y[1]), -8);
}

TYPED_TEST(VecOf, IsChosenLaneByLane)
{
    using V = TypeParam;
    const Vec<2, V> a{{V(1), V(2)}}, b{{V(3), V(4)}};
    const auto yes = where(V(0) < V(1), a, b), no = where(V(1) < V(0), a, b);
    for (int c = 0; c < 2; ++c) {
        EXPECT_EQ(first(yes[c]), first(a[c]));
        EXPECT_EQ(first(no[c]), first(b[c]));
    }
}

} // namespace
