// SPDX-License-Identifier: BSD-3-Clause
// A standing sound wave on a lattice (numerics V08, figure W3): its exact frequency c k_eff is known for the lattice as it
// is, so that the error of the integrator stands alone. c0 = 1 m/s, wavelength 1 m; time in periods.
#include "family.hpp"

#include <cmath>
#include <numbers>

namespace work_precision {
namespace {

constexpr double c0 = 1, amplitude = 1e-6;

/// -sum V dW/dx sin(k x) over the lattice: what the gradient makes of the wave number k.
template <class K>
double lattice_wave_number(K const& kernel, double dx, double k)
{
    const int reach = int(std::ceil(K::radius * kernel.h / dx));
    double sum = 0;
    for (int a = -reach; a <= reach; ++a)
        for (int b = -reach; b <= reach; ++b) {
            const double q = dx * std::sqrt(double(a * a + b * b)) / kernel.h;
            if (q == 0 || q >= K::radius) continue;
            sum -= dx * dx * kernel.sigma() / (kernel.h * kernel.h) * kernel.g(q) * a * dx * std::sin(k * a * dx);
        }
    return sum;
}
/// The amplitudes of the wave's velocity and density after each step, over that of the start.
struct Wave {
    double k;
    std::vector<double> t, v, rho;

    void begin(auto& scene) { step(scene); }
    void step(auto& scene)
    {
        auto const& p = scene.particles();
        double a = 0, b = 0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const double x = p.at(position, i)[0];
            a += p.at(velocity, i)[0] * std::sin(k * x), b += (p.at(density, i) - 1) * c0 * std::cos(k * x);
        }
        const double scale = 2 / (double(p.size()) * amplitude);
        t.push_back(scene.time()), v.push_back(scale * a), rho.push_back(scale * b);
    }
    void end(auto&) {}
};
double slope(std::vector<double> const& x, std::vector<double> const& y)
{
    double mx = 0, my = 0, sxy = 0, sxx = 0;
    const auto n = double(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) mx += x[i] / n, my += y[i] / n;
    for (std::size_t i = 0; i < x.size(); ++i) sxy += (x[i] - mx) * (y[i] - my), sxx += (x[i] - mx) * (x[i] - mx);
    return sxy / sxx;
}
/// Of the frequency, of the amplitude in a period, and of the wave itself at the end.
std::vector<std::pair<std::string, double>> errors_of(Wave const& w, double omega)
{
    std::vector<double> phase, size;
    double turns = 0, last = 0;
    for (std::size_t i = 0; i < w.t.size(); ++i) {
        const double now = std::atan2(-w.rho[i], w.v[i]);
        if (now < last - std::numbers::pi) turns += 2 * std::numbers::pi;
        if (now > last + std::numbers::pi) turns -= 2 * std::numbers::pi;
        phase.push_back(turns + now), size.push_back(0.5 * std::log(w.v[i] * w.v[i] + w.rho[i] * w.rho[i]));
        last = now;
    }
    const double at = omega * w.t.back(), period = 2 * std::numbers::pi / omega;
    return {{"omega", std::abs(slope(w.t, phase) / omega - 1)},
            {"amplitude", std::abs(std::expm1(slope(w.t, size) * period))},
            {"wave", std::hypot(w.v.back() - std::cos(at), w.rho.back() + std::sin(at))}};
}

template <class K, class I>
void add(std::string const& kernel, double h_dx)
{
    auto run = [=](Setting const& s) {
        const double dx = 1.0 / s.n, h = h_dx * dx, k = 2 * std::numbers::pi;
        const int waves = std::max(1, (15 + s.n) / s.n); // long enough for the lists
        const Box<2> box{{0, 0}, {double(waves), 12 * dx}};
        const double omega = c0 * lattice_wave_number(K{.h = h}, dx, k);
        auto make = [&] {
            const auto fluid = wcsph(K{.h = h}, LinearEos{.rho0 = 1, .c0 = c0}, Continuity<2>{}, PressureForce<2>{});
            Simulation scene(fluid, I{}, Periodic(box), Threads{s.threads, s.cell});
            scene.fill(box, dx, [&](auto& p, std::size_t i) {
                p.put(velocity, i, {amplitude * c0 * std::sin(k * p.at(position, i)[0]), 0});
            });
            return scene;
        };
        Wave wave{k, {}, {}, {}};
        const double end = s.until * 2 * std::numbers::pi / omega;
        const double steps = std::ceil(end / (s.cfl * h / c0)); // whole ones
        return measured<I>(
            s, {.until = end, .dt = end / steps}, make, [&](auto&) { return errors_of(wave, omega); }, wave);
    };
    families().push_back({"acoustic", kernel, h_dx, "sigma2", I::name, "double", run});
}
const bool added = [] {
    add<CubicSpline<2>, ForwardEuler>("cubic_spline", 1.3);
    add<CubicSpline<2>, SymplecticEuler>("cubic_spline", 1.3);
    add<CubicSpline<2>, RungeKutta2>("cubic_spline", 1.3);
    add<CubicSpline<2>, Leapfrog>("cubic_spline", 1.3);
    return true;
}();

} // namespace
} // namespace work_precision
