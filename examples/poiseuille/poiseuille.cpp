// SPDX-License-Identifier: BSD-3-Clause
// A fluid at rest between two plates is set in motion along them by a force (Morris, Fox & Zhu 1997, section 5.2).
#include "poiseuille/series.hpp"
#include "support/difference.hpp"
#include "support/example.hpp"

using namespace spate;

int main(int argc, char** argv)
{
    example::Example example("poiseuille", "Flow between two plates, driven by a force, from rest.",
                             {.until = 1, .every = 0.1, .history_every = 0.01});
    auto const& o = example.options();

    return example.main(argc, argv, [&] {
        constexpr double L = 1e-3, nu = 1e-6, V0 = 1.25e-5; // width [m], viscosity [m^2/s], speed at the end [m/s]
        const double dx = o.spacing > 0 ? o.spacing : L / 40, h = scene::smoothing * dx, F = 8 * nu * V0 / (L * L),
                     c0 = 10 * V0;
        const double courant = std::min(o.cfl, o.cfl / 2 * c0 * h / nu); // c0 dt/h: by sound or by viscosity
        // clang-format off
        auto fluid = wcsph(scene::Kernel{.h = h},
                           LinearEos{.rho0 = 1000, .c0 = c0},                // p      =  c0^2 (rho - rho0)
                           Continuity<2>{},                                  // drho/dt = sum m_j v_ij . grad W
                           MolteniColagrossi{.delta = 0.1},                  //          +delta h c0 sum V_j psi_ij . grad W
                           PressureForce<2>{},                               // dv/dt  = -sum m_j (p_i/rho_i^2 + p_j/rho_j^2) grad W
                           LaminarViscosity{.mu = 1000 * nu, .eps = 0},      //          +sum m_j 2 mu x_ij . grad W v_ij / (rho r)^2
                           Gravity<2>{{F, 0}},                               //          +F
                           Shifting{.mach = V0 / c0, .cfl = 6 * courant});   // dx     = -C Ma (2h)^2 sum V_j/2 (1 + R) grad W
        // clang-format on
        const Box<2> box{{0, 0}, {0.4 * L, L}};
        Bce plates(box, dx, scene::wall, periodic(x_axis), no_slip);
        Simulation flow(fluid, scene::Integrator{}, plates, scene::backend(o), scene::Precision{});
        flow.fill(box, dx);
        auto exact = [=](auto x, double t) { return Vec<2, double>{series(x[1] / L, nu * t / (L * L), V0), 0}; };
        example.run(flow, example::Difference{"error", V0, exact}, Leaks{dx}, WallForce{});
    });
}
// The largest error of the velocity stays below 0.13 % of V0.
