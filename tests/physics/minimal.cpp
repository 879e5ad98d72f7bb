// SPDX-License-Identifier: BSD-3-Clause
// What users write themselves does what it says: a field with its rate, an integrator, a boundary and a backend, each the
// smallest that the concepts allow, against exact solutions of the discrete equations.
#include "smallest.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace smallest;

constexpr double pi = std::numbers::pi;

/// A spring to the origin: dv/dt = -omega^2 x.
struct Tether {
    static constexpr Fields reads{position};
    static constexpr Fields adds{acceleration};
    double omega; // [1/s]
    void operator()(auto& i) const { i[acceleration] -= omega * omega * i[position]; }
};

} // namespace

// On a lattice at rest a wave of temperature is an eigenvector: each midpoint step multiplies it by 1 - z + z^2/2,
// z = lambda dt, lambda = -sum_j 2 a V x_j W'(x_j) / (x_j^2 + 0.01 h^2) (1 - cos k x_j).
TEST(OwnField, HeatInARingDecaysByTheDiscreteRate)
{
    constexpr int n = 32, steps = 200;
    constexpr double dx = 1.0 / n, a = 0.1, k = 2 * pi, dt = 2e-3;
    const CubicSpline<1> kernel{.h = 1.2 * dx};
    Simulation ring(physics(Smoothing<CubicSpline<1>>{kernel}, Uniform{mass, 1000 * dx}, Uniform{density, 1000.0},
                            HeatConduction{a}),
                    RungeKutta2{}, Periodic(Box<1>{{0}, {1}}));
    ring.fill(Box<1>{{0}, {1}}, dx,
              [&](auto& p, std::size_t i) { p.put(temperature, i, 300 + std::sin(k * p.at(position, i)[0])); });
    ring.run({.steps = steps, .dt = dt});

    double lambda = 0;
    for (int j = -3; j <= 3; ++j) {
        const double x = j * dx, r2 = x * x, h2 = kernel.h * kernel.h;
        const double x_grad = kernel.sigma() / h2 * kernel.g(std::abs(x) / kernel.h) * r2;
        lambda -= 2 * a * dx * x_grad / (r2 + 0.01 * h2) * (1 - std::cos(k * x));
    }
    const double z = lambda * dt, left = std::pow(1 - z + z * z / 2, steps);
    EXPECT_LT(left, 0.3);                             // it did decay
    EXPECT_NEAR(lambda, a * k * k, 0.05 * a * k * k); // and about as heat does
    auto const& p = ring.particles();
    for (std::size_t i = 0; i < p.size(); ++i)
        EXPECT_NEAR(p.at(temperature, i), 300 + left * std::sin(k * p.at(position, i)[0]), 300 * 1e-14 * steps);
}

// v^2 + omega^2 x^2 + omega^2 dt x v is what drift, then kick, conserves exactly.
TEST(OwnIntegrator, ConservesItsModifiedEnergy)
{
    constexpr double omega = 2, dt = 0.1;
    Simulation pendulum(physics(Smoothing<CubicSpline<2>>{{.h = 0.1}}, Tether{omega}), DriftKick{}, Open{}, Serial{},
                        Double{}, NoWatch{}); // the watch does not know the tether's potential
    pendulum.add({1, 0}, {0, 0.5});
    auto energy = [&] {
        const auto x = pendulum.particles().at(position, 0), v = pendulum.particles().at(velocity, 0);
        return v.squaredNorm() + omega * omega * x.squaredNorm() + omega * omega * dt * x.dot(v);
    };
    const double start = energy();
    pendulum.run({.steps = 1000, .dt = dt});
    EXPECT_NEAR(energy() / start, 1, 1e-12);
    EXPECT_GT(std::abs(pendulum.particles().at(position, 0)[0] - 1), 1e-3); // it moved
}

// Who runs a task, and when, changes no bit.
TEST(OwnBoundaryAndBackend, ChangeNoBit)
{
    auto hash = [](auto boundary, auto backend) {
        Simulation drop(wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{},
                              PressureForce<2>{}, ArtificialViscosity{.alpha = 0.1}),
                        RungeKutta2{}, boundary, backend);
        drop.fill(Box<2>{{-0.3, -0.1}, {0.3, 0.1}}, 0.01, [](auto& p, std::size_t i) {
            const auto x = p.at(position, i);
            p.put(velocity, i, {-10 * x[0], 10 * x[1]});
        });
        drop.run({.steps = 50});
        EXPECT_GT(drop.system().rebuilds(), 1);
        EXPECT_GT(drop.system().template species<0>().bins.cells(), 4u);
        return drop.state_hash();
    };
    EXPECT_EQ(hash(Nowhere{}, Backwards{.cell = 2}), hash(Open{}, Serial{.cell = 2}));
}
