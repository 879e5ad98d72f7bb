// SPDX-License-Identifier: BSD-3-Clause
// X16: a million steps of a dam break and of a drop: nothing runs away, leaks or grows. The box of grains is
// tests/models/elastic_box.cpp.
#include "models/known_gap.hpp"
#include "models/results.hpp"

#include "spate/measure/leaks.hpp"
#include "spate/spate.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

namespace {

using namespace spate;
using Point = Vec<2, double>;

constexpr int looks = 100, steps = 10000; // of each look
/// A leak of one byte a step is 900,000 bytes from the tenth look on; lists that grow with the flow stay below a quarter.
constexpr double flat = 256 * 1024;

/// Memory of this process that is resident [bytes].
double memory()
{
    std::ifstream statm("/proc/self/statm");
    double pages = 0, resident = 0;
    statm >> pages >> resident;
    return resident * double(sysconf(_SC_PAGESIZE));
}
/// What has become of a run, over all looks.
struct Drift {
    double energy = -1;                ///< largest rise over that of the start
    double later = -1;                 ///< ... over that of a tenth of the looks
    double sunk = 0;                   ///< loss of potential energy since then
    double volume = 0, volume_end = 0; ///< sum m/rho over what it should be, less 1: furthest from 0, and the last one
    double momentum = 0;               ///< largest [kg m/s]
    double early = 0, late = 0;        ///< memory after a tenth of the looks, and at the end [bytes]
};
/// \param energy  of the scene [J]
/// \param rest  the volume that the fluid has at rest [m^2]
template <class S>
Drift run(S& sim, std::string const& name, RunOptions o, double rest, auto const& energy)
{
    auto table = models::results(name + ".csv", "step,t,energy,kinetic,volume,momentum_x,momentum_y,memory");
    const double start = energy();
    Drift d;
    double calm = 0, high = 0;
    o.steps = steps;
    for (int k = 1; k <= looks; ++k) {
        sim.run(o);
        const Point p = sim.momentum();
        d.energy = std::max(d.energy, energy() / start - 1);
        d.volume_end = sim.volume() / rest - 1;
        if (std::abs(d.volume_end) > std::abs(d.volume)) d.volume = d.volume_end;
        d.momentum = std::max(d.momentum, std::sqrt(p.squaredNorm()));
        d.late = memory();
        if (k == looks / 10) d.early = d.late, calm = energy(), high = sim.energy().potential;
        if (k > looks / 10) d.later = std::max(d.later, energy() / calm - 1);
        d.sunk = 1 - sim.energy().potential / high;
        table << sim.steps() << ',' << sim.time() << ',' << energy() / start << ',' << sim.energy().kinetic / start
              << ',' << sim.volume() / rest << ',' << p[0] << ',' << p[1] << ',' << d.late << std::endl;
    }
    std::printf(
        "%s, %lld steps to t = %.4g s: energy over the start by at most %+.3g, over that of a tenth %+.3g, volume off by %+.3g at most "
        "and %+.3g at the end, |momentum| %.3g kg m/s at most, memory %+.0f bytes\n",
        name.c_str(), static_cast<long long>(sim.steps()), sim.time(), d.energy, d.later, d.volume, d.volume_end,
        d.momentum, d.late - d.early);
    EXPECT_EQ(sim.steps(), looks * std::int64_t(steps));
    EXPECT_LT(d.late - d.early, flat);
    return d;
}

/// The scene of the README in two dimensions, 20 particles to its height: it breaks, sloshes and comes to rest.
TEST(LongMillionSteps, OfADamBreak)
{
    constexpr double H = 0.6, dx = H / 20, g = 9.81;
    const double c0 = 10 * std::sqrt(2 * g * H);
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = c0}, Continuity<2>{},
                       DensityDiffusion{.delta = 0.1}, PressureForce<2>{}, ArtificialViscosity{.alpha = 0.02},
                       Gravity<2>{{0, -g}});
    Bce tank(Box<2>{{0, 0}, {4 * H, 2 * H}}, dx, Adami{.suction = false}, open(top));
    Simulation dam(water, RungeKutta2{}, tank, Serial{});
    dam.fill(Box<2>{{0, 0}, {H / 2, H}}, dx, hydrostatic);
    // Water at rest, H/8 deep, is pressed by rho0 g depth/2 on average.
    const double depth = H / 8, volume = H / 2 * H * (1 - g * depth / 2 / (c0 * c0));
    const Drift d = run(dam, "million_dam_break", {.cfl = 0.2}, volume, [&] { return dam.energy().total(); });
    EXPECT_LE(d.energy, 0); // its walls are at rest
    EXPECT_LE(d.later, Watch{}.warn);
    EXPECT_LE(std::abs(d.volume_end), 1e-3); // X16
    EXPECT_EQ(Leaks{dx}(dam), 0);
    models::known_gap("X16 sinking of water at rest", d.sunk); // of the volume that the particles take up
}
/// A pull to the origin, of the potential B^2 r^2 / 2 a unit mass.
struct Pull {
    static constexpr Fields reads{position};
    static constexpr Fields adds{acceleration};
    double B; // [1/s]
    void operator()(auto& i) const { i[acceleration] += (-B * B) * i[position]; }
};
/// A drop that is held together by a pull and swings between two ellipses, without a wall.
TEST(LongMillionSteps, OfADrop)
{
    constexpr int n = 10;
    constexpr double R = 1, dx = R / n, rho0 = 1000, B = 1, A0 = 0.3 * B; // [m], [kg/m^3], [1/s]
    const Tait eos{.rho0 = rho0, .c0 = 15 * R * B};
    auto water = wcsph(CubicSpline<2>{.h = 1.3 * dx}, eos, Continuity<2>{}, DensityDiffusion{.delta = 0.1},
                       PressureForce<2>{}, ArtificialViscosity{.alpha = 0.02}, Pull{B});
    Simulation drop(water, Leapfrog{}, Open{}, Serial{});
    auto start = [&](auto& p, std::size_t i) {
        const Point x = p.at(position, i);
        p.put(velocity, i, Point{A0 * x[0], -A0 * x[1]});
        p.put(density, i, eos.density_of(0.5 * rho0 * B * B * (R * R - x.squaredNorm())));
    };
    drop.fill(Box<2>{{0, 0}, {dx, dx}}, dx, start); // one particle; the others are added, since a disc is no box
    for (int i = -n; i < n; ++i)
        for (int j = -n; j < n; ++j) {
            const Point x{(i + 0.5) * dx, (j + 0.5) * dx};
            if (x.squaredNorm() > R * R || (i == 0 && j == 0)) continue;
            start(drop.particles(), drop.add(x));
        }
    drop.prepare();
    auto energy = [&] {
        auto const& p = drop.particles();
        double pulled = 0;
        for (std::size_t i = 0; i < p.size(); ++i)
            pulled += p.at(mass, i) * B * B / 2 * p.at(position, i).squaredNorm();
        return drop.energy().total() + pulled;
    };
    const auto& p = drop.particles();
    double scale = 0; // sum m |v|
    for (std::size_t i = 0; i < p.size(); ++i) scale += p.at(mass, i) * std::sqrt(p.at(velocity, i).squaredNorm());
    const Drift d = run(drop, "million_drop", {.cfl = 0.25}, drop.volume(), energy);
    EXPECT_LE(d.energy, 1e-3);               // of leapfrog's swing; what is lost is dissipated
    EXPECT_LE(std::abs(d.volume_end), 1e-3); // X16
    EXPECT_LE(d.momentum, 1e-10 * std::sqrt(double(p.size())) * scale);
    double far = 0;
    for (std::size_t i = 0; i < p.size(); ++i) far = std::max(far, std::sqrt(p.at(position, i).squaredNorm()));
    EXPECT_LE(far, 1.5 * R); // nobody has left: an ellipse of the start's energy reaches 1.24 R
}

} // namespace
