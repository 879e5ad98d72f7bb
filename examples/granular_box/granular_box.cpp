// SPDX-License-Identifier: BSD-3-Clause
// Grains in a box, in contact as springs (Cundall & Strack 1979). The seed deck's discs have no friction and no loss; those of
// a pile and spheres that flow have a dashpot and friction. examples/run.sh chooses the policies in scene:: and the case.
#include "granular_box/cases.hpp"
#include "support/example.hpp"

using namespace spate;
using granular::Case;

int main(int argc, char** argv)
{
    example::Example example("granular_box", "Discs or spheres that collide in a box.", Case::defaults);
    auto const& o = example.options();
    granular::Numbers n = Case::numbers;
    n.options(example.command_line(), Case::rough);
    example.command_line().seed();

    return example.main(argc, argv, [&] {
        n.check();
        const auto start = Case::start(n, o.seed);
        const auto contact = Case::contact(n); // m dv_i/dt = sum_j k overlap_ij n_ij [- c (v_ij . n) n + friction]
        const auto terms = std::tuple_cat(contact, Case::forces(n)); // [+ m g]
        const auto grains =
            std::apply([&](auto... t) { return dem<Case::dim>({.mass = n.mass, .radius = n.radius}, t...); }, terms);
        const auto faces = std::apply([&](auto... t) { return Case::walls(t...); }, contact);
        const auto walls = std::apply([&](auto... f) { return Walls(*start.box, f...); }, faces);
        // Energy is looked at often where the scheme may create it.
        const Watch watch{.energy_every = scene::Integrator::growth(1) > 0 ? 10 : 100};
        Simulation box(grains, scene::Integrator{}, walls, scene::backend(o), scene::Precision{}, watch);
        start.add_to(box);
        example.run(box);
    });
}
// The seed: kinetic energy is 3276.8 J at the start; at fraction 0.8 a fifth of it is in contacts at any time.
