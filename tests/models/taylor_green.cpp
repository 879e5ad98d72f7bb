// SPDX-License-Identifier: BSD-3-Clause
// The decay of vortices in a periodic box (Taylor & Green 1937) at Re = 100: numerics V15.
#include "models/internal_flow.hpp"
#include "models/results.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace {

using namespace spate;
using At = Vec<2, double>;

constexpr double U = 1, nu = 0.01, k = 2 * std::numbers::pi, b = -2 * nu * k * k; // L = 1 m, Re = 100
At exact(At const& x, double t)
{
    const double u = U * std::exp(b * t);
    return {-u * std::cos(k * x[0]) * std::sin(k * x[1]), u * std::sin(k * x[0]) * std::cos(k * x[1])};
}
struct Errors {
    double velocity = 0, rate = 0; ///< L1 over that of the solution; of the rate of decay [-]
};
/// Errors at t = 1. \param jitter  of the start [spacings]
Errors after(int n, double jitter)
{
    const double dx = 1.0 / n, c0 = 10 * U;
    const Box<2> box{{0, 0}, {1, 1}};
    Simulation s(models::internal_flow(dx, 1, nu, U), SymplecticEuler{}, Periodic(box));
    std::mt19937_64 dice(1);
    auto draw = [&] { return (double(dice() >> 11) * 0x1p-52 - 1) * jitter * dx; };
    s.fill(box, dx, [&](auto& p, std::size_t i) {
        At x = p.at(position, i);
        for (int c = 0; c < 2; ++c) x[c] += draw();
        p.put(position, i, x);
        p.put(velocity, i, exact(x, 0));
        p.put(density, i, 1 - U * U / (4 * c0 * c0) * (std::cos(2 * k * x[0]) + std::cos(2 * k * x[1])));
    });
    const double start = s.energy().kinetic;
    auto file =
        models::results("taylor_green_" + std::to_string(n) + (jitter > 0 ? "_jittered.csv" : ".csv"), "t,speed,exact");
    for (double t : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
        s.run({.until = t});
        file << s.time() << ',' << std::sqrt(s.energy().kinetic / start) << ',' << std::exp(b * s.time()) << '\n';
    }
    auto const& p = s.particles();
    double e = 0, size = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const At u = exact(p.at(position, i), s.time());
        e += std::sqrt((p.at(velocity, i) - u).squaredNorm()), size += std::sqrt(u.squaredNorm());
    }
    const double empty = models::emptiest(s, box, dx);
    EXPECT_LT(empty, 1); // without shifting there are voids at the stagnation points
    const Errors r{e / size, std::log(s.energy().kinetic / start) / (2 * b * s.time()) - 1};
    std::printf("n %d jitter %.1f: L1 of velocity %.4f, rate of decay %+.4f, emptiest %.3f dx\n", n, jitter, r.velocity,
                r.rate, empty);
    return r;
}
// L1 <= 5 % at 50^2, order >= 1 over 25, 50, 100.
TEST(TaylorGreen, DecaysFromALattice) { EXPECT_LE(after(50, 0).velocity, 0.05); }
TEST(TaylorGreen, DecaysFromAJitteredLattice) { EXPECT_LE(after(50, 0.2).velocity, 0.05); }
TEST(LongTaylorGreen, ConvergesFromALattice)
{
    EXPECT_GE(models::order(after(25, 0).velocity, after(100, 0).velocity), 1);
}
TEST(LongTaylorGreen, ConvergesFromAJitteredLattice)
{
    EXPECT_GE(models::order(after(25, 0.2).velocity, after(100, 0.2).velocity), 1);
}

} // namespace
