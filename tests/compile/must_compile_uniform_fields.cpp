// SPDX-License-Identifier: BSD-3-Clause
// One value for all particles or one for each: the same term, and the model says which.
#include <spate/spate.hpp>

using namespace spate;

namespace {

using Equal = decltype(physics(Discs{0.01}, Uniform{mass, 0.1}, Uniform{radius, 0.01}, LinearSpring{.k = 1e5}));
using SomeUniform = decltype(physics(Discs{0.01}, LinearSpring{.k = 1e5}));
using OfEqual = Model<Equal, Open>;
using OfMixed = Model<SomeUniform, Open>;
static_assert(!(Fields{mass} <= OfEqual::mobile) && !(Fields{radius} <= OfEqual::mobile));
static_assert(Fields{mass, radius} <= OfMixed::mobile);
static_assert(std::same_as<decltype(OfEqual::record<0>()), Fields<Position>>);
static_assert(Fields{position, radius} <= OfMixed::record<0>() && OfMixed::record<0>() <= Fields{position, radius});

} // namespace

void must_compile_uniform_fields()
{
    Simulation equal(Equal{Discs{0.01}, {LinearSpring{.k = 1e5}}, {}}, Leapfrog{}, Open{});
    equal.particles().value(mass) = 0.1, equal.particles().value(radius) = 0.01;
    equal.add({0, 0});
    equal.run({.steps = 1, .dt = 1e-5});

    Simulation mixed(SomeUniform{Discs{0.01}, {LinearSpring{.k = 1e5}}, {}}, Leapfrog{}, Open{});
    mixed.fill(Box<2>{{0, 0}, {1, 1}}, 0.1,
               [](auto& p, std::size_t i) { p.put(mass, i, 0.1), p.put(radius, i, 0.01); });
    mixed.run({.steps = 1, .dt = 1e-5});
}
