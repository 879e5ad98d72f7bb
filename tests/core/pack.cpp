// SPDX-License-Identifier: BSD-3-Clause
#include <spate/core/array.hpp>
#include <spate/core/pack.hpp>

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace {
using namespace spate;

template <class V>
class PackOf : public ::testing::Test {
public:
    using T = scalar_t<V>;
    static constexpr auto w = std::size_t(width<V>);
    struct Lane {
        alignas(64) T x[w];
        T const& operator[](std::size_t k) const { return x[k]; }
    };
    static Lane lanes(V const& v)
    {
        Lane l;
        store(l.x, v);
        return l;
    }
    Lane draw(double a, double b)
    {
        Lane l;
        for (auto& x : l.x) x = T(a + (b - a) * double(random_() >> 11) * 0x1p-53);
        return l;
    }

protected:
    std::mt19937_64 random_{5};
};
using Values = ::testing::Types<double, Scalar<float>, Pack<double>, Pack<float>>;
TYPED_TEST_SUITE(PackOf, Values);

TYPED_TEST(PackOf, ComputesEachLaneAsAScalar)
{
    using V = TypeParam;
    using T = scalar_t<V>;
    for (int trial = 0; trial < 200; ++trial) {
        const auto a = this->draw(-9, 9), b = this->draw(0.1, 9);
        const V x = load<V>(a.x), y = load<V>(b.x);
        const auto sum = this->lanes(V(x + y)), difference = this->lanes(V(x - y)), product = this->lanes(V(x * y)),
                   quotient = this->lanes(V(x / y)), negative = this->lanes(V(-x)),
                   root = this->lanes(V(spate::sqrt(y))), less = this->lanes(V(spate::min(x, y))),
                   more = this->lanes(V(spate::max(x, y))), size = this->lanes(V(spate::abs(x))),
                   chosen = this->lanes(V(spate::where(x < y, x, y))), third = this->lanes(V(2 * x + 0.5));
        for (std::size_t k = 0; k < this->w; ++k) {
            EXPECT_EQ(sum[k], T(a[k] + b[k]));
            EXPECT_EQ(difference[k], T(a[k] - b[k]));
            EXPECT_EQ(product[k], T(a[k] * b[k]));
            EXPECT_EQ(quotient[k], T(a[k] / b[k]));
            EXPECT_EQ(negative[k], -a[k]);
            EXPECT_EQ(root[k], std::sqrt(b[k]));
            EXPECT_EQ(less[k], std::min(a[k], b[k]));
            EXPECT_EQ(more[k], std::max(a[k], b[k]));
            EXPECT_EQ(size[k], std::abs(a[k]));
            EXPECT_EQ(chosen[k], a[k] < b[k] ? a[k] : b[k]);
            EXPECT_EQ(third[k], T(T(T(2) * a[k]) + T(0.5)));
        }
        T biggest = a[0];
        for (std::size_t k = 1; k < this->w; ++k) biggest = std::max(biggest, a[k]);
        EXPECT_EQ(largest(x), biggest);
    }
}

TYPED_TEST(PackOf, ComparesEachLane)
{
    using V = TypeParam;
    const V zero(0), one(1);
    auto all_are = [&](auto const& mask) {
        const auto l = this->lanes(V(spate::where(mask, V(1), V(0))));
        std::size_t n = 0;
        for (std::size_t k = 0; k < this->w; ++k) n += l[k] == 1;
        return n == this->w ? 1 : n == 0 ? 0 : -1;
    };
    EXPECT_EQ(all_are(zero < one), 1);
    EXPECT_EQ(all_are(one < one), 0);
    EXPECT_EQ(all_are(one <= one), 1);
    EXPECT_EQ(all_are(one > zero), 1);
    EXPECT_EQ(all_are(one > one), 0);
    EXPECT_EQ(all_are(one >= one), 1);
    EXPECT_EQ(all_are(zero == one), 0);
    EXPECT_EQ(all_are(one == one), 1);
    EXPECT_TRUE(spate::any(zero < one));
    EXPECT_FALSE(spate::any(one < zero));
}

TYPED_TEST(PackOf, StoresOnlyTheFirstLanes)
{
    using V = TypeParam;
    using T = scalar_t<V>;
    const auto a = this->draw(1, 2);
    for (int lanes = 1; lanes <= int(this->w); ++lanes) {
        std::vector<T> to(2 * this->w, T(-7));
        store_first(to.data() + 1, load<V>(a.x), lanes); // any alignment
        EXPECT_EQ(to[0], T(-7));
        for (std::size_t k = 0; k + 1 < to.size(); ++k) EXPECT_EQ(to[k + 1], k < std::size_t(lanes) ? a[k] : T(-7));
    }
}

template <int Stride, int Count, class V>
void expect_records_load()
{
    using T = scalar_t<V>;
    constexpr auto w = std::size_t(width<V>);
    constexpr int records = 50;
    Array<T> data(std::size_t(records * Stride));
    for (std::size_t k = 0; k < data.size(); ++k) data[k] = T(k) + T(0.25);
    std::mt19937 random(unsigned(Stride * 100 + Count));
    for (int trial = 0; trial < 20; ++trial) {
        std::int32_t at[w];
        for (auto& a : at) a = std::int32_t(random() % records) * Stride;
        at[random() % w] = trial % 2 == 0 ? 0 : (records - 1) * Stride; // the first and the last too
        V out[std::size_t(Count)];
        load_records<Stride, Count>(data.data(), at, out);
        for (int f = 0; f < Count; ++f) {
            alignas(64) T lane[w];
            store(lane, out[f]);
            for (std::size_t k = 0; k < w; ++k) EXPECT_EQ(lane[k], data[std::size_t(at[k] + f)]);
        }
    }
}
/// All counts of a stride that a layout can have.
template <int Stride, class V, int... n>
void expect_all_counts(std::integer_sequence<int, n...>)
{
    constexpr int least = Stride <= 2 ? Stride : Stride <= 8 ? Stride - 3 : Stride - 1;
    (expect_records_load<Stride, least + n, V>(), ...);
}
TYPED_TEST(PackOf, LoadsTransposedRecords)
{
    expect_all_counts<1, TypeParam>(std::make_integer_sequence<int, 1>{});
    expect_all_counts<2, TypeParam>(std::make_integer_sequence<int, 1>{});
    expect_records_load<4, 3, TypeParam>();
    expect_records_load<4, 4, TypeParam>();
    expect_all_counts<8, TypeParam>(std::make_integer_sequence<int, 4>{});
    expect_all_counts<10, TypeParam>(std::make_integer_sequence<int, 2>{});
    expect_all_counts<12, TypeParam>(std::make_integer_sequence<int, 2>{});
    expect_all_counts<14, TypeParam>(std::make_integer_sequence<int, 2>{});
    expect_all_counts<16, TypeParam>(std::make_integer_sequence<int, 2>{});
}

template <int Dim>
void expect_selection(std::mt19937& random)
{
    auto real = [&] { return float(random()) * 0x1p-32f; };
    std::vector<float> x[std::size_t(Dim)];
    std::int32_t number[16];
    float const* from[std::size_t(Dim)];
    float at[std::size_t(Dim)];
    for (int c = 0; c < Dim; ++c) {
        x[c].resize(16);
        for (auto& v : x[c]) v = real();
        from[c] = x[c].data(), at[c] = real();
    }
    for (int k = 0; k < 16; ++k) number[k] = 100 + 3 * k;
    const int count = 1 + int(random() % 20), self = random() % 2 == 0 ? -1 : number[random() % 16];
    const float reach2 = 0.5f * real(), inner2 = reach2 * real();
    std::vector<std::int32_t> expected;
    std::int64_t expected_within = 5;
    for (int k = 0; k < std::min(count, 16); ++k) {
        float d2 = 0;
        for (int c = 0; c < Dim; ++c) d2 += (x[c][std::size_t(k)] - at[c]) * (x[c][std::size_t(k)] - at[c]);
        if (number[k] == self || !(d2 < reach2)) continue;
        expected.push_back(number[k]);
        expected_within += d2 < inner2;
    }
    std::int32_t list[32];
    std::int64_t within = 5;
    const int m = select_near<Dim>(from, number, count, at, reach2, inner2, self, list, within);
    EXPECT_EQ(std::vector<std::int32_t>(list, list + m), expected);
    EXPECT_EQ(within, expected_within);
}
TEST(Selection, FindsWhatIsNearInOrder)
{
    std::mt19937 random(9);
    for (int trial = 0; trial < 2000; ++trial) {
        expect_selection<1>(random);
        expect_selection<2>(random);
        expect_selection<3>(random);
    }
}
TEST(Selection, LeavesOutWhatLiesExactlyAtTheReach)
{
    float x[16] = {0, 1, 2, -2, 3};
    float const* from[1] = {x};
    const float at[1] = {0};
    const std::int32_t number[16] = {0, 1, 2, 3, 4};
    std::int32_t list[32];
    std::int64_t within = 0;
    EXPECT_EQ(select_near<1>(from, number, 5, at, 4.f, 1.f, 0, list, within), 1);
    EXPECT_EQ(list[0], 1);
    EXPECT_EQ(within, 0);
}

/// Every set of lanes: a mask and its bits, and values side by side that come to their lanes and go back, no others touched.
template <class V>
class LanesOf : public ::testing::Test {};
using WithLanes = ::testing::Types<Scalar<float>, Pack<double>, Pack<float>>;
TYPED_TEST_SUITE(LanesOf, WithLanes);

TYPED_TEST(LanesOf, ASetComeAndGoSideBySide)
{
    using V = TypeParam;
    using T = scalar_t<V>;
    constexpr int W = width<V>;
    for (unsigned set = 0; set<1u << W; set += W> 8 ? 37 : 1) {
        T side[std::size_t(2 * W)], lane[std::size_t(W)], chosen[std::size_t(W)];
        int n = 0;
        for (int k = 0; k < 2 * W; ++k) side[k] = T(k + 1);
        for (int k = 0; k < W; ++k) chosen[k] = (set >> k & 1) != 0 ? T(1) : T(-1);
        EXPECT_EQ(bits(load<V>(chosen) > V(0)), set);
        const V v = SomeLanes<V>(set).load(side);
        store(lane, v);
        for (int k = 0; k < W; ++k) EXPECT_EQ(lane[k], (set >> k & 1) != 0 ? T(++n) : T(0)) << set << ' ' << k;
        T back[std::size_t(2 * W)];
        for (auto& b : back) b = T(-7);
        SomeLanes<V>(set).store(back, v);
        for (int k = 0; k < 2 * W; ++k) EXPECT_EQ(back[k], k < n ? T(k + 1) : T(-7)) << set << ' ' << k;
    }
}

} // namespace
