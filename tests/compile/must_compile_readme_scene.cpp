// SPDX-License-Identifier: BSD-3-Clause
// The scene of README.md, whole.
//[scene
#include <spate/io/history.hpp>
#include <spate/measure/front.hpp>
#include <spate/spate.hpp>

using namespace spate;

int main()
{
    constexpr double H = 0.6, dx = H / 32, g = 9.81; // column height [m], spacing [m], gravity [m/s^2]
    const double c0 = 10 * std::sqrt(2 * g * H);     // ten times the fastest flow: density varies by 1 %

    auto water = wcsph(CubicSpline<3>{.h = 1.2 * dx},      // W(r, h), support 2 h
                       Tait{.rho0 = 1000, .c0 = c0},       // p       =  B ((rho/rho0)^7 - 1)
                       Continuity<2>{},                    // drho/dt =  sum m_j v_ij . grad W
                       DensityDiffusion{.delta = 0.1},     //           +delta h c0 sum V_j psi_ij . grad W
                       PressureForce<2>{},                 // dv/dt   = -sum m_j (p_i/rho_i^2 + p_j/rho_j^2) grad W
                       ArtificialViscosity{.alpha = 0.02}, //          -sum m_j Pi_ij grad W
                       Gravity<3>{{0, 0, -g}});            //           +g
    Bce tank(Box<3>{{0, 0, 0}, {4 * H, H / 4, 2 * H}}, dx, Adami{.suction = false}, open(top));
    Simulation dam(water, RungeKutta2{}, tank, Threads{});
    dam.fill(Box<3>{{0, 0, 0}, {H / 2, H / 4, H}}, dx, hydrostatic);
    dam.run({.until = 0.9, .cfl = 0.2}, io::History(".", 0.01, Front{dx}));
}
//]
