// SPDX-License-Identifier: BSD-3-Clause
// X01: small waves on the lattice at and beyond the limits of linear theory, for every integrator and every row of the
// table of kernels: amplitudes grow as |R(z)| has it, and limits are where they should be.
#pragma once

#include "extreme/chosen.hpp"

#include "order/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include <gtest/gtest.h>

namespace linear {

using namespace chosen;

constexpr double rho0 = 1000, skin = 0.05;

/// A plane wave that fits the periodic box: k along the first `axes` axes, `m` wavelengths over `N` points along each.
struct Mode {
    int axes = 1, N = 1, m = 1;
    double symbol = 0; ///< |k_eff|, or decay over nu

    [[nodiscard]] double k() const { return 2 * std::numbers::pi * m / N; }
};
inline int least_points(double h) { return int(std::ceil(2 * support() * h * (1 + skin) * (1 + 1e-12))); }

/// The mode of largest symbol among those of boxes that are not much larger than they must be.
/// \param of  sum over the lattice of the term of one neighbour: (r2, k.x, x along k, G)
template <int Dim>
Mode stiffest(double h, auto const& of)
{
    const AnyKernel<Dim> shape{support() * h};
    const double scale = shape.sigma() / (shape.h * shape.h);
    Mode best;
    for (int axes = 1; axes <= Dim; ++axes)
        for (int N = least_points(h), most = N + 12; N < most; ++N)
            for (int m = 1; 2 * m <= N; ++m) {
                Mode mode{axes, N, m};
                spate::detail::each_lattice_point<Dim>(1, shape.h, [&](Vec<Dim, double> const& x) {
                    double along = 0;
                    for (int c = 0; c < axes; ++c) along += x[c];
                    const double r2 = x.squaredNorm();
                    mode.symbol += of(r2, mode.k() * along, along / std::sqrt(double(axes)),
                                      scale * AnyKernel<Dim>::g(std::sqrt(r2) / shape.h));
                });
                mode.symbol = std::abs(mode.symbol);
                if (mode.symbol > best.symbol * (1 + 1e-9)) best = mode;
            }
    return best;
}
template <int Dim>
Mode stiffest_sound(double h)
{
    return stiffest<Dim>(h, [](double, double kx, double along, double G) { return G * along * std::sin(kx); });
}
template <int Dim>
Mode stiffest_decay(double h)
{
    return stiffest<Dim>(h, [h](double r2, double kx, double, double G) {
        return 2 * G * r2 / (r2 + 0.01 * h * h) * (1 - std::cos(kx));
    });
}

/// The wave in a fluid of sound speed c0 and viscosity nu, velocity along x (decay) or along k (sound).
template <int Dim, class Precision>
class Wave {
public:
    Wave(double h, Mode const& mode, double c0, double nu, double amplitude, int threads)
        : mode_(mode), along_k_(nu == 0), sim_(scene(h, mode, c0, nu, threads))
    {
        Box<Dim> box = box_of(h, mode);
        sim_.fill(box, 1, [&](auto& p, std::size_t i) {
            Vec<Dim, double> v{};
            for (int c = 0; c < Dim; ++c) v[c] = amplitude * direction(c) * std::sin(phase(p.at(position, i)));
            p.put(velocity, i, v);
        });
        auto const& p = sim_.particles();
        phase_.resize(p.size());
        for (std::size_t i = 0; i < p.size(); ++i) phase_[p.id()[i]] = phase(p.at(position, i));
    }
    auto& scene() { return sim_; }
    /// sqrt(velocity^2 + (c0 density / rho0)^2) of the wave, over that of the start.
    double amplitude(double c0)
    {
        auto const& p = sim_.particles();
        double a = 0, b = 0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            for (int c = 0; c < Dim; ++c) a += direction(c) * p.at(velocity, i)[c] * std::sin(phase_[p.id()[i]]);
            b += c0 * (p.at(density, i) - rho0) / rho0 * std::cos(phase_[p.id()[i]]);
        }
        return std::hypot(a, along_k_ ? b : 0);
    }
    void run(int steps, double dt) { sim_.run({.steps = steps, .dt = dt}); }

private:
    static Box<Dim> box_of(double h, Mode const& mode)
    {
        Box<Dim> box{{}, {}};
        for (int c = 0; c < Dim; ++c) box.hi[c] = c < mode.axes ? mode.N : least_points(h);
        return box;
    }
    static auto scene(double h, Mode const& mode, double c0, double nu, int threads)
    {
        auto fluid =
            wcsph(AnyKernel<Dim>{support() * h}, LinearEos{.rho0 = rho0, .c0 = c0}, Continuity<2>{}, PressureForce<2>{},
                  LaminarViscosity{.mu = rho0 * nu, .eps = 0.01 / (support() * support())});
        return Simulation(fluid, AnyIntegrator{}, Periodic(box_of(h, mode)), Threads{threads}, Precision{}, NoWatch{},
                          Neighbours{.skin = skin});
    }
    [[nodiscard]] double phase(Vec<Dim, double> const& x) const
    {
        double sum = std::numbers::pi / 4; // at the shortest wave, too, neither a sine nor a cosine of zeros
        for (int c = 0; c < mode_.axes; ++c) sum += mode_.k() * (x[c] - 0.5);
        return sum;
    }
    [[nodiscard]] double direction(int c) const
    {
        if (!along_k_) return c == 0;
        return c < mode_.axes ? 1 / std::sqrt(double(mode_.axes)) : 0;
    }
    Mode mode_;
    bool along_k_;
    std::vector<double> phase_;
    decltype(scene(1, Mode{}, 1, 0, 1)) sim_;
};

/// Growth of the amplitude in a step, from step `from` to `to`.
template <int Dim, class Precision = Double>
double growth(double h, Mode const& mode, double c0, double nu, double dt, int from, int to, double amplitude = 1e-8,
              int threads = 1)
{
    Wave<Dim, Precision> wave(h, mode, c0, nu, amplitude, threads);
    wave.run(from, dt);
    const double before = wave.amplitude(c0);
    wave.run(to - from, dt);
    return std::pow(wave.amplitude(c0) / before, 1.0 / (to - from)) - 1;
}
/// Largest dt at which `stable(dt)`, by bisection between 0.97 and 1.03 of where it should be; -1 if not between them.
inline double limit(double expected, auto const& stable)
{
    double low = 0.97 * expected, high = 1.03 * expected;
    if (!stable(low) || stable(high)) return -1;
    while (high - low > 0.004 * expected) {
        const double middle = 0.5 * (low + high);
        (stable(middle) ? low : high) = middle;
    }
    return 0.5 * (low + high);
}
/// |R| - 1 on the imaginary axis: of the staggered map beyond its limit, of the others everywhere.
inline double theory(double z)
{
    if (integrator == forward_euler) return std::abs(std::complex<double>(1, z)) - 1;
    if (integrator == runge_kutta2) return std::abs(std::complex<double>(1 - z * z / 2, z)) - 1;
    const double half = z * z / 2 - 1; // x(n+1) - (2 - z^2) x(n) + x(n-1) = 0
    return half > 1 ? half + std::sqrt(half * half - 1) - 1 : 0;
}

struct Worst {
    double growth = 0, limit = 0; // largest relative errors
    int cases = 0;
};
template <int Dim>
Worst sound(double h)
{
    Worst worst;
    const double kappa = lattice::table("kernel_stability_constants.csv", kernels[kernel], Dim, h, "kappa") / h;
    const Mode mode = stiffest_sound<Dim>(h);
    EXPECT_NEAR(mode.symbol, kappa, 0.005 * kappa) << kernels[kernel] << ' ' << Dim << ' ' << h;
    for (integrator = forward_euler; integrator <= runge_kutta2; ++integrator) {
        const std::string what = std::string(integrators[integrator]) + " " + kernels[kernel] + " " +
                                 std::to_string(Dim) + "D h = " + std::to_string(h);
        auto at = [&](double z) { return z / mode.symbol; }; // dt
        const bool bounded = AnyIntegrator::limit() > 0;
        for (double z : bounded ? std::vector{2.1} : std::vector{0.3, 0.8}) {
            const double exact = theory(z), measured = growth<Dim>(h, mode, 1, 0, at(z), 8, bounded ? 14 : 48);
            EXPECT_NEAR(measured, exact, 0.05 * exact) << what << " z = " << z;
            worst.growth = std::max(worst.growth, std::abs(measured / exact - 1)), ++worst.cases;
        }
        if (!bounded) continue;
        const double found = limit(2 / kappa, [&](double dt) {
            Wave<Dim, Double> wave(h, mode, 1, 0, 1e-9, 1);
            const double start = wave.amplitude(1);
            for (int k = 0; k < 12; ++k) { // below the limit it swings by up to 1/sqrt(1 - z/2)
                wave.run(10, dt);
                if (!(wave.amplitude(1) < 100 * start)) return false;
            }
            return true;
        });
        EXPECT_NEAR(found, 2 / kappa, 0.02 * 2 / kappa) << what;
        worst.limit = std::max(worst.limit, std::abs(found * kappa / 2 - 1));
    }
    return worst;
}
template <int Dim>
Worst viscosity(double h)
{
    Worst worst;
    const double Lambda =
        lattice::table("kernel_stability_constants.csv", kernels[kernel], Dim, h, "Lambda") / (h * h); // of nu = 1
    const Mode mode = stiffest_decay<Dim>(h);
    EXPECT_NEAR(mode.symbol, Lambda, 0.005 * Lambda) << kernels[kernel] << ' ' << Dim << ' ' << h;
    constexpr double silent = 1e-9; // sound speed
    for (integrator = forward_euler; integrator <= runge_kutta2; ++integrator) {
        const double expected = AnyIntegrator::real() / Lambda;
        const double found = limit(expected, [&](double dt) { return growth<Dim>(h, mode, silent, 1, dt, 2, 42) < 0; });
        EXPECT_NEAR(found, expected, 0.02 * expected)
            << integrators[integrator] << ' ' << kernels[kernel] << ' ' << Dim << "D h = " << h;
        worst.limit = std::max(worst.limit, std::abs(found / expected - 1)), ++worst.cases;
    }
    return worst;
}
template <int Dim>
void all_rows(auto const& test, bool narrow_only = false)
{
    Worst worst;
    for (kernel = 0; kernel < 5; ++kernel)
        for (double h : {1.0, 1.3, 1.5, 2.0}) {
            if (narrow_only && h > 1.3) continue;
            const Worst w = test(h);
            worst.growth = std::max(worst.growth, w.growth), worst.limit = std::max(worst.limit, w.limit);
            worst.cases += w.cases;
        }
    testing::Test::RecordProperty("cases", worst.cases);
    testing::Test::RecordProperty("growth_error", testing::PrintToString(worst.growth));
    testing::Test::RecordProperty("limit_error", testing::PrintToString(worst.limit));
    std::printf("  %d cases; largest error of a growth %.2g, of a limit %.2g\n", worst.cases, worst.growth,
                worst.limit);
}

// Below the limit: bounded for 1e5 steps.
inline void expect_bounded(int steps, int threads)
{
    constexpr double h = 1.3;
    kernel = 0;
    const Mode mode = stiffest_sound<2>(h);
    for (int which : {symplectic_euler, leapfrog}) {
        integrator = which;
        const double z = 2 / 1.05;
        Wave<2, Double> wave(h, mode, 1, 0, 1e-8, threads);
        // From the invariant of the map, v^2 + w^2 x^2 less (z^2/4) w^2 x^2 of leapfrog, less z w x v of symplectic Euler.
        const double start = wave.amplitude(1), bound = 1 / std::sqrt(1 - (which == leapfrog ? z * z / 4 : z / 2));
        double most = 0;
        for (int k = 0; k < 100; ++k) {
            wave.run(steps / 100, z / mode.symbol);
            most = std::max(most, wave.amplitude(1) / start);
        }
        EXPECT_LT(most, 1.01 * bound) << integrators[which];
        EXPECT_GT(most, 0.5) << integrators[which];
    }
}

} // namespace linear
