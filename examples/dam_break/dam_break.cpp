// SPDX-License-Identifier: BSD-3-Clause
// A column of water, twice as high as wide, collapses on a dry bed and runs against a wall (Martin & Moyce 1952):
// weakly compressible SPH between walls of markers. examples/run.sh chooses the policies in scene::.
#include "dam_break/column.hpp"
#include "support/example.hpp"

using namespace spate;

int main(int argc, char** argv)
{
    example::Example example("dam_break", "Collapse of a water column on a dry bed.",
                             {.until = 0.9, .cfl = 0.2, .every = 0.01, .history_every = 0.002});
    auto const& o = example.options();
    std::string boxes = "default";
    example.command_line().choice("--case", boxes, {"default", "big", "small", "2d", "seed", "lobovsky", "obstacle"},
                                  "Martin & Moyce, of timings, or of other experiments");

    return example.main(argc, argv, [&] {
        const auto c = column<scene::dim>(boxes, o.spacing);
        const double dx = c.spacing, c0 = 10 * c.fastest; // ten times the fastest flow: density varies by 1 %
        // clang-format off
        auto water = wcsph(scene::Kernel{.h = c.smoothing.value_or(scene::smoothing) * dx},
                           Tait{.rho0 = 1000, .c0 = c0},            // p       =  B ((rho/rho0)^7 - 1)
                           Continuity<2>{},                         // drho/dt =  sum m_j v_ij . grad W
                           DensityDiffusion{.delta = 0.1},          //           +delta h c0 sum V_j psi_ij . grad W
                           PressureForce<2>{},                      // dv/dt   = -sum m_j (p_i/rho_i^2 + p_j/rho_j^2) grad W
                           scene::viscosity(c.alpha, c.mu),         //           -sum m_j Pi_ij grad W
                           Gravity<scene::dim>{scene::down(c.g)});  //           +g
        // clang-format on
        Bce tank(c.tank, dx, scene::wall, layers(3), open(c.open), obstacle(c.box));
        Simulation dam(water, scene::Integrator{}, tank, scene::backend(o), scene::Precision{});
        dam.fill(c.water, dx, hydrostatic);
        example.run(dam, c.front(), Leaks{dx}, WallForce{}, c.sensors, c.gauges);
    });
}
// At 0.3 s the front has come to 0.89 m (Martin & Moyce: 0.87 m); it strikes the wall at 0.73 s.
