// SPDX-License-Identifier: BSD-3-Clause
// What is left to the spacing of the particles: the smoothing length, by kernel and dimension.
#include <spate/spate.hpp>

#include <gtest/gtest.h>

namespace {
using namespace spate;
constexpr double dx = 0.01;

template <class K>
void expect_spacings(double spacings)
{
    const auto open = physics(Smoothing<K>{}, Gravity<K::dim>{});
    EXPECT_TRUE(open.open());
    EXPECT_EQ(open.at(dx).interaction.kernel.h, spacings * dx);
    const auto given = physics(Smoothing<K>{{.h = 0.017}}, Gravity<K::dim>{});
    EXPECT_FALSE(given.open());
    EXPECT_EQ(given.at(dx).interaction.kernel.h, 0.017) << "what is given stays";
}
TEST(SmoothingLength, FollowsFromTheSpacingByKernelAndDimension) // numerics A.1
{
    expect_spacings<CubicSpline<1>>(1.2);
    expect_spacings<CubicSpline<2>>(1.2);
    expect_spacings<CubicSpline<3>>(1.2);
    expect_spacings<QuinticSpline<1>>(1);
    expect_spacings<QuinticSpline<2>>(1);
    expect_spacings<QuinticSpline<3>>(1);
    expect_spacings<WendlandC2<1>>(2);
    expect_spacings<WendlandC2<2>>(2);
    expect_spacings<WendlandC2<3>>(1.5);
    expect_spacings<WendlandC4<1>>(2);
    expect_spacings<WendlandC4<2>>(2);
    expect_spacings<WendlandC4<3>>(2);
    expect_spacings<WendlandC6<1>>(2);
    expect_spacings<WendlandC6<2>>(2);
    expect_spacings<WendlandC6<3>>(2);
}

template <class B>
auto scene(CubicSpline<2> kernel, B boundary)
{
    return Simulation(wcsph(kernel, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, PressureForce<2>{},
                            ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -9.81}}),
                      RungeKutta2{}, boundary);
}
std::uint64_t after_ten_steps(CubicSpline<2> kernel)
{
    auto s = scene(kernel, Bce(Box<2>{{0, 0}, {0.2, 0.2}}, dx, Adami{}, open(top)));
    s.fill(Box<2>{{0, 0}, {0.1, 0.1}}, dx);
    s.run({.steps = 10});
    EXPECT_EQ(s.physics().interaction.kernel.h, 1.2 * dx);
    return s.state_hash();
}
TEST(SmoothingLength, LeftOpenGivesTheBitsOfTheSameGiven)
{
    EXPECT_EQ(after_ten_steps({}), after_ten_steps({.h = 1.2 * dx})); // the walls' own terms know h too
}
TEST(SmoothingLength, OfTheFirstFillStays)
{
    auto s = scene({}, Open{});
    s.fill(Box<2>{{0, 0}, {0.1, 0.1}}, dx);
    EXPECT_EQ(s.physics().interaction.kernel.h, 1.2 * dx);
    EXPECT_THROW(s.fill(Box<2>{{1, 0}, {1.1, 0.1}}, dx / 2), BadInput) << "mass is uniform";
    s.fill(Box<2>{{1, 0}, {1.1, 0.1}}, dx);
    EXPECT_EQ(s.physics().interaction.kernel.h, 1.2 * dx);
}
TEST(SmoothingLength, ThatNobodyGivesIsBadInput)
{
    auto s = scene({}, Open{});
    s.add({0, 0});
    try {
        s.prepare();
        ADD_FAILURE() << "a scene without a smoothing length";
    }
    catch (BadInput const& e) {
        EXPECT_NE(std::string(e.what()).find("kernel.h"), std::string::npos) << e.what();
    }
    EXPECT_THROW(scene({.h = std::nan("")}, Open{}), BadInput) << "a mistake is not an open length";
}
TEST(SmoothingLength, ThatIsTooLongForThePeriodIsBadInputAtTheFill)
{
    auto s = scene({}, Periodic(Box<2>{{0, 0}, {0.04, 0.04}})); // two supports are 0.048 m
    EXPECT_THROW(s.fill(Box<2>{{0, 0}, {0.04, 0.04}}, dx), BadInput);
    EXPECT_THROW(scene({.h = 1.2 * dx}, Periodic(Box<2>{{0, 0}, {0.04, 0.04}})), BadInput);
}

} // namespace
