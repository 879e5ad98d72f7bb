// SPDX-License-Identifier: BSD-3-Clause
#include <spate/core/particles.hpp>

#include <gtest/gtest.h>

#include <numeric>

namespace {
using namespace spate;

using Water = Particles<2, double, Fields<Position, Density>, Fields<Mass>>;
using Light = Particles<3, float, Fields<Position, Velocity>, Fields<>>;

Water five()
{
    Water p;
    p.resize(5);
    p.value(mass) = 0.5;
    for (std::size_t i = 0; i < 5; ++i) {
        p.put(position, i, {{double(i), 10 + double(i)}});
        p.put(density, i, 1000 + double(i));
    }
    p.pad();
    return p;
}

TEST(Particles, HoldNothingButTheirFields)
{
    EXPECT_EQ(to_string(Water::fields), "position density");
    EXPECT_EQ(to_string(Water::uniform), "mass");
    EXPECT_TRUE(Water::has<Mass> && Water::has<Density>);
    EXPECT_FALSE(Water::has<Velocity>);
    Water p;
    p.resize(1000);
    const std::size_t columns = 3 * 8, id = 4; // two of position, one of density; none of a uniform field
    EXPECT_GE(p.bytes(), 1000 * (columns + id));
    EXPECT_LE(p.bytes(), 1000 * (columns + id) + 2 * Water::padding * columns);
}

TEST(Particles, AreBornAtZeroWithNewIds)
{
    Water p = five();
    EXPECT_EQ(p.size(), 5u);
    EXPECT_FALSE(p.empty());
    p.resize(7);
    EXPECT_EQ(p.at(density, 4), 1004);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(p.id()[i], i);
    p.set_ids({3, 9, 1, 0, 4, 5, 2});
    p.resize(8);
    EXPECT_EQ(p.id()[7], 10u) << "ids of new particles continue from the largest";
    Water fresh;
    fresh.resize(3);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(fresh.at(density, i), 0);
        EXPECT_EQ(fresh.at(position, i), (Vec<2, double>{}));
    }
}

TEST(Particles, OfAPaddedSetAreBornAtZeroToo)
{
    Water p = five(); // its padding holds copies of the last one
    p.resize(6);
    EXPECT_EQ(p.at(density, 5), 0);
}

TEST(Particles, ShowUniformAndStoredFieldsAlike)
{
    const Water p = five();
    EXPECT_EQ(p.at(mass, 3), 0.5);
    EXPECT_EQ(p.at(density, 3), 1003);
    EXPECT_EQ(p.at(position, 2), (Vec<2, double>{{2, 12}}));
    EXPECT_EQ(p.column(position)[1][2], 12);
    EXPECT_EQ(p.load_at<double>(mass, 1), 0.5);
    EXPECT_EQ(p.uniforms<double>()[mass], 0.5);
}

TEST(Particles, ArePermutedWithTheirIds)
{
    Water p = five();
    p.permute({4, 2, 0, 1, 3});
    const std::uint32_t order[] = {4, 2, 0, 1, 3};
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_EQ(p.id()[k], order[k]);
        EXPECT_EQ(p.at(density, k), 1000 + double(order[k]));
        EXPECT_EQ(p.at(position, k), (Vec<2, double>{{double(order[k]), 10 + double(order[k])}}));
    }
}

TEST(Particles, ArePaddedWithCopiesOfTheLast)
{
    Water p = five();
    p.permute({1, 0, 2, 4, 3});
    auto const& rho = p.column(density)[0];
    EXPECT_GE(rho.size(), p.size() + Water::padding - 1) << "a whole pack may start at the last particle";
    EXPECT_EQ(rho.size() % Water::padding, 0u);
    for (std::size_t k = p.size(); k < rho.size(); ++k) EXPECT_EQ(rho[k], 1003);
}

template <class V>
void expect_packs()
{
    using T = scalar_t<V>;
    constexpr auto w = std::size_t(width<V>);
    Particles<3, T, Fields<Position, Velocity>, Fields<>> p;
    p.resize(40);
    for (std::size_t i = 0; i < 40; ++i)
        for (int c = 0; c < 3; ++c) {
            p.column(position)[c][i] = T(100 * c) + T(i);
            p.column(velocity)[c][i] = T(-1);
        }
    const auto r = p.template record_at<V>(Fields{position}, 3); // off alignment
    p.template store_at<V>(velocity, 3, r[position], 1);
    p.template store_at<V>(velocity, 20, r[position]);
    for (int c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < 40; ++i) {
            T v = T(-1);
            if (i == 3) v = T(100 * c + 3);
            if (i >= 20 && i < 20 + w) v = T(100 * c) + T(3 + i - 20);
            EXPECT_EQ(p.column(velocity)[c][i], v);
        }
}
TEST(Particles, AreLoadedAndStoredInPacks)
{
    expect_packs<double>();
    expect_packs<Scalar<float>>();
    expect_packs<Pack<double>>();
    expect_packs<Pack<float>>();
}

TEST(Particles, InFloatAreReadInDouble)
{
    Light p;
    p.resize(1);
    p.put(position, 0, {{0.1, 0.2, 0.3}});
    EXPECT_EQ(p.at(position, 0)[0], double(0.1f));
    EXPECT_TRUE((std::same_as<decltype(p.at(position, 0)), Vec<3, double>>));
}

} // namespace
