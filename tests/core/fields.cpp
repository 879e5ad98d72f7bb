// SPDX-License-Identifier: BSD-3-Clause
#include <spate/core/fields.hpp>

#include <gtest/gtest.h>

namespace {
using namespace spate;

inline constexpr struct Heat : ScalarField {
    static constexpr std::string_view name = "heat";
} heat{};
static_assert(Field<Heat> && Field<Position>);
static_assert(!Field<int> && !Field<Fields<Mass>>);

template <class A, class B>
constexpr bool same(A, B)
{
    return std::same_as<A, B>;
}

// The algebra of sets, by the compiler.
static_assert(same(Fields{mass, density}, Fields<Mass, Density>{}));
static_assert(same(Fields{mass} | Fields{density, mass}, Fields{mass, density}));
static_assert(same(Fields<>{} | Fields{heat}, Fields{heat}));
static_assert(same(Fields{heat} | Fields<>{}, Fields{heat}));
static_assert(same(Fields{mass, density, heat} & Fields{heat, mass}, Fields{mass, heat}));
static_assert(same(Fields{mass} & Fields{heat}, Fields<>{}));
static_assert(same(Fields{mass, density, heat} - Fields{density}, Fields{mass, heat}));
static_assert(same(Fields{mass} - Fields{mass}, Fields<>{}));
static_assert(Fields{mass} <= Fields{heat, mass});
static_assert(Fields<>{} <= Fields<>{} && Fields<>{} <= Fields{mass});
static_assert(!(Fields{mass, heat} <= Fields{mass}));
static_assert((Fields{mass} | Fields{mass}).size == 1);

// A field evolves where its rate is carried: position by the transport velocity if there is one.
static_assert(same(rate_in<Position>(Fields{position, velocity}), Fields{velocity}));
static_assert(same(rate_in<Position>(Fields{position, velocity, transport_velocity}), Fields{transport_velocity}));
static_assert(same(rate_in<Density>(Fields{density}), Fields<>{}));
static_assert(same(evolving(Fields{position, velocity, density, density_rate}), Fields{position, density}));
static_assert(same(evolving(Fields{position, velocity, acceleration, mass}), Fields{position, velocity}));
static_assert(same(of_kind<Kind::drift>(Fields{position, velocity, density, mass}), Fields{position, density}));
static_assert(same(of_kind<Kind::kick>(Fields{position, velocity, density, mass}), Fields{velocity}));
static_assert(components<Mass, 3> == 1 && components<Position, 3> == 3 && components<Position, 2> == 2);

TEST(Fields, AreNamedInOrder)
{
    EXPECT_EQ(to_string(Fields{position, density, heat}), "position density heat");
    EXPECT_EQ(to_string(Fields<>{}), "");
    EXPECT_EQ(names(Fields{mass, radius})[1], "radius");
}
TEST(Fields, AreVisitedOnceEachInOrder)
{
    std::string seen;
    for_each(Fields{velocity, heat, mass}, [&](auto f) { seen += std::string(f.name) + ";"; });
    EXPECT_EQ(seen, "velocity;heat;mass;");
}
TEST(Fields, OfTheLibraryHaveUnits)
{
    for_each(Fields{mass, radius, pressure, density_rate, density, acceleration, velocity, transport_velocity, position,
                    build_position},
             [](auto f) { EXPECT_NE(f.unit, "-") << f.name; });
}
TEST(Fields, ThatAreRatesAdvanceAFieldThatNamesThem)
{
    for_each(Fields{density_rate, acceleration}, []<class F>(F f) {
        using Advanced = typename F::rate_of;
        EXPECT_TRUE(Advanced::rates::template contains<F>) << f.name;
        EXPECT_TRUE(F::derived) << f.name;
    });
}

} // namespace
