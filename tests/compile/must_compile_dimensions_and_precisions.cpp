// SPDX-License-Identifier: BSD-3-Clause
// One text of physics in 1, 2 and 3 dimensions, in double, in float, and one particle at a time.
#include <spate/spate.hpp>

using namespace spate;

namespace {

template <int Dim, class Precision>
void column(Precision precision)
{
    Vec<Dim, double> lo{}, hi{}, g{};
    for (int c = 0; c < Dim; ++c) hi[c] = 0.1;
    g[Dim - 1] = -9.81;
    Simulation water(wcsph(WendlandC2<Dim>{.h = 0.02}, LinearEos{.rho0 = 1000, .c0 = 10}, Continuity<1>{},
                           PressureForce<1>{}, LaminarViscosity{.mu = 1e-3}, Gravity<Dim>{g}),
                     Leapfrog{}, Periodic(Box<Dim>{lo, hi}), Serial{}, precision);
    water.fill(Box<Dim>{lo, hi}, 0.01);
    water.run({.steps = 1});
}

} // namespace

void must_compile_dimensions_and_precisions()
{
    column<1>(Double{});
    column<2>(Float{});
    column<3>(Mixed{});
    column<3>(Double{});
    column<1>(ScalarOf<Float>{});
    column<2>(ScalarOf<Double>{});
}
