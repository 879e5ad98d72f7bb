// SPDX-License-Identifier: BSD-3-Clause
// The laws of a smoothing kernel (kernel/kernel.hpp) for each kernel in each dimension, in double, float and packs
// (numerics V01).
#include <spate/kernel/cubic_spline.hpp>
#include <spate/kernel/quintic_spline.hpp>
#include <spate/kernel/wendland_c2.hpp>
#include <spate/kernel/wendland_c4.hpp>
#include <spate/kernel/wendland_c6.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cstring>

namespace {
using namespace spate;
constexpr double pi = std::numbers::pi;

/// W(0) h^dim and the second moment <x^2>/h^2 (numerics A.1).
template <class K>
struct Known;
template <int Dim>
struct Known<CubicSpline<Dim>> {
    static constexpr double centre[] = {2.0 / 3, 10 / (7 * pi), 1 / pi};
    static constexpr double second_moment[] = {1.0 / 3, 31.0 / 98, 3.0 / 10};
};
template <int Dim>
struct Known<QuinticSpline<Dim>> {
    static constexpr double centre[] = {11.0 / 20, 231 / (239 * pi), 11 / (20 * pi)};
    static constexpr double second_moment[] = {1.0 / 2, 2771.0 / 5736, 7.0 / 15};
};
template <int Dim>
struct Known<WendlandC2<Dim>> {
    static constexpr double centre[] = {5.0 / 8, 7 / (4 * pi), 21 / (16 * pi)};
    static constexpr double second_moment[] = {8.0 / 21, 5.0 / 18, 4.0 / 15};
};
template <int Dim>
struct Known<WendlandC4<Dim>> {
    static constexpr double centre[] = {3.0 / 4, 9 / (4 * pi), 495 / (256 * pi)};
    static constexpr double second_moment[] = {4.0 / 15, 7.0 / 33, 8.0 / 39};
};
template <int Dim>
struct Known<WendlandC6<Dim>> {
    static constexpr double centre[] = {55.0 / 64, 39 / (14 * pi), 1365 / (512 * pi)};
    static constexpr double second_moment[] = {8.0 / 39, 6.0 / 35, 1.0 / 6};
};

/// Integral over [a, b] by Gauss and Legendre with 8 points: exact to degree 15 (Abramowitz & Stegun, table 25.4).
double gauss(double a, double b, auto const& f)
{
    constexpr double x[] = {0.183434642495649804939476142360, 0.525532409916328985817739049189,
                            0.796666477413626739591553936476, 0.960289856497536231683560868569};
    constexpr double w[] = {0.362683783378361982965150449277, 0.313706645877887287337962201987,
                            0.222381034453374470544355994426, 0.101228536290376259152531354310};
    const double m = 0.5 * (a + b), r = 0.5 * (b - a);
    double sum = 0;
    for (int k = 0; k < 4; ++k) sum += w[k] * (f(m - r * x[k]) + f(m + r * x[k]));
    return r * sum;
}
/// Integral of F(q) over space with h = 1, for an F of degree up to 13 between knots at the integers.
template <class K>
double over_space(auto const& F)
{
    constexpr double surface[] = {2, 2 * pi, 4 * pi};
    double sum = 0;
    for (int k = 0; k < int(K::radius); ++k)
        sum += gauss(k, k + 1, [&](double q) { return surface[K::dim - 1] * detail::power(q, K::dim - 1) * F(q); });
    return sum;
}
/// f and g of one q with the arithmetic of V; every lane must agree.
template <class V>
double computed(V const& v)
{
    alignas(64) scalar_t<V> lane[std::size_t(width<V>)];
    store(lane, v);
    for (int k = 1; k < width<V>; ++k) EXPECT_EQ(std::memcmp(lane, lane + k, sizeof *lane), 0);
    return double(lane[0]);
}

template <class K>
class KernelLaws : public ::testing::Test {};
// clang-format off
using Kernels = ::testing::Types<CubicSpline<1>, CubicSpline<2>, CubicSpline<3>, QuinticSpline<1>, QuinticSpline<2>, QuinticSpline<3>,
                                 WendlandC2<1>, WendlandC2<2>, WendlandC2<3>, WendlandC4<1>, WendlandC4<2>, WendlandC4<3>,
                                 WendlandC6<1>, WendlandC6<2>, WendlandC6<3>>;
// clang-format on
TYPED_TEST_SUITE(KernelLaws, Kernels);

TYPED_TEST(KernelLaws, IntegratesToOne)
{
    using K = TypeParam;
    static_assert(Kernel<K>);
    const K k{.h = 1};
    EXPECT_NEAR(over_space<K>([&](double q) { return k.sigma() * K::f(q); }), 1, 1e-12);
    for (double h : {1e-3, 0.7, 42.0}) EXPECT_NEAR((K{.h = h}.sigma()) * std::pow(h, K::dim) / k.sigma(), 1, 1e-14);
}

TYPED_TEST(KernelLaws, HasTheKnownHeightAndSecondMoment)
{
    using K = TypeParam;
    const K k{.h = 1};
    EXPECT_NEAR(k.sigma() * K::f(0.0), Known<K>::centre[K::dim - 1], 1e-13);
    const double trace = over_space<K>([&](double q) { return q * q * k.sigma() * K::f(q); });
    EXPECT_NEAR(trace / K::dim, Known<K>::second_moment[K::dim - 1], 1e-13);
}

TYPED_TEST(KernelLaws, HasASlopeThatIsTheDerivativeOfItsShape)
{
    using K = TypeParam;
    constexpr double step = 1e-5; // the difference quotient is off by f''' step^2/6 < 1e-9, and by 1e-11 of rounding
    for (int n = 1; n < int(1050 * K::radius); ++n) {
        const double q = n * 1e-3;
        const double slope = (K::f(q + step) - K::f(q - step)) / (2 * step);
        EXPECT_NEAR(q * K::g(q), slope, 1e-7 * std::abs(K::g(0.0))) << "q = " << q;
    }
}

TYPED_TEST(KernelLaws, HasASlopeThatIntegratesToMinusOne) // sum of x dW/dx over an axis, by parts
{
    using K = TypeParam;
    const K k{.h = 1};
    EXPECT_NEAR(over_space<K>([&](double q) { return q * q * k.sigma() * K::g(q); }) / K::dim, -1, 1e-12);
}

TYPED_TEST(KernelLaws, HasAFiniteSlopeFactorAtTheCentre)
{
    using K = TypeParam;
    EXPECT_TRUE(std::isfinite(K::g(0.0)));
    EXPECT_TRUE(std::isfinite(computed(K::g(Pack<double>(0)))));
    EXPECT_TRUE(std::isfinite(computed(K::g(Pack<float>(0)))));
    EXPECT_TRUE(std::isfinite(computed(K::g(Scalar<float>(0)))));
    EXPECT_LT(K::g(0.0), 0);
    EXPECT_NEAR(K::g(1e-9) / K::g(0.0), 1, 1e-8);
}

TYPED_TEST(KernelLaws, FallsFromTheCentreToTheSupport)
{
    using K = TypeParam;
    for (int n = 0; n < int(1000 * K::radius); ++n) {
        const double q = n * 1e-3;
        EXPECT_GT(K::f(q), K::f(q + 1e-3));
        EXPECT_LT(K::g(q), 0);
    }
}

template <class K, class V>
void expect_nothing_beyond()
{
    using T = scalar_t<V>;
    const T edge = T(K::radius);
    for (T q : {edge, std::nextafter(edge, T(9)), edge + T(0.5), T(7), T(1e6), T(1e12), T(1e15)}) {
        EXPECT_EQ(computed(K::f(V(q))), 0) << q;
        EXPECT_EQ(computed(K::g(V(q))), 0) << q;
    }
    const double inside = double(std::nextafter(edge, T(0)));
    EXPECT_GE(computed(K::f(V(T(inside)))), 0);
    EXPECT_LE(computed(K::g(V(T(inside)))), 0);
}
TYPED_TEST(KernelLaws, IsExactlyZeroFromTheSupportOn)
{
    expect_nothing_beyond<TypeParam, double>();
    expect_nothing_beyond<TypeParam, Scalar<float>>();
    expect_nothing_beyond<TypeParam, Pack<double>>();
    expect_nothing_beyond<TypeParam, Pack<float>>();
}

TYPED_TEST(KernelLaws, HoldInFloatToItsRounding)
{
    using K = TypeParam;
    using V = Scalar<float>;
    const K k{.h = 1};
    EXPECT_NEAR(over_space<K>([&](double q) { return k.sigma() * computed(K::f(V(float(q)))); }), 1, 5e-7);
    for (int n = 0; n <= int(1024 * K::radius); ++n) {
        const float q = float(n) * 0x1p-10f;
        EXPECT_NEAR(computed(K::f(V(q))), K::f(double(q)), 5e-7 * K::f(0.0)) << q;
        EXPECT_NEAR(computed(K::g(V(q))), K::g(double(q)), 5e-7 * -K::g(0.0)) << q;
    }
}

TYPED_TEST(KernelLaws, HoldInPacksBitForBit)
{
    using K = TypeParam;
    for (int n = 0; n <= int(1000 * K::radius) + 1000; ++n) {
        const double q = n * 1e-3;
        EXPECT_EQ(computed(K::f(Pack<double>(q))), K::f(q));
        EXPECT_EQ(computed(K::g(Pack<double>(q))), K::g(q));
        EXPECT_EQ(computed(K::f(Pack<float>(float(q)))), computed(K::f(Scalar<float>(float(q)))));
        EXPECT_EQ(computed(K::g(Pack<float>(float(q)))), computed(K::g(Scalar<float>(float(q)))));
    }
}

TEST(CubicSpline, IsTheFormOfMonaghanAndLattanzio)
{
    const CubicSpline<3> k{.h = 1};
    for (double q : {0.0, 0.25, 0.5, 1.0}) // W = (1 - 3q^2/2 + 3q^3/4)/pi within h
        EXPECT_NEAR(k.sigma() * CubicSpline<3>::f(q), (1 - 1.5 * q * q + 0.75 * q * q * q) / pi, 1e-15);
    for (double q : {1.0, 1.25, 1.9}) // and (2 - q)^3/(4 pi) beyond
        EXPECT_NEAR(k.sigma() * CubicSpline<3>::f(q), std::pow(2 - q, 3) / (4 * pi), 1e-15);
}

TEST(QuinticSpline, IsTheFormOfMorrisFoxAndZhu)
{
    for (double q : {0.0, 0.25, 0.75, 1.0, 1.5, 2.0, 2.75}) {
        auto power5 = [](double x) { return x > 0 ? std::pow(x, 5) : 0; };
        EXPECT_NEAR(QuinticSpline<2>::f(q), power5(3 - q) - 6 * power5(2 - q) + 15 * power5(1 - q), 66 * 1e-15) << q;
    }
}

} // namespace
