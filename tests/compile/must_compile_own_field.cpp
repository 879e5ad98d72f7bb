// SPDX-License-Identifier: BSD-3-Clause
// A field of the user's own, with a rate: it is stored, packed, saved and advanced because a term adds to its rate.
#include <spate/spate.hpp>

using namespace spate;

namespace {

//[field
struct Temperature;
inline constexpr struct TemperatureRate : ScalarField {
    static constexpr std::string_view name = "temperature_rate", unit = "K/s";
    using rate_of = Temperature;
    static constexpr bool derived = true;
} temperature_rate{};
inline constexpr struct Temperature : ScalarField {
    static constexpr std::string_view name = "temperature", unit = "K";
    static constexpr Kind kind = Kind::drift;
    using rates = Fields<TemperatureRate>;
} temperature{};
//]

//[conduction
/// Heat conduction (Cleary & Monaghan 1999) at equal conductivity: dT_i/dt = sum_j 2 a V_j T_ij x_ij . grad W_ij / r^2.
struct HeatConduction {
    static constexpr Fields reads{temperature};
    static constexpr Fields reads_j{mass, density};
    static constexpr Fields adds{temperature_rate};
    double a; // diffusivity [m^2/s]
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto V_j = j[mass] / j[density];
        i[temperature_rate] += 2 * a * V_j * ij.over_r2 * (i[temperature] - j[temperature]) * ij.x.dot(ij.grad_w);
    }
};
//]

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

} // namespace

void must_compile_own_field()
{
    auto s = bath();
    s.fill(Box<2>{{0, 0}, {0.1, 0.1}}, 0.01, [](auto& p, std::size_t i) { p.put(temperature, i, 300); });
    s.run({.steps = 1});
}
