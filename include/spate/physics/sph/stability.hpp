// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What linear theory says of a scheme before it runs: sound waves on the particles' own lattice, how fast the
/// integrator makes them grow, how fast the terms damp them.
#pragma once

#include "spate/physics/wcsph.hpp"

#include <cmath>
#include <numbers>
#include <optional>

namespace spate {

/// A sound wave of the lattice: its worst case over wavelengths and directions.
struct WorstWave {
    double frequency = 0;  ///< of the shortest resolved sound: c0 max |k_eff| [1/s]
    double decay = 0;      ///< fastest decay by viscosity or density diffusion [1/s]
    double net_growth = 0; ///< largest growth of an amplitude less its damping [1/s]; 0 or less: none grows
    double wavelength = 0; ///< of the wave that grows most [m]
};

namespace detail {
/// Coefficient of V F (1 - cos k.x) in the decay of a velocity or density wave along e, summed over the terms; a term
/// that damps says `acoustic_damping(rho0, h, r2, xe2)` [m^2/s], xe = x . e.
template <class P>
[[gnu::cold]] double damping_of(P const& physics, double rho0, double h, double r2, double xe2)
{
    double sum = 0;
    each_in(physics.terms, [&](auto const& t) {
        if constexpr (requires { t.acoustic_damping(1.0, 1.0, 1.0, 1.0); }) sum += t.acoustic_damping(rho0, h, r2, xe2);
    });
    return sum;
}
/// f(x) for each point of a cubic lattice within a range, the origin left out.
template <int Dim>
[[gnu::cold]] void each_lattice_point(double spacing, double range, auto const& f)
{
    const int n = int(range / spacing);
    const int ny = Dim > 1 ? n : 0, nz = Dim > 2 ? n : 0;
    for (int k = -nz; k <= nz; ++k)
        for (int j = -ny; j <= ny; ++j)
            for (int i = -n; i <= n; ++i) {
                const double at[] = {i * spacing, j * spacing, k * spacing};
                if (i == 0 && j == 0 && k == 0) continue;
                Vec<Dim, double> x;
                for (int c = 0; c < Dim; ++c) x[c] = at[c];
                if (x.squaredNorm() < range * range) f(x);
            }
}
} // namespace detail

/// Sound waves along the axis and the diagonals of a lattice of the given spacing, under an integrator's growth per step
/// at omega dt (numerics: k_eff is the lattice symbol of the gradient; a wave loses half of what velocity or density
/// alone would lose).
/// \param growth  amplitude growth less 1 a step, of omega dt
template <class P>
WorstWave worst_wave(P const& physics, double spacing, double dt, double (*growth)(double))
{
    constexpr int dim = P::dim;
    constexpr int samples = 96;
    auto const& kernel = physics.interaction.kernel;
    auto const& eos = equation_of_state(physics);
    const double h = kernel.h, volume = std::pow(spacing, dim);
    WorstWave worst;
    worst.net_growth = -std::numeric_limits<double>::infinity();
    for (int diagonal = 1; diagonal <= dim; ++diagonal)
        for (int s = 1; s <= samples; ++s) {
            Vec<dim, double> e{};
            for (int c = 0; c < diagonal; ++c) e[c] = 1 / std::sqrt(double(diagonal));
            const double k =
                std::numbers::pi / spacing * std::sqrt(double(diagonal)) * s / samples; // to the zone's edge
            double k_eff = 0, decay = 0;
            detail::each_lattice_point<dim>(spacing, physics.interaction.range(), [&](Vec<dim, double> const& x) {
                const double r2 = x.squaredNorm(), xe = x.dot(e);
                const double F = kernel.sigma() / (h * h) * kernel.g(std::sqrt(r2) / h);
                k_eff -= volume * F * xe * std::sin(k * xe);
                decay -= volume * F * detail::damping_of(physics, eos.rho0, h, r2, xe * xe) * (1 - std::cos(k * xe));
            });
            const double omega = eos.c0 * std::abs(k_eff), net = growth(omega * dt) / dt - decay / 2;
            worst.frequency = std::max(worst.frequency, omega);
            worst.decay = std::max(worst.decay, decay);
            if (net > worst.net_growth) worst.net_growth = net, worst.wavelength = 2 * std::numbers::pi / k;
        }
    return worst;
}

} // namespace spate
