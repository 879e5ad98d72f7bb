// SPDX-License-Identifier: BSD-3-Clause
// Still water against the exact profile of the compressible fluid (Adami, Hu & Adams 2012, section 6: H = 0.9 m,
// g = 1 m/s^2, c0 = 10 sqrt(g H)), on walls of every state, in 2D and in 3D: V19 of the validation plan.
#include "models/case.hpp"
#include "models/results.hpp"

#include "spate/measure/leaks.hpp"
#include "spate/spate.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;

constexpr double H = 0.9, L = 2.2 * H, g = 1, rho0 = 1000; // height and length of the water [m], ...
const double c0 = 10 * std::sqrt(g * H), unit = std::sqrt(H / g), sound = 4 * H / c0; // longest period of sound [s]
const Tait eos{.rho0 = rho0, .c0 = c0};

/// Pressure and depth of water at rest; p(depth) as in the validation plan, V19.
double pressure_at(double depth) { return eos.pressure_of(eos.hydrostatic_density(g * std::max(0.0, depth))); }
double depth_of(double p) { return eos.enthalpy_of(eos.density_of(p)) / g; }
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
void tell(std::string const& what, Worst const& w)
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

TEST(StillWater, ProfileIsThatOfTheCompressibleFluid)
{
    // dp/dz = rho g by the midpoint rule, and the excess over rho0 g H that the validation plan states at g H/c0^2 = 0.01
    double p = 0;
    constexpr int steps = 10000;
    for (int k = 0; k < steps; ++k) {
        const double half = p + eos.density_of(p) * g * H / steps / 2;
        p += eos.density_of(half) * g * H / steps;
    }
    EXPECT_NEAR(pressure_at(H) / p, 1, 1e-9);
    EXPECT_NEAR(pressure_at(H) / (rho0 * g * H) - 1, 0.004919, 1e-6);
    EXPECT_NEAR(depth_of(pressure_at(H)), H, 1e-12);
}

/// Adami's markers carry the pressure of their own depth, up to the second order of Taylor's series over their range:
/// p'' = rho g^2/c^2. Those above the surface pull as the line through the fluid says.
TEST(StillWater, WallsBearThePressureOfTheirDepth)
{
    constexpr int n = 25;
    auto s = still<CubicSpline<2>>(n, 1.2);
    s.refresh();
    auto const& wall = s.system().template species<1>().particles;
    const double reach = s.physics().interaction.range();
    const double most = 0.5 * eos.density_of(pressure_at(H + reach)) * std::pow(g * reach / c0, 2);
    int seen = 0;
    for (std::size_t i = 0; i < wall.size(); ++i) {
        if (wall.at(kernel_sum, i) < 1e-3 / std::pow(reach, 2)) continue;
        const double depth = surface - wall.at(position, i)[1];
        EXPECT_NEAR(wall.at(pressure, i), depth > 0 ? pressure_at(depth) : rho0 * g * depth, most) << i;
        ++seen;
    }
    EXPECT_GT(seen, 3 * n);
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
TYPED_TEST_SUITE(StillWaterOn, States);
/// Right after the calm, for two periods of sound.
TYPED_TEST(StillWaterOn, HasTheExactPressure)
{
    constexpr int n = 50;
    const auto c = this->named("2D, two periods of sound", n);
    auto s = still<CubicSpline<2>>(n, 1.2, DensityDiffusion{.delta = 0.1}, TypeParam{});
    calm(s);
    const Worst w = watch(s, H / n, 2);
    tell(this->name("2D, H/dx 50, short"), w);
    this->expect(c, w, this->gate);
    if (std::same_as<TypeParam, ByContinuity>) c.at_most(of_floor, w.floor, 0.01);
    else c.known_gap(of_floor, w.floor, std::string("V19 floor ") + TypeParam::name);
}
/// In 3D with walls on all sides, and a kernel whose gradient is true on its lattice (to 0.06 %; the cubic spline's at 1.2 dx
/// is too small by 1.8 %).
TYPED_TEST(StillWaterOn, HasTheExactPressureIn3D)
{
    constexpr int n = 20;
    const auto c = this->named("3D, Wendland C2, a period of sound", n);
    auto s = still<WendlandC2<3>>(n, 1.5, DensityDiffusion{.delta = 0.1}, TypeParam{});
    calm(s);
    const Worst w = watch(s, H / n, 1);
    tell(this->name("3D, H/dx 20, short"), w);
    this->expect(c, w, this->gate);
    if (std::same_as<TypeParam, Extrapolated>) c.known_gap(of_floor, w.floor, "V19 floor extrapolated 3D");
    else c.at_most(of_floor, w.floor, 0.01);
}
/// The kernel of the other free-surface cases, in 3D.
TEST(StillWater, HasTheExactPressureIn3DWithTheCubicSpline)
{
    constexpr int n = 20;
    const models::Case c("V19", "3D, cubic spline, a period of sound, adami", n);
    auto s = still<CubicSpline<3>>(n, 1.2);
    calm(s);
    const Worst w = watch(s, H / n, 1);
    tell("3D, H/dx 20, cubic spline", w);
    c.at_most(of_creep, w.creep, 0.5);
    EXPECT_EQ(w.leaks, 0);
    c.known_gap(of_pressure, w.l2, "V19 3D cubic spline L2");
    c.known_gap(of_floor, w.floor, "V19 3D cubic spline floor");
    c.known_gap(of_motion, w.kinetic, "V19 3D cubic spline kinetic");
}
template <class Wall>
class LongStillWaterOn : public StillWaterOn<Wall> {};
TYPED_TEST_SUITE(LongStillWaterOn, States);
TYPED_TEST(LongStillWaterOn, HasTheExactPressureIn3D)
{
    constexpr int n = 50;
    const auto c = this->named("3D, Wendland C2, a period of sound", n);
    auto s = still<WendlandC2<3>>(n, 1.5, DensityDiffusion{.delta = 0.1}, TypeParam{});
    calm(s);
    const Worst w = watch(s, H / n, 1);
    tell(this->name("3D, H/dx 50, short"), w);
    this->expect(c, w, this->gate);
    if (std::same_as<TypeParam, Extrapolated>) c.known_gap(of_floor, w.floor, "V19 floor extrapolated 3D H/dx 50");
    else c.at_most(of_floor, w.floor, 0.01);
}
/// The same gates for 20 sqrt(H/g).
TYPED_TEST(LongStillWaterOn, HasTheExactPressureForTwentyUnits)
{
    constexpr int n = 50;
    const auto c = this->named("2D, 20 sqrt(H/g)", n);
    auto s = still<CubicSpline<2>>(n, 1.2, DensityDiffusion{.delta = 0.1}, TypeParam{});
    calm(s);
    auto file = models::results("still_water_50_" + std::string(TypeParam::name) + ".csv",
                                "t_over_unit,l2,floor,kinetic,creep,gap");
    const double start = s.time();
    Worst all;
    for (int k = 1; k <= 20; ++k) {
        s.run({.until = start + k * unit - sound, .cfl = 0.2});
        const Worst w = watch(s, H / n, 1);
        all.of(w);
        file << k << ',' << w.l2 << ',' << w.floor << ',' << w.kinetic << ',' << w.creep << ',' << w.gap << '\n';
    }
    tell(this->name("2D, H/dx 50, 20 units"), all);
    save_profile("still_water_50_profile_" + std::string(TypeParam::name) + ".csv", s);
    this->expect(c, all, this->gate);
    c.known_gap(of_floor, all.floor, std::string("V19 floor 20 units ") + TypeParam::name);
}

/// The floor is a known gap above: the cubic spline at h = 1.2 dx on a lattice has a gradient too small by 0.92 %
/// (kernel_lattice_constants.csv), so that water at rest presses harder by as much. A kernel whose gradient is true there
/// (to 0.09 %) meets the gate of the floor too.
TEST(LongStillWater, HasTheExactPressureOnTheFloorWithWendlandC2)
{
    constexpr int n = 50;
    const models::Case c("V19", "2D, Wendland C2, after 20 sqrt(H/g), adami", n);
    auto s = still<WendlandC2<2>>(n, 2);
    calm(s);
    s.run({.until = s.time() + 20 * unit - sound, .cfl = 0.2});
    const Worst w = watch(s, H / n, 1);
    tell("H/dx 50, Wendland C2, after 20 units", w);
    save_profile("still_water_50_profile_wendland_c2.csv", s);
    c.at_most(of_pressure, w.l2, 0.01);
    c.at_most(of_floor, w.floor, 0.01);
    c.at_most(of_motion, w.kinetic, 1e-6);
    c.at_most(of_creep, w.creep, 0.5);
    EXPECT_EQ(w.leaks, 0);
}

/// Diffusion of the dynamic part of density keeps the surface within half a spacing; of the whole (Molteni & Colagrossi)
/// it does not. V19 asks that the one creeps ten times as far as the other: docs/results/validation.md.
template <class Diffusion>
Worst after_many_steps(Diffusion diffusion)
{
    constexpr int n = 25;
    auto s = still<CubicSpline<2>>(n, 1.2, diffusion);
    calm(s);
    s.run({.steps = 100000, .cfl = 0.2});
    return watch(s, H / n, 1);
}
TEST(LongStillWater, DoesNotCreepIn100000Steps)
{
    const models::Case c("V19", "2D, 1e5 steps", 25);
    const Worst fourtakas = after_many_steps(DensityDiffusion{.delta = 0.1});
    const Worst molteni = after_many_steps(MolteniColagrossi{.delta = 0.1});
    tell("H/dx 25, 100000 steps, Fourtakas", fourtakas);
    tell("H/dx 25, 100000 steps, Molteni & Colagrossi", molteni);
    c.at_most(std::string(of_creep) + ", Fourtakas", fourtakas.creep, 0.5);
    c.at_least(std::string(of_creep) + ", Molteni & Colagrossi", molteni.creep, 0.5);
    EXPECT_EQ(fourtakas.leaks, 0);
    c.known_gap("creep of Fourtakas over a tenth of Molteni", 10 * fourtakas.creep / molteni.creep,
                "V19 creep of Fourtakas over a tenth of Molteni");
}

} // namespace
