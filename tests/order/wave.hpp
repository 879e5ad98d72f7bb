// SPDX-License-Identifier: BSD-3-Clause
// A standing sound wave on a periodic lattice of spacing 1, sound speed 1, and what is read off it.
#pragma once

#include "spate/spate.hpp"

#include "extreme/chosen.hpp"
#include "lattice.hpp"
#include "physics/one_of.hpp"

#include <Eigen/Dense>

#include <vector>

namespace wave {

using namespace spate;

constexpr int N = 32;        // points of a wavelength
constexpr double eps = 1e-6; // speed amplitude over c0
constexpr double rho0 = 1000;
constexpr double k0 = 2 * std::numbers::pi / N;

/// Rows across the wave: about the shortest periodic box that neighbour lists with a skin of 1/4 allow.
inline int rows(double h) { return int(std::ceil(2 * 2 * h * 1.25)); }

/// Kernel, integrator and sigma are chosen when a test runs: they are one type of scene, compiled once.
inline void choose(CubicSpline<2>) { chosen::kernel = 0; }
template <int Dim>
void choose(WendlandC2<Dim>)
{
    chosen::kernel = 2;
}
inline void choose(SymplecticEuler) { chosen::integrator = chosen::symplectic_euler; }
inline void choose(ForwardEuler) { chosen::integrator = chosen::forward_euler; }
inline void choose(Leapfrog) { chosen::integrator = chosen::leapfrog; }
inline void choose(RungeKutta2) { chosen::integrator = chosen::runge_kutta2; }

/// A fluid at rest on the lattice without viscosity, moving as v = amplitude c0 khat sin(k . x) at first.
/// \param axes  1: k along x; 2: along the diagonal of x and y    \param h  of the chosen kernel
template <int dim>
auto standing(int axes, int sigma, double h, double amplitude = eps)
{
    Box<dim> box{{}, {}};
    for (int c = 0; c < dim; ++c) box.hi[c] = c < axes ? N : rows(h);
    auto fluid = wcsph(chosen::AnyKernel<dim>{chosen::support() * h}, LinearEos{.rho0 = rho0, .c0 = 1},
                       OneOf<Continuity<1>, Continuity<2>>{{}, sigma - 1},
                       OneOf<PressureForce<1>, PressureForce<2>>{{}, sigma - 1});
    Simulation sim(fluid, chosen::AnyIntegrator{}, Periodic(box), Serial{}, Double{}, NoWatch{});
    sim.fill(box, 1, [&](auto& p, std::size_t i) {
        double phase = 0;
        for (int c = 0; c < axes; ++c) phase += k0 * p.at(position, i)[c];
        Vec<dim, double> v{};
        for (int c = 0; c < axes; ++c) v[c] = amplitude / std::sqrt(axes) * std::sin(phase);
        p.put(velocity, i, v);
    });
    return sim;
}

/// Amplitudes of the wave over eps: of velocity on khat sin, of density on rho0 cos; by where particles started.
class Amplitude {
public:
    Amplitude(int axes, auto const& sim) : axes_(axes)
    {
        auto const& p = sim.particles();
        phase_.resize(p.size());
        for (std::size_t i = 0; i < p.size(); ++i)
            for (int c = 0; c < axes; ++c) phase_[p.id()[i]] += k0 * p.at(position, i)[c];
    }
    [[nodiscard]] double velocity(auto const& sim) const
    {
        auto const& p = sim.particles();
        double sum = 0;
        for (std::size_t i = 0; i < p.size(); ++i)
            for (int c = 0; c < axes_; ++c)
                sum += p.at(spate::velocity, i)[c] / std::sqrt(axes_) * std::sin(phase_[p.id()[i]]);
        return 2 * sum / (eps * double(p.size()));
    }
    [[nodiscard]] double density(auto const& sim) const
    {
        auto const& p = sim.particles();
        double sum = 0;
        for (std::size_t i = 0; i < p.size(); ++i)
            sum += (p.at(spate::density, i) - rho0) / rho0 * std::cos(phase_[p.id()[i]]);
        return 2 * sum / (eps * double(p.size()));
    }

private:
    int axes_;
    std::vector<double> phase_;
};

/// exp(growth n) (a cos(theta n) + b sin(theta n)) through a series, by least squares: first of its recurrence
/// y(n+1) = 2 R cos(theta) y(n) - R^2 y(n-1), then of itself by Gauss and Newton.
struct Oscillation {
    double theta = 0, growth = 0; // of a step
};
inline Oscillation fitted(std::vector<double> const& y)
{
    const auto n = Eigen::Index(y.size());
    const Eigen::Map<const Eigen::VectorXd> all(y.data(), n);
    Eigen::MatrixXd r(n - 2, 2);
    r << all.segment(1, n - 2), -all.head(n - 2);
    const Eigen::Vector2d q = r.colPivHouseholderQr().solve(all.tail(n - 2));
    Eigen::Vector4d s{y[0], 0, 0, 0};
    s[3] = 0.5 * std::log(q[1]);
    s[2] = std::acos(q[0] / (2 * std::sqrt(q[1])));
    for (int pass = 0; pass < 20; ++pass) {
        Eigen::MatrixXd J(n, 4);
        Eigen::VectorXd error(n);
        for (Eigen::Index t = 0; t < n; ++t) {
            const double e = std::exp(s[3] * double(t)), c = e * std::cos(s[2] * double(t)),
                         d = e * std::sin(s[2] * double(t));
            const double value = s[0] * c + s[1] * d;
            error[t] = all[t] - value;
            J.row(t) << c, d, double(t) * (s[1] * c - s[0] * d), double(t) * value;
        }
        const Eigen::Vector4d step = J.colPivHouseholderQr().solve(error);
        s += step;
        if (step.norm() < 1e-14) break;
    }
    return {s[2], s[3]};
}

/// The fit over a number of periods.
template <int dim>
Oscillation measured(int axes, int sigma, double h, double dt, double omega, double periods)
{
    auto sim = standing<dim>(axes, sigma, h);
    const Amplitude amplitude(axes, sim);
    std::vector<double> y{amplitude.velocity(sim)};
    while (double(sim.steps()) * dt * omega < periods * 2 * std::numbers::pi) {
        sim.run({.steps = 1, .dt = dt});
        y.push_back(amplitude.velocity(sim));
    }
    return fitted(y);
}
template <class Integrator, class K>
Oscillation measured(int axes, int sigma, K kernel, double dt, double omega, double periods)
{
    choose(kernel), choose(Integrator{});
    return measured<K::dim>(axes, sigma, kernel.h, dt, omega, periods);
}

} // namespace wave
