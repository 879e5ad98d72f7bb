// SPDX-License-Identifier: BSD-3-Clause
// Terms of a fluid through the engine: what they do to whole scenes, by exact sums and by laws.
#include "oracle/dice.hpp"

#include <spate/spate.hpp>

#include <gtest/gtest.h>

namespace {
using namespace spate;
constexpr double dx = 0.02, rho0 = 1000, c0 = 20;
constexpr Tait tait{.rho0 = rho0, .c0 = c0};

/// A periodic box of n^2 particles, each displaced by up to `jitter` spacings, with velocities up to 1 m/s at random.
template <class... T>
auto box(CubicSpline<2> kernel, double jitter, T... term)
{
    constexpr int n = 24;
    const Box<2> b{{0, 0}, {n * dx, n * dx}};
    Simulation sim(wcsph(kernel, term...), RungeKutta2{}, Periodic(b));
    oracle::Dice dice(4);
    sim.fill(b, dx, [&](auto& p, std::size_t i) {
        auto x = p.at(position, i), v = x;
        for (int c = 0; c < 2; ++c) x[c] += dx * dice.real(-jitter, jitter), v[c] = dice.real(-1, 1);
        p.put(position, i, x);
        p.put(velocity, i, v);
    });
    return sim;
}

// ---- density as a sum

TEST(SummationDensity, OfALatticeIsTheKnownSum) // kernel_lattice_constants.csv, cubic, 2D, h/dx = 1.2
{
    auto sim = box({}, 0, tait, SummationDensity{}, PressureForce<2>{});
    sim.refresh();
    auto const& p = sim.particles();
    for (std::size_t i = 0; i < p.size(); ++i)
        EXPECT_NEAR(p.at(density, i) / rho0 - 1, -2.4269326777e-04, 1e-12); // the table has eleven digits
}
/// Densities by id, of particles moved by t v.
std::vector<double> densities_after(double t)
{
    auto sim = box({}, 0.2, tait, SummationDensity{}, PressureForce<2>{});
    auto& p = sim.particles();
    for (std::size_t i = 0; i < p.size(); ++i) p.put(position, i, p.at(position, i) + t * p.at(velocity, i));
    sim.prepare();
    sim.refresh();
    std::vector<double> rho(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) rho[p.id()[i]] = p.at(density, i);
    return rho;
}
TEST(SummationDensity, HasContinuityAsItsTimeDerivative) // numerics A.3.3: of sigma = 2, not of sigma = 1
{
    constexpr double t = 1e-6; // the quotient is off by rho''' t^2/6 ~ rho (v t/dx)^2/t, and by 1e-16 rho/t of rounding
    const auto before = densities_after(-t), after = densities_after(t);
    auto error = [&](auto continuity) {
        auto sim = box({}, 0.2, tait, continuity, PressureForce<2>{});
        auto& p = sim.particles();
        sim.system().rebuild();
        oracle::Dice dice(7);
        for (std::size_t i = 0; i < p.size(); ++i) p.put(density, i, rho0 * dice.real(0.95, 1.05));
        sim.system().rates(sim.system().all);
        double worst = 0, size = 0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const double quotient = (after[p.id()[i]] - before[p.id()[i]]) / (2 * t);
            worst = std::max(worst, std::abs(p.at(density_rate, i) - quotient));
            size = std::max(size, std::abs(quotient));
        }
        return worst / size;
    };
    EXPECT_LE(error(Continuity<2>{}), 1e-7);
    EXPECT_GT(error(Continuity<1>{}), 1e-3);
}
TEST(SummationDensity, HoldsEnergyToTheOrderOfTheIntegrator) // with sigma = 2 it is a Hamiltonian system
{
    auto drift = [](double dt) {
        auto sim = box({}, 0.05, tait, SummationDensity{}, PressureForce<2>{});
        auto run = Simulation(sim.physics(), Leapfrog{}, sim.system().boundary());
        for (std::size_t i = 0; i < sim.particles().size(); ++i)
            run.add(sim.particles().at(position, i), 0.1 * sim.particles().at(velocity, i));
        run.particles().value(mass) = sim.particles().value(mass);
        run.refresh();
        const double start = run.energy().total();
        double worst = 0;
        while (run.time() < 0.01) {
            run.step({.dt = dt});
            worst = std::max(worst, std::abs(run.energy().total() / start - 1));
        }
        return worst;
    };
    const double coarse = drift(2e-4), fine = drift(1e-4);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3) << coarse << " " << fine;
}
TEST(SummationDensity, CountsWallMarkersAsFluid)
{
    Simulation sim(wcsph(CubicSpline<2>{}, tait, SummationDensity{}, PressureForce<2>{}), RungeKutta2{},
                   Bce(Box<2>{{0, 0}, {0.2, 0.2}}, dx, Adami{}, open(top)));
    sim.fill(Box<2>{{0, 0}, {0.2, 0.2}}, dx);
    sim.refresh();
    auto const& p = sim.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double depth = 0.2 - p.at(position, i)[1];
        if (depth > 2.4 * dx) {
            EXPECT_NEAR(p.at(density, i) / rho0 - 1, -2.4269326777e-04, 1e-12) << "as inside";
        }
        if (depth < dx) {
            EXPECT_LT(p.at(density, i) / rho0, 0.8) << "the surface has no upper half";
        }
    }
}

// ---- viscosity by species

template <class... T>
auto channel(T... viscosity)
{
    Simulation sim(wcsph(CubicSpline<2>{}, tait, Continuity<2>{}, viscosity...), RungeKutta2{},
                   Bce(Box<2>{{0, 0}, {0.32, 0.2}}, dx, Adami{}, periodic(x_axis)));
    sim.fill(Box<2>{{0, 0}, {0.32, 0.2}}, dx, [](auto& p, std::size_t i) { p.put(velocity, i, {1, 0}); });
    sim.system().rebuild();
    sim.system().rates(sim.system().all);
    return sim;
}
TEST(SpeciesViscosity, OfBothRolesIsLaminarViscosity)
{
    const auto whole = channel(LaminarViscosity{.mu = 1});
    const auto parts = channel(SpeciesViscosity<Role::mobile>{.mu = 1}, SpeciesViscosity<Role::marker>{.mu = 1});
    auto const &a = whole.particles(), &b = parts.particles();
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a.at(acceleration, i)[0]));
    EXPECT_GT(largest, 0);
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(a.at(acceleration, i)[0], b.at(acceleration, i)[0], 1e-13 * largest);
}
TEST(SpeciesViscosity, OfTheFluidAloneSlidesAlongWalls)
{
    const auto slip = channel(SpeciesViscosity<Role::mobile>{.mu = 1});
    const auto rough = channel(SpeciesViscosity<Role::marker>{.mu = 1});
    const auto rougher = channel(SpeciesViscosity<Role::marker>{.mu = 3});
    auto const &p = slip.particles(), &q = rough.particles(), &r = rougher.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        EXPECT_EQ(p.at(acceleration, i), (Vec<2, double>{})) << "a plug flow feels no wall";
        const double y = q.at(position, i)[1], a = q.at(acceleration, i)[0];
        EXPECT_EQ(a < 0, std::min(y, 0.2 - y) < 1.9 * dx) << "the walls reach so far";
        EXPECT_LE(a, 0);
        EXPECT_NEAR(r.at(acceleration, i)[0], 3 * a, 1e-13 * std::abs(a));
    }
}

} // namespace
