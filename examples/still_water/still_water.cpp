// SPDX-License-Identifier: BSD-3-Clause
// Water at rest in an open tank (Adami, Hu & Adams 2012, section 6): weakly compressible SPH between walls of markers bears
// its own weight, and stays where it is. examples/run.sh chooses the policies in scene::.
#include "support/example.hpp"

using namespace spate;

int main(int argc, char** argv)
{
    example::Example example("still_water", "Water at rest in an open tank.",
                             {.until = 4, .cfl = 0.2, .every = 0.1, .history_every = 0.02, .colour = "pressure"});
    auto const& o = example.options();

    return example.main(argc, argv, [&] {
        constexpr double H = 0.9, g = 1, rho0 = 1000; // depth of the water [m], gravity [m/s^2], density [kg/m^3]
        const double dx = o.spacing > 0 ? o.spacing : H / (scene::dim == 3 ? 20 : 50); // spacing [m]
        const double c0 = 10 * std::sqrt(g * H);                                       // density varies by 1 %
        // clang-format off
        auto water = wcsph(scene::Kernel{.h = scene::smoothing * dx},
                           Tait{.rho0 = rho0, .c0 = c0},            // p       =  B ((rho/rho0)^7 - 1)
                           Continuity<2>{},                         // drho/dt =  sum m_j v_ij . grad W
                           DensityDiffusion{.delta = 0.1},          //           +delta h c0 sum V_j psi_ij . grad W
                           PressureForce<2>{},                      // dv/dt   = -sum m_j (p_i/rho_i^2 + p_j/rho_j^2) grad W
                           ArtificialViscosity{.alpha = 0.02},      //           -sum m_j Pi_ij grad W
                           Gravity<scene::dim>{scene::down(g)});    //           +g
        // clang-format on
        Vec<scene::dim, double> wet, tall, foot,
            middle; // corners of the water and the tank; the middle of the floor, of all
        for (int c = 0; c < scene::dim; ++c)
            wet[c] = c == 0 ? 2 * H : H, tall[c] = wet[c], foot[c] = middle[c] = wet[c] / 2;
        tall[scene::dim - 1] = 1.2 * H, foot[scene::dim - 1] = 0;
        Bce tank(Box<scene::dim>{{}, tall}, dx, scene::wall, open(top));
        Simulation still(water, scene::Integrator{}, tank, scene::backend(o), scene::Precision{});
        still.fill(Box<scene::dim>{{}, wet}, dx, settled);
        example.run(still, Leaks{dx}, WallForce{}, Probe{"p_floor", pressure, foot},
                    Probe{"p_middle", pressure, middle}, Gauge{"depth", foot, dx});
    });
}
// The floor of the compressible fluid bears 904.4 Pa in the exact solution, 0.49 % above rho0 g H.
