// SPDX-License-Identifier: BSD-3-Clause
// Still water against the exact profile of the compressible fluid (Adami, Hu & Adams 2012, section 6: H = 0.9 m,
// g = 1 m/s^2, c0 = 10 sqrt(g H)), on walls of every state, in 2D and in 3D: V19 of the validation plan.
#pragma once

#include "models/case.hpp"
#include "models/results.hpp"

#include "spate/measure/leaks.hpp"
#include "spate/spate.hpp"

#include <gtest/gtest.h>

namespace still_water {

using namespace spate;

constexpr double H = 0.9, L = 2.2 * H, g = 1, rho0 = 1000; // height and length of the water [m], ...
const double c0 = 10 * std::sqrt(g * H), unit = std::sqrt(H / g), sound = 4 * H / c0; // longest period of sound [s]
const Tait eos{.rho0 = rho0, .c0 = c0};

/// Pressure and depth of water at rest; p(depth) as in the validation plan, V19.
inline double pressure_at(double depth) { return eos.pressure_of(eos.hydrostatic_density(g * std::max(0.0, depth))); }
inline double depth_of(double p) { return eos.enthalpy_of(eos.density_of(p)) / g; }
const double surface = depth_of(rho0 * g * H); // of the water once it has given way under its own weight

template <int Dim>
Vec<Dim, double> point(double x, double y, double z)
{
    if constexpr (Dim == 3) return {x, y, z};
    else return {x, z};
}
template <int Dim>
constexpr double length = Dim == 3 ? H : L; // of the tank along [m]
constexpr double across = 0.4 * H;          // of the tank in 3D [m]

/// \param n  spacings in the height of the water
template <class Kernel, class Wall = Adami, class Diffusion = DensityDiffusion>
auto still(int n, double smoothing, Diffusion diffusion = {.delta = 0.1}, Wall wall = {})
{
    constexpr int dim = Kernel::dim;
    const double dx = H / n;
    auto water = wcsph(Kernel{.h = smoothing * dx}, eos, Continuity<2>{}, diffusion, PressureForce<2>{},
                       ArtificialViscosity{.alpha = 0.02}, Gravity<dim>{point<dim>(0, 0, -g)});
    const Box<dim> tank{{}, point<dim>(length<dim>, across, 1.2 * H)};
    Simulation s(water, RungeKutta2{}, Bce(tank, dx, wall, open(top)), Threads{.count = dim == 3 ? 2 : 1});
    s.fill(Box<dim>{{}, point<dim>(length<dim>, across, H)}, dx, settled);
    return s;
}
/// Takes the first waves of sound out (dynamic relaxation, Cundall & Board 1988; it stands for the ramp of Adami, Hu &
/// Adams): for one unit of time all velocity is dropped every quarter of the longest period.
void calm(auto& s)
{
    for (int k = 1; k <= 10; ++k) {
        s.run({.until = k * sound / 4, .cfl = 0.2});
        for (std::size_t i = 0; i < s.particles().size(); ++i) s.particles().put(velocity, i, {});
    }
}

/// The worst of several instants.
struct Worst {
    double l2 = 0;      // of pressure: sqrt(sum V (p - p_e)^2 / sum V p_e^2) [-]
    double floor = 0;   // of pressure at any point of the floor, over that of the exact profile [-]
    double kinetic = 0; // over rho0 g H^2 L [-]
    double creep = 0;   // of the mean surface [spacings]; it is the highest particle in each strip of two spacings
    double gap = 0;     // of the lowest particle above its place on the lattice [spacings]
    double leaks = 0;

    void of(Worst const& w)
    {
        l2 = std::max(l2, w.l2), floor = std::max(floor, w.floor), kinetic = std::max(kinetic, w.kinetic);
        creep = std::max(creep, w.creep), leaks = std::max(leaks, w.leaks);
        gap = std::max(gap, w.gap);
    }
};
/// Pressure on the floor by the extrapolation of Adami, Hu & Adams (2012, eq. 27), error at the worst point.
template <int Dim>
double floor_error(auto const& s, double dx)
{
    auto const& p = s.particles();
    auto const& kernel = s.physics().interaction.kernel;
    double worst = 0;
    for (double x = dx / 2; x < length<Dim>; x += dx) {
        double sum = 0, seen = 0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const auto at = p.at(position, i);
            const double q = std::sqrt((at - point<Dim>(x, across / 2, 0)).squaredNorm()) / kernel.h;
            if (q >= kernel.radius) continue;
            sum += (p.at(pressure, i) + p.at(density, i) * g * at[Dim - 1]) * kernel.f(q), seen += kernel.f(q);
        }
        worst = std::max(worst, std::abs(sum / seen / pressure_at(surface) - 1));
    }
    return worst;
}
template <int Dim>
Worst now(auto& s, double dx)
{
    s.refresh();
    auto const& p = s.particles();
    double error = 0, norm = 0, top = 0, lowest = H;
    std::vector<double> highest(std::size_t(std::lround(length<Dim> / dx / 2)));
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double z = p.at(position, i)[Dim - 1], V = p.at(mass, i) / p.at(density, i);
        const double p_e = pressure_at(surface - z), e = p.at(pressure, i) - p_e;
        error += V * e * e, norm += V * p_e * p_e;
        const double strip = p.at(position, i)[0] / length<Dim> * double(highest.size());
        double& above = highest[std::size_t(std::clamp(strip, 0.0, double(highest.size()) - 1))];
        above = std::max(above, z), lowest = std::min(lowest, z);
    }
    for (double z : highest) top += z / double(highest.size());
    const double weight_length = H * H * length<Dim> * (Dim == 3 ? across : 1);
    return {.l2 = std::sqrt(error / norm),
            .floor = floor_error<Dim>(s, dx),
            .kinetic = s.energy().kinetic / (rho0 * g * weight_length),
            .creep = std::abs(top - (surface - depth_of(rho0 * g * dx / 2))) / dx,
            .gap = lowest / dx - 0.5,
            .leaks = Leaks{dx}(s)};
}
/// Runs on and looks eight times in each period of sound.
Worst watch(auto& s, double dx, double periods)
{
    const double start = s.time();
    Worst w;
    for (int k = 1; k <= int(8 * periods); ++k) {
        s.run({.until = start + k * sound / 8, .cfl = 0.2});
        w.of(now<std::remove_cvref_t<decltype(s)>::dim>(s, dx));
    }
    return w;
}
inline void tell(std::string const& what, Worst const& w)
{
    std::printf("%s: L2 of pressure %.3f %%, floor %.3f %%, kinetic %.1e, creep %.4f dx, gap %.2f dx, leaks %.0f\n",
                what.c_str(), 100 * w.l2, 100 * w.floor, w.kinetic, w.creep, w.gap, w.leaks);
}
/// Particles from everywhere in the box, not two in a line.
void save_profile(std::string const& name, auto& s)
{
    auto file = models::results(name, "z,p,exact");
    auto const& p = s.particles();
    for (std::size_t id = 0; id < p.size(); id += 7)
        for (std::size_t i = 0; i < p.size(); ++i)
            if (p.id()[i] == id)
                file << p.at(position, i)[1] << ',' << p.at(pressure, i) << ','
                     << pressure_at(surface - p.at(position, i)[1]) << '\n';
}

constexpr auto of_pressure = "error of pressure, L2", of_floor = "error of pressure on the floor, worst point",
               of_motion = "kinetic energy over rho0 g H^2 L", of_creep = "creep of the surface [dx]";

// ---- walls of every state; a dynamic boundary has a gate of its own
template <class Wall>
class StillWaterOn : public ::testing::Test {
protected:
    static constexpr double gate = std::same_as<Wall, ByContinuity> ? 0.02 : 0.01;
    static models::Case named(std::string const& scene, int n) { return {"V19", scene + ", " + Wall::name, n}; }
    static void expect(models::Case const& c, Worst const& w, double l2)
    {
        c.at_most(of_pressure, w.l2, l2);
        c.at_most(of_motion, w.kinetic, 1e-6);
        c.at_most(of_creep, w.creep, 0.5);
        EXPECT_LE(w.gap, 1.5 * 1.2);
        EXPECT_EQ(w.leaks, 0);
    }
    static std::string name(std::string const& what) { return what + ", " + Wall::name; }
};
using States = ::testing::Types<Adami, Extrapolated, ByContinuity>;

} // namespace still_water
