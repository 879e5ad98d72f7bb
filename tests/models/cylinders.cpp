// SPDX-License-Identifier: BSD-3-Clause
// Slow flow through a square lattice of cylinders (Morris, Fox & Zhu 1997, section 5.3), drag by Sangani & Acrivos (1982):
// numerics V17.
#include "models/case.hpp"
#include "models/internal_flow.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace spate;

// Pitch and radius [m], viscosity [m^2/s], density [kg/m^3], force [N/kg], speed that c0 is taken of [m/s].
constexpr double L = 0.1, a = 0.02, nu = 1e-6, rho0 = 1000, f = 1.5e-7, V0 = 5e-5;
/// F/(mu U) of a square lattice by solid fraction, U the superficial velocity (Sangani & Acrivos 1982).
const double phi = std::numbers::pi * a * a / (L * L);
const double drag =
    4 * std::numbers::pi / (0.5 * std::log(1 / phi) - 0.738 + phi - 0.887 * phi * phi + 2.038 * phi * phi * phi);
const double U = rho0 * f * L * L / (drag * rho0 * nu);

/// The velocity over the cell, and the momentum.
struct Flow {
    double superficial = 0, momentum = 0, weight = 0; ///< [m/s], [kg m/s], [N]: of the force on the fluid
};
Flow flow(auto const& s)
{
    Flow w;
    auto const& p = s.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double m = p.at(mass, i), v = p.at(velocity, i)[0];
        w.superficial += m / p.at(density, i) * v / (L * L), w.momentum += m * v, w.weight += m * f;
    }
    return w;
}
// U to 3 % at 100 across.
TEST(LongCylinders, HaveTheDragOfSanganiAndAcrivos)
{
    constexpr int n = 100;
    const models::Case c("V17", "square lattice, t = 2400 s", n);
    const double dx = L / n;
    const Box<2> box{{0, 0}, {L, L}};
    Simulation s(
        models::internal_flow(dx, rho0, nu, V0, Gravity<2>{{f, 0}}), SymplecticEuler{},
        Bce(box, dx, Adami{}, periodic(x_axis), periodic(y_axis), no_slip, obstacle(Sphere<2>{{L / 2, L / 2}, a})));
    s.fill(box, dx);
    s.run({.until = 2400}); // 8 times (1 - phi) L^2 / (drag nu), in which the flow comes up
    const Flow before = flow(s);
    s.refresh();
    double drag_before = WallForce{}(s)[0];
    s.run({.until = 2410});
    const Flow after = flow(s);
    s.refresh();
    const double force = (drag_before + WallForce{}(s)[0]) / 2, gain = (after.momentum - before.momentum) / 10;
    std::printf(
        "U %.4e m/s, %.4f of %.4e; force on the cylinder %.5f, gain of momentum %.5f of the force on the fluid\n",
        after.superficial, after.superficial / U, U, force / after.weight, gain / after.weight);
    c.at_most("error of the superficial velocity", std::abs(after.superficial / U - 1), 0.03);
    // At rest in time the force would be all of it.
    c.at_most("balance of momentum, off by", std::abs((force + gain) / after.weight - 1), 1e-3);
    EXPECT_EQ(Leaks{dx}(s), 0);
    c.known_gap("force on the cylinder, off by", std::abs(force / after.weight - 1), "V17 force of a steady flow");
}

} // namespace
