// SPDX-License-Identifier: BSD-3-Clause
// What users write themselves: it compiles, without a warning, and takes part as its declaration says.
#include "../smallest.hpp"

namespace {

using namespace smallest;

static_assert(Term<Drag> && Term<Alignment>);

auto bath()
{
    return Simulation(wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{},
                            PressureForce<2>{}, HeatConduction{.a = 1e-6}),
                      RungeKutta2{}, Open{});
}
using M = decltype(bath())::Engine::M;
static_assert(M::mobile <= Fields{position, velocity, density, pressure, density_rate, acceleration, build_position,
                                  temperature, temperature_rate});
static_assert(Fields{temperature, temperature_rate} <= M::mobile);
static_assert(Fields{temperature} <= M::evolving<0>() && Fields{temperature} <= M::record<0>());
static_assert(decltype(bath())::Engine::driven <= Fields{density, temperature});

auto water(auto const& kernel, auto const& integrator, auto const&... rest)
{
    return Simulation(wcsph(kernel, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, PressureForce<2>{}), integrator,
                      rest...);
}
void one_step(auto s, auto const&... start)
{
    s.fill(Box<2>{{0, 0}, {0.1, 0.1}}, 0.01, start...);
    s.run({.steps = 1, .dt = 1e-4});
}

} // namespace

void must_compile_smallest()
{
    const CubicSpline<2> kernel{.h = 0.012};
    one_step(bath(), [](auto& p, std::size_t i) { p.put(temperature, i, 300); });
    one_step(Simulation(physics(Smoothing<WendlandC2<2>>{{.h = 0.02}}, Drag{1}, Alignment{1e-4}), SymplecticEuler{},
                        Open{}));
    one_step(water(Parabola{.h = 0.02}, RungeKutta2{}, Open{}));
    one_step(water(kernel, DriftKick{}, Open{}));
    one_step(water(kernel, RungeKutta2{}, Nowhere{}, Backwards{}));
}
