// SPDX-License-Identifier: BSD-3-Clause
// A lid slides over a square cavity full of fluid (Ghia, Ghia & Shin 1982) at Re = U L/nu = 100.
#include "support/example.hpp"

using namespace spate;

int main(int argc, char** argv)
{
    example::Example example("cavity", "Flow in a square cavity under a sliding lid at Re = 100.",
                             {.until = 12, .every = 0.5, .history_every = 0.05});
    auto const& o = example.options();

    return example.main(argc, argv, [&] {
        constexpr double L = 1, U = 1, nu = U * L / 100, c0 = 10 * U;
        const double dx = o.spacing > 0 ? o.spacing : L / 50, h = scene::smoothing * dx;
        const double courant = std::min(o.cfl, o.cfl / 2 * c0 * h / nu); // c0 dt/h: by sound or by viscosity
        // clang-format off
        auto fluid = wcsph(scene::Kernel{.h = h},
                           LinearEos{.rho0 = 1, .c0 = c0},                   // p      =  c0^2 (rho - rho0)
                           Continuity<2>{},                                  // drho/dt = sum m_j v_ij . grad W
                           MolteniColagrossi{.delta = 0.1},                  //          +delta h c0 sum V_j psi_ij . grad W
                           PressureForce<2>{},                               // dv/dt  = -sum m_j (p_i/rho_i^2 + p_j/rho_j^2) grad W
                           LaminarViscosity{.mu = nu, .eps = 0},             //          +sum m_j 2 mu x_ij . grad W v_ij / (rho r)^2
                           Shifting{.mach = U / c0, .cfl = 6 * courant});    // dx     = -C Ma (2h)^2 sum V_j/2 (1 + R) grad W
        // clang-format on
        const Box<2> box{{0, 0}, {L, L}};
        Bce walls(box, dx, scene::wall, no_slip, lid(top, U, 0.0));
        Simulation flow(fluid, scene::Integrator{}, walls, scene::backend(o), scene::Precision{});
        flow.fill(box, dx);
        example.run(flow, Probe{"centre", velocity, Vec<2, double>{L / 2, L / 2}}, Leaks{dx}, WallForce{});
    });
}
// Nearly steady from t = 10 on: the velocity in the centre is then (-0.200, 0.054) U, by finite differences (-0.209, 0.058) U.
