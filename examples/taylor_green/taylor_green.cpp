// SPDX-License-Identifier: BSD-3-Clause
// Vortices in a periodic box die out by viscosity alone (Taylor & Green 1937) at Re = U L/nu = 100.
#include "support/difference.hpp"
#include "support/example.hpp"

using namespace spate;

int main(int argc, char** argv)
{
    example::Example example("taylor_green", "Decay of vortices in a periodic box at Re = 100.",
                             {.until = 1, .every = 0.1, .history_every = 0.01});
    auto const& o = example.options();

    return example.main(argc, argv, [&] {
        constexpr double L = 1, U = 1, nu = U * L / 100, c0 = 10 * U,
                         k = 2 * std::numbers::pi / L; // k: of a vortex [1/m]
        const double dx = o.spacing > 0 ? o.spacing : L / 50, h = scene::smoothing * dx;
        const double courant = std::min(o.cfl, o.cfl / 2 * c0 * h / nu); // c0 dt/h: by sound or by viscosity
        auto exact = [=](Vec<2, double> x, double t) -> Vec<2, double> { // decays by viscosity
            const double u = U * std::exp(-2 * nu * k * k * t);
            return {-u * std::cos(k * x[0]) * std::sin(k * x[1]), u * std::sin(k * x[0]) * std::cos(k * x[1])};
        };
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
        Simulation flow(fluid, scene::Integrator{}, Periodic(box), scene::backend(o), scene::Precision{});
        flow.fill(box, dx, [&](auto& p, auto i) { p.put(velocity, i, exact(p.at(position, i), 0)); });
        example.run(flow, example::Difference{"error", U, exact});
    });
}
// At t = 1 the fastest fluid has 45 % of its speed; the largest error of any particle is 1.2 % of U.
