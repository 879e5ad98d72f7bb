// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Flow between two plates, driven by a force, from rest (Morris, Fox & Zhu 1997, section 5.2): numerics V13, figure
/// W2. nu = 1e-6 m^2/s; L = 1e-3 m and Re = 0.0125 are theirs; time in L^2/nu.
#pragma once

#include "family.hpp"

#include <cmath>
#include <numbers>

namespace work_precision {

/// u/V0: the steady profile and a series that dies out.
inline double profile(double y, double t)
{
    const double pi = std::numbers::pi;
    double u = 4 * y * (1 - y);
    for (int n = 1; n < 100; n += 2)
        u -= 32 / (pi * pi * pi * n * n * n) * std::sin(n * pi * y) * std::exp(-n * n * pi * pi * t);
    return u;
}
/// L2 and the largest error of u over V0.
inline std::vector<std::pair<std::string, double>> errors_of_channel(auto& scene, double L, double V0, double nu)
{
    auto const& p = scene.particles();
    double off = 0, size = 0, most = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double exact = profile(p.at(position, i)[1] / L, scene.time() * nu / (L * L));
        const double u = p.at(velocity, i)[0] / V0;
        off += (u - exact) * (u - exact), size += exact * exact, most = std::max(most, std::abs(u - exact));
    }
    return {{"L2_u", std::sqrt(off / size)}, {"Linf_u", most}};
}

/// \tparam Slip  options of the wall: no_slip, where the wall has not got it in itself
template <class K, class I, class Precision, class Wall, class... Slip>
void add_channel(std::string const& kernel, double h_dx, std::string const& formulation, Wall wall, Slip... slip)
{
    auto run = [=](Setting const& s) {
        const double nu = 1e-6, L = s.length, dx = L / s.n, h = h_dx * dx, V0 = s.reynolds * nu / L, rho0 = 1000;
        const double c0 = s.sound * V0, F = 8 * nu * V0 / (L * L);
        const double courant = std::min(s.cfl, 0.5 * s.cfl * c0 * h / nu); // as in taylor_green.hpp
        const Box<2> box{{0, 0}, {dx * std::max(16, s.n * 2 / 5), L}};     // wide enough for the lists
        auto make = [&] {
            const auto fluid =
                wcsph(K{.h = h}, LinearEos{.rho0 = rho0, .c0 = c0}, Continuity<2>{}, MolteniColagrossi{.delta = 0.1},
                      PressureForce<2>{}, LaminarViscosity{.mu = rho0 * nu, .eps = 0},
                      Shifting{.mach = V0 / c0, .cfl = 6 * courant}, Gravity<2>{{F, 0}});
            Simulation scene(fluid, I{}, Bce(box, dx, wall, periodic(x_axis), slip...), Threads{s.threads, s.cell},
                             Precision{}, Watch{}, lists_of(s, fluid.interaction.neighbours));
            scene.fill(box, dx);
            return scene;
        };
        return measured<I>(s, {.until = s.until * L * L / nu, .cfl = s.cfl}, make,
                           [&](auto& scene) { return errors_of_channel(scene, L, V0, nu); });
    };
    families().push_back({"poiseuille", kernel, h_dx, formulation, I::name, precision_name<Precision>(), run});
}
/// The three walls with a kernel.
template <class K>
void add_channels(std::string const& kernel, double h_dx)
{
    add_channel<K, SymplecticEuler, Double>(kernel, h_dx, "adami+no_slip", Adami{}, no_slip);
    add_channel<K, SymplecticEuler, Double>(kernel, h_dx, "extrapolated", Extrapolated{});
    add_channel<K, SymplecticEuler, Double>(kernel, h_dx, "by_continuity", ByContinuity{});
}

} // namespace work_precision
