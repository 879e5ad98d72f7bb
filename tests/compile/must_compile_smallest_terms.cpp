// SPDX-License-Identifier: BSD-3-Clause
// The smallest particle term and the smallest pair term: a declaration and a line; no attribute, no template head.
#include <spate/spate.hpp>

using namespace spate;

namespace {

//[terms
struct Drag {
    static constexpr Fields reads{velocity};
    static constexpr Fields adds{acceleration};
    double k; // [1/s]
    void operator()(auto& i) const { i[acceleration] -= k * i[velocity]; }
};
struct Alignment {
    static constexpr Fields reads{velocity};
    static constexpr Fields adds{acceleration};
    double k; // [m^2/s]
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        i[acceleration] += (k * ij.w) * (j[velocity] - i[velocity]);
    }
};
static_assert(ParticleTerm<Drag> && !PairTerm<Drag>);
static_assert(PairTerm<Alignment> && !ParticleTerm<Alignment>);
//]
static_assert(Term<Drag> && Term<Alignment>);

} // namespace

void must_compile_smallest_terms()
{
    Simulation flock(physics(Smoothing<WendlandC2<2>>{{.h = 0.02}}, Drag{1}, Alignment{1e-4}), SymplecticEuler{},
                     Open{});
    flock.fill(Box<2>{{0, 0}, {0.1, 0.1}}, 0.01);
    flock.run({.steps = 1, .dt = 1e-3});
}
