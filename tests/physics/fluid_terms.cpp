// SPDX-License-Identifier: BSD-3-Clause
// Terms of a fluid through the engine: what they do to whole scenes, by exact sums and by laws.
#include "extreme/chosen.hpp"
#include "oracle/dice.hpp"
#include "physics/one_of.hpp"

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

/// The terms of sigma = 1 and 2 by themselves: one type of scene for both.
auto continuity(int sigma) { return OneOf<Continuity<1>, Continuity<2>>{{}, sigma - 1}; }
auto pressure_force(int sigma) { return OneOf<PressureForce<1>, PressureForce<2>>{{}, sigma - 1}; }

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
    auto error = [&](int sigma) {
        auto sim = box({}, 0.2, tait, continuity(sigma), pressure_force(2));
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
    EXPECT_LE(error(2), 1e-7);
    EXPECT_GT(error(1), 1e-3);
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
auto by_role(double of_fluid, double of_walls)
{
    return channel(SpeciesViscosity<Role::mobile>{.mu = of_fluid}, SpeciesViscosity<Role::marker>{.mu = of_walls});
}
TEST(SpeciesViscosity, OfBothRolesIsLaminarViscosity)
{
    const auto whole = channel(LaminarViscosity{.mu = 1});
    const auto parts = by_role(1, 1);
    auto const &a = whole.particles(), &b = parts.particles();
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a.at(acceleration, i)[0]));
    EXPECT_GT(largest, 0);
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(a.at(acceleration, i)[0], b.at(acceleration, i)[0], 1e-13 * largest);
}
TEST(SpeciesViscosity, OfTheFluidAloneSlidesAlongWalls)
{
    const auto slip = by_role(1, 0);
    const auto rough = by_role(0, 1);
    const auto rougher = by_role(0, 3);
    auto const &p = slip.particles(), &q = rough.particles(), &r = rougher.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        EXPECT_EQ(p.at(acceleration, i), (Vec<2, double>{})) << "a plug flow feels no wall";
        const double y = q.at(position, i)[1], a = q.at(acceleration, i)[0];
        EXPECT_EQ(a < 0, std::min(y, 0.2 - y) < 1.9 * dx) << "the walls reach so far";
        EXPECT_LE(a, 0);
        EXPECT_NEAR(r.at(acceleration, i)[0], 3 * a, 1e-13 * std::abs(a));
    }
}

// ---- the sigma family

TEST(Power, IsThatOfLibmToItsRoundings)
{
    for (double s : {-4.0, -1.5, -0.5, 0.0, 0.5, 1.0, 1.7, 4.0})
        for (double x = 1e-3; x < 1e3; x *= 1.017) {
            // roots 1.9 u, times s; a logarithm of 5 u, times s; the exponential 3 u; all times 16, and 15 u of squares
            const double u = 1.1e-16,
                         allowed = u * (16 * (1.9 * std::abs(s) + 5 * std::abs(s * std::log(x)) / 16 + 3) + 15);
            EXPECT_NEAR(detail::power_of(x, s) / std::pow(x, s), 1, allowed) << x << "^" << s;
        }
    EXPECT_EQ(detail::power_of(1.0, 1.5), 1);
    EXPECT_EQ(detail::power_of(7.0, 0), 1);
    const Pack<double> packed = detail::power_of(Pack<double>(1.03), -0.5);
    EXPECT_EQ(largest(packed), detail::power_of(1.03, -0.5));
}

/// Rates of a jittered box with 5 % noise of density.
template <class... T>
auto noisy(double noise, double jitter, T... term)
{
    auto sim = box({}, jitter, tait, term...);
    auto& p = sim.particles();
    sim.system().rebuild();
    oracle::Dice dice(7);
    for (std::size_t i = 0; i < p.size(); ++i) p.put(density, i, rho0 * (1 + noise * dice.real(-1, 1)));
    sim.system().rates(sim.system().all);
    return sim;
}
/// Largest difference of accelerations and of density rates, each over the largest.
double difference(auto const& a, auto const& b)
{
    auto const& p = a.particles();
    auto const& q = b.particles();
    double da = 0, sa = 0, dr = 0, sr = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        da = std::max(da, std::sqrt((p.at(acceleration, i) - q.at(acceleration, i)).squaredNorm()));
        sa = std::max(sa, std::sqrt(p.at(acceleration, i).squaredNorm()));
        dr = std::max(dr, std::abs(p.at(density_rate, i) - q.at(density_rate, i)));
        sr = std::max(sr, std::abs(p.at(density_rate, i)));
    }
    EXPECT_GT(sa, 0);
    EXPECT_GT(sr, 0);
    return std::max(da / sa, dr / sr);
}
TEST(Sigma, OfOneAndTwoIsThatOfTheirOwnTerms)
{
    const auto one = noisy(0.05, 0.2, continuity(1), pressure_force(1));
    const auto two = noisy(0.05, 0.2, continuity(2), pressure_force(2));
    EXPECT_LE(difference(one, noisy(0.05, 0.2, SigmaContinuity{1}, SigmaPressure{1})), 1e-13);
    EXPECT_LE(difference(two, noisy(0.05, 0.2, SigmaContinuity{2}, SigmaPressure{2})), 1e-13);
    EXPECT_GT(difference(one, two), 1e-3);
}
TEST(Sigma, OfOneAndAHalfIsTheSumOverAllPairs)
{
    constexpr double sigma = 1.5, L = 24 * dx;
    const auto sim = noisy(0.05, 0.2, SigmaContinuity{sigma}, SigmaPressure{sigma});
    auto const& p = sim.particles();
    auto const& kernel = sim.physics().interaction.kernel;
    double da = 0, sa = 0, dr = 0, sr = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        double rate = 0;
        Vec<2, double> a{};
        for (std::size_t j = 0; j < p.size(); ++j) {
            auto x = p.at(position, i) - p.at(position, j);
            for (int c = 0; c < 2; ++c) x[c] -= L * std::round(x[c] / L);
            const double q = std::sqrt(x.squaredNorm()) / kernel.h, m = p.at(mass, j);
            const Vec<2, double> grad_w = kernel.sigma() / (kernel.h * kernel.h) * kernel.g(q) * x;
            const double rho_i = p.at(density, i), rho_j = p.at(density, j);
            rate += m * (p.at(velocity, i) - p.at(velocity, j)).dot(grad_w) /
                    (std::pow(rho_i, sigma - 2) * std::pow(rho_j, 2 - sigma));
            a -= m *
                 (p.at(pressure, i) / (std::pow(rho_i, sigma) * std::pow(rho_j, 2 - sigma)) +
                  p.at(pressure, j) / (std::pow(rho_i, 2 - sigma) * std::pow(rho_j, sigma))) *
                 grad_w;
        }
        da = std::max(da, std::sqrt((p.at(acceleration, i) - a).squaredNorm()));
        sa = std::max(sa, std::sqrt(a.squaredNorm()));
        dr = std::max(dr, std::abs(p.at(density_rate, i) - rate));
        sr = std::max(sr, std::abs(rate));
    }
    EXPECT_LE(da / sa, 1e-13);
    EXPECT_LE(dr / sr, 1e-13);
}
TEST(Sigma, DoesNotChangeSoundOnALattice) // numerics A.3.4: to first order in the amplitude
{
    constexpr double amplitude = 1e-6;
    const auto two = noisy(amplitude, 0, continuity(2), pressure_force(2));
    EXPECT_LE(difference(two, noisy(amplitude, 0, SigmaContinuity{1.5}, SigmaPressure{1.5})), 10 * amplitude);
    EXPECT_LE(difference(two, noisy(amplitude, 0, SigmaContinuity{-0.7}, SigmaPressure{-0.7})), 10 * amplitude);
}
TEST(Sigma, ActsOnWallsAsItsOwnTermsDo)
{
    auto tank = [](auto... term) {
        Simulation sim(wcsph(CubicSpline<2>{}, tait, Gravity<2>{{0, -9.81}}, term...), RungeKutta2{},
                       Bce(Box<2>{{0, 0}, {0.2, 0.2}}, dx, Adami{}, open(top)));
        sim.fill(Box<2>{{0, 0}, {0.2, 0.2}}, dx, [](auto& p, std::size_t i) {
            p.put(density, i, rho0 * (1.02 - 0.1 * p.at(position, i)[1]));
            p.put(velocity, i, {0, -1});
        });
        sim.system().rebuild();
        sim.system().rates(sim.system().all);
        return sim;
    };
    EXPECT_LE(difference(tank(Continuity<1>{}, PressureForce<1>{}), tank(SigmaContinuity{1}, SigmaPressure{1})), 1e-13);
}

// ---- XSPH

/// Two particles that pass each other: after a step, and at a time by steps of dt.
auto two_particles(int integrator)
{
    chosen::integrator = integrator;
    Simulation sim(physics(Smoothing<WendlandC2<2>>{{.h = 1}}, Uniform{mass, 2}, Uniform{density, 4}, Xsph{.eps = 0.5}),
                   chosen::AnyIntegrator{}, Open{});
    sim.add({0.6, 0.8}, {1, 2});
    sim.add({0, 0}, {-1, 1});
    sim.prepare();
    return sim;
}
TEST(Xsph, MovesParticlesByHand) // r = 1: W = 7/(4 pi) 3/16
{
    auto sim = two_particles(chosen::forward_euler);
    constexpr double dt = 0.01;
    sim.step({.dt = dt});
    const double k = 0.5 * (2.0 / 4) * 7 / (4 * std::numbers::pi) * 3 / 16;
    auto const& p = sim.particles();
    for (std::size_t i = 0; i < 2; ++i) {
        const bool first = p.id()[i] == 0;
        const double sign = first ? 1 : -1; // v_j - v_i = -+(2, 1)
        EXPECT_NEAR(p.at(position, i)[0], (first ? 0.6 : 0) + dt * (sign - sign * k * 2), 1e-15);
        EXPECT_NEAR(p.at(position, i)[1], (first ? 0.8 : 0) + dt * ((first ? 2 : 1) - sign * k * 1), 1e-15);
        EXPECT_EQ(p.at(velocity, i), (first ? Vec<2, double>{{1, 2}} : Vec<2, double>{{-1, 1}})) << "only positions";
    }
}
/// Distance along x at t = 0.4 in n steps.
double apart(int integrator, int n)
{
    auto sim = two_particles(integrator);
    for (int k = 0; k < n; ++k) sim.step({.dt = 0.4 / n});
    return std::abs(sim.particles().at(position, 0)[0] - sim.particles().at(position, 1)[0]);
}
double order(int integrator)
{
    const double a = apart(integrator, 20), b = apart(integrator, 40), c = apart(integrator, 80);
    return std::log2((a - b) / (b - c));
}
TEST(Xsph, IsIntegratedByEachIntegrator)
{
    EXPECT_NEAR(order(chosen::forward_euler), 1, 0.1);
    EXPECT_NEAR(order(chosen::symplectic_euler), 1, 0.1);
    EXPECT_NEAR(order(chosen::runge_kutta2), 2, 0.1);
    EXPECT_NEAR(order(chosen::leapfrog), 1, 0.1)
        << "time_integration.md: a driven position drifts by its rate at the start";
}

// ---- density made anew

template <int Dim, class How>
auto cluster(DensityReinit<How> reinit, auto const& rho)
{
    const int n = Dim == 2 ? 16 : 8;
    Simulation sim(wcsph(CubicSpline<Dim>{}, tait, Continuity<2>{}, reinit), RungeKutta2{}, Open{});
    oracle::Dice dice(11);
    Box<Dim> b{};
    for (int c = 0; c < Dim; ++c) b.hi[c] = n * dx;
    sim.fill(b, dx, [&](auto& p, std::size_t i) {
        auto x = p.at(position, i);
        for (int c = 0; c < Dim; ++c) x[c] += dx * dice.real(-0.2, 0.2);
        p.put(position, i, x);
        p.put(density, i, rho(x));
    });
    sim.system().rebuild();
    sim.system().template phase<When::after_step>(0, [] {});
    return sim;
}
/// Largest error of density, relative.
double error(auto const& sim, auto const& rho)
{
    auto const& p = sim.particles();
    double worst = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
        worst = std::max(worst, std::abs(p.at(density, i) / rho(p.at(position, i)) - 1));
    return worst;
}
template <int Dim>
void expect_exact()
{
    auto constant = [](auto const&) { return 987.6; };
    auto linear = [](auto const& x) { // varies by a third over the cluster
        double rho = 1000;
        for (int c = 0; c < Dim; ++c) rho += (c == 1 ? -500 : 700) * x[c];
        return rho;
    };
    EXPECT_LE(error(cluster<Dim>(DensityReinit<Shepard>{}, constant), constant), 1e-14);
    EXPECT_GT(error(cluster<Dim>(DensityReinit<Shepard>{}, linear), linear), 1e-4);
    EXPECT_LE(error(cluster<Dim>(DensityReinit<Mls>{}, constant), constant), 1e-12);
    EXPECT_LE(error(cluster<Dim>(DensityReinit<Mls>{}, linear), linear), 1e-12);
}
TEST(DensityReinit, IsExactOnAnyParticlesAtTheirSurfaceToo) // numerics V03
{
    expect_exact<1>();
    expect_exact<2>();
    expect_exact<3>();
}
TEST(DensityReinit, ByMlsFallsBackToShepardWhereNeighboursLieInALine)
{
    auto row = [](auto reinit) {
        Simulation sim(wcsph(CubicSpline<2>{.h = 1.2 * dx}, tait, Continuity<2>{}, reinit), RungeKutta2{}, Open{});
        for (int k = 0; k < 6; ++k) {
            sim.add({0.6 * k * dx, 0.8 * k * dx});
            sim.particles().put(density, std::size_t(k), 1000 + k * k);
        }
        sim.add({9, 9}); // alone
        sim.particles().put(density, 6, 1234);
        sim.particles().value(mass) = rho0 * dx * dx;
        sim.prepare();
        sim.system().rebuild();
        sim.system().template phase<When::after_step>(0, [] {});
        return sim;
    };
    const auto mls = row(DensityReinit<Mls>{});
    const auto shepard = row(DensityReinit<Shepard>{});
    auto const& p = mls.particles();
    auto const& q = shepard.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        EXPECT_EQ(p.at(density, i), q.at(density, i));
        if (p.id()[i] == 6) {
            EXPECT_NEAR(p.at(density, i), 1234, 1234 * 1e-15);
        }
        if (p.id()[i] == 2) {
            EXPECT_GT(p.at(density, i), 1004) << "an average of squares";
        }
    }
}
TEST(DensityReinit, ComesAfterItsSteps)
{
    Simulation sim(wcsph(CubicSpline<2>{}, tait, Continuity<2>{}, DensityReinit<Shepard>{.every = 3}), RungeKutta2{},
                   Open{});
    sim.fill(Box<2>{{0, 0}, {10 * dx, 10 * dx}}, dx, [](auto& p, std::size_t i) {
        p.put(density, i, 1000 + 1000 * p.at(position, i)[0]); // at rest: only a reinit changes it
    });
    auto of_one = [&] { return sim.particles().at(density, 37); };
    double last = of_one();
    for (int step = 0; step < 7; ++step) {
        sim.step({.dt = 1e-6});
        EXPECT_EQ(of_one() != last, step % 3 == 0) << step;
        last = of_one();
    }
    EXPECT_THROW(
        Simulation(wcsph(CubicSpline<2>{.h = 0.1}, tait, DensityReinit<Mls>{.every = 0}), RungeKutta2{}, Open{}),
        BadInput);
}

// ---- shifting

/// Displacements by id after one shift of particles at rest.
template <class S>
std::vector<Vec<2, double>> shifts(S shifting, double jitter, auto boundary)
{
    Simulation sim(wcsph(CubicSpline<2>{}, tait, shifting), RungeKutta2{}, boundary);
    oracle::Dice dice(21);
    sim.fill(Box<2>{{0, 0}, {24 * dx, 24 * dx}}, dx, [&](auto& p, std::size_t i) {
        auto x = p.at(position, i);
        for (int c = 0; c < 2; ++c) x[c] += dx * dice.real(-jitter, jitter);
        p.put(position, i, x);
    });
    auto& p = sim.particles();
    sim.system().rebuild();
    std::vector<Vec<2, double>> before(p.size()), moved(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) before[i] = p.at(position, i);
    sim.system().template phase<When::after_step>(0, [] {});
    for (std::size_t i = 0; i < p.size(); ++i) moved[p.id()[i]] = p.at(position, i) - before[i];
    return moved;
}
const Periodic whole(Box<2>{{0, 0}, {24 * dx, 24 * dx}});
double length(Vec<2, double> const& a) { return std::sqrt(a.squaredNorm()); }

TEST(Shifting, LeavesALatticeAlone)
{
    for (auto const& d : shifts(Shifting{.mach = 0.1}, 0, whole)) EXPECT_LE(length(d), 1e-14 * dx);
}
TEST(Shifting, LeavesTheCentreOfMassWhereItIs)
{
    Vec<2, double> sum{};
    double size = 0;
    for (auto const& d : shifts(Shifting{.mach = 0.01}, 0.2, whole)) sum += d, size += length(d);
    EXPECT_GT(size / 576, 1e-4 * dx);
    EXPECT_LE(length(sum) / size, 1e-13) << "positions are rounded at 1e-16 of the box";
}
TEST(Shifting, IsNeverLongerThanItsShareOfTheSpacing)
{
    double longest = 0;
    for (auto const& d : shifts(Shifting{.mach = 10}, 0.2, whole)) longest = std::max(longest, length(d));
    EXPECT_NEAR(longest / dx, 0.05, 1e-12);
}
TEST(Shifting, EvensOutWhatIsCrowded)
{
    Simulation sim(wcsph(CubicSpline<2>{}, tait, SummationDensity{}, Shifting{.mach = 0.1}), RungeKutta2{}, whole);
    oracle::Dice dice(21);
    sim.fill(Box<2>{{0, 0}, {24 * dx, 24 * dx}}, dx, [&](auto& p, std::size_t i) {
        auto x = p.at(position, i);
        for (int c = 0; c < 2; ++c) x[c] += dx * dice.real(-0.2, 0.2);
        p.put(position, i, x);
    });
    auto spread = [&] { // rms of density about rho0: no pressure force, so only the shift moves anything
        sim.refresh();
        auto const& p = sim.particles();
        double sum = 0;
        for (std::size_t i = 0; i < p.size(); ++i) sum += std::pow(p.at(density, i) / rho0 - 1, 2);
        return std::sqrt(sum / double(p.size()));
    };
    const double before = spread();
    sim.run({.steps = 50, .dt = 1e-5});
    EXPECT_LT(spread(), 0.5 * before);
}
TEST(Shifting, AtASurfaceKeepsToIt)
{
    const auto free = shifts(SurfaceShifting{.mach = 0.1}, 0, Open{});
    const auto bare = shifts(Shifting{.mach = 0.1}, 0, Open{});
    for (std::size_t k = 0; k < free.size(); ++k) {
        const int a = int(k % 24),
                  b = int(k / 24); // edges of a square: normals along the axes, on its diagonals between
        const bool left_or_right = a == 0 || a == 23, ends = b == 0 || b == 23;
        if (left_or_right && b > 2 && b < 21) { // out of a corner's reach
            EXPECT_LE(std::abs(free[k][0]), 1e-15) << k;
            EXPECT_GT(std::abs(bare[k][0]), 0.01 * dx) << "without the surface it leaves";
        }
        if (left_or_right && ends) {
            EXPECT_LE(length(free[k]), 1e-15) << "a corner has no along";
        }
        if (a > 3 && a < 20 && b > 3 && b < 20) {
            EXPECT_EQ(free[k], bare[k]) << "inside the two are one";
        }
    }
}

} // namespace
