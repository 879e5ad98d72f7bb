// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Vortices in a periodic box (Taylor & Green 1937): numerics V15, figure W1. U = 1 m/s; time in L/U.
#pragma once

#include "family.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace work_precision {

/// The solution, L [m] and the viscosity that follows from Re.
struct Vortices {
    double L, nu;
    static constexpr double U = 1; // [m/s]
    [[nodiscard]] double k() const { return 2 * std::numbers::pi / L; }
    [[nodiscard]] double decay(double t) const { return std::exp(-2 * nu * k() * k() * t); }
    [[nodiscard]] Vec<2, double> velocity_at(Vec<2, double> const& x, double t) const
    {
        const double u = U * decay(t);
        return {-u * std::cos(k() * x[0]) * std::sin(k() * x[1]), u * std::sin(k() * x[0]) * std::cos(k() * x[1])};
    }
    [[nodiscard]] double pressure_at(Vec<2, double> const& x, double t) const // over rho
    {
        return -0.25 * std::pow(U * decay(t), 2) * (std::cos(2 * k() * x[0]) + std::cos(2 * k() * x[1]));
    }
};

/// L1 of speed and of velocity over that of the solution; mean error of pressure over its largest value (numerics B.0).
inline std::vector<std::pair<std::string, double>> errors_of(Vortices const& flow, auto& scene)
{
    scene.refresh();
    auto const& p = scene.particles();
    const auto n = double(p.size());
    double speed = 0, velocity_ = 0, size = 0, mean = 0, off = 0;
    for (std::size_t i = 0; i < p.size(); ++i) mean += double(p.at(pressure, i)) / n;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec<2, double> x = p.at(position, i), v = p.at(velocity, i), u = flow.velocity_at(x, scene.time());
        const double was = std::sqrt(v.squaredNorm()), is = std::sqrt(u.squaredNorm());
        speed += std::abs(was - is), velocity_ += std::sqrt((v - u).squaredNorm()), size += is;
        off += std::abs(double(p.at(pressure, i)) - mean - flow.pressure_at(x, scene.time())) / n;
    }
    const double largest = 0.5 * std::pow(flow.U * flow.decay(scene.time()), 2);
    return {{"L1_speed", speed / size}, {"L1_velocity", velocity_ / size}, {"L1_p", off / largest}};
}

/// \param fluid  (kernel, equation of state, viscosity, shifting as the step asks for) to a physics
template <class I, class Precision>
Outcome taylor_green(Setting const& s, double h_dx, auto const& fluid)
{
    const Vortices flow{s.length, Vortices::U * s.length / s.reynolds};
    const double dx = s.length / s.n, c0 = s.sound * flow.U, h = h_dx * dx;
    // 1.5 with a step of 0.25 h/c0, and C follows the step that is taken: docs/results/sph/internal.md
    const double courant = std::min(s.cfl, 0.5 * s.cfl * c0 * h / flow.nu);
    const Shifting shifting{.mach = flow.U / c0, .cfl = 6 * courant};
    const Box<2> box{{0, 0}, {s.length, s.length}};
    auto make = [&] {
        const auto physics = fluid(h, c0, flow.nu, shifting);
        Simulation scene(physics, I{}, Periodic(box), Threads{s.threads, s.cell}, Precision{}, Watch{},
                         lists_of(s, physics.interaction.neighbours));
        std::mt19937_64 dice(1);
        auto draw = [&] { return (double(dice() >> 11) * 0x1p-52 - 1) * s.jitter * dx; };
        scene.fill(box, dx, [&](auto& p, std::size_t i) {
            Vec<2, double> x = p.at(position, i);
            for (int c = 0; c < 2; ++c) x[c] += draw();
            p.put(position, i, x), p.put(velocity, i, flow.velocity_at(x, 0));
            p.put(density, i, 1 + flow.pressure_at(x, 0) / (c0 * c0));
        });
        return scene;
    };
    return measured<I>(s, {.until = s.until * s.length / flow.U, .cfl = s.cfl}, make,
                       [&](auto& scene) { return errors_of(flow, scene); });
}

template <class I, class Precision>
void add_vortices(std::string const& kernel, double h_dx, std::string const& formulation, auto const& fluid)
{
    families().push_back({"taylor_green", kernel, h_dx, formulation, I::name, precision_name<Precision>(),
                          [=](Setting const& s) { return taylor_green<I, Precision>(s, h_dx, fluid); }});
}
/// The parameters of tests/models/internal_flow.hpp with another kernel, integrator or precision.
template <int sigma, class K, class I, class Precision>
void add_shifted(std::string const& kernel, double h_dx)
{
    auto fluid = [](double h, double c0, double nu, Shifting const& shifting) {
        return wcsph(K{.h = h}, LinearEos{.rho0 = 1, .c0 = c0}, Continuity<sigma>{}, MolteniColagrossi{.delta = 0.1},
                     PressureForce<sigma>{}, LaminarViscosity{.mu = nu, .eps = 0}, shifting);
    };
    add_vortices<I, Precision>(kernel, h_dx, "sigma" + std::to_string(sigma) + "+diffusion+shifting", fluid);
}
/// One kernel with each integrator.
template <class K>
void add_vortices_with(std::string const& kernel, double h_dx)
{
    add_shifted<2, K, RungeKutta2, Double>(kernel, h_dx);
    add_shifted<2, K, Leapfrog, Double>(kernel, h_dx);
    add_shifted<2, K, SymplecticEuler, Double>(kernel, h_dx);
}

} // namespace work_precision
