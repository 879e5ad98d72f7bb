// SPDX-License-Identifier: BSD-3-Clause
// Flow through a round pipe, driven by a force, for ten times of viscosity: numerics V14 in 3D. The wall is all but a
// cylinder, of markers on the lattice.
#include "models/case.hpp"
#include "models/internal_flow.hpp"

#include "spate/measure/leaks.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;
using At = Vec<3, double>;

constexpr int n = 12; // spacings across
constexpr double D = 1e-3, R = D / 2, dx = D / n, length = 8 * dx, nu = 1e-6, rho0 = 1000, V0 = 1.25e-5,
                 F = 4 * nu * V0 / (R * R);

struct State {
    double drift = 0, middle = 0, empty = 0;
};
/// Mean density over rho0 less 1; fastest velocity over V0; the largest distance of a point in the pipe from a particle
/// [spacings]: at most 0.87 on the lattice.
State state(auto const& s)
{
    auto const& p = s.particles();
    State now;
    for (std::size_t i = 0; i < p.size(); ++i) {
        now.drift += (p.at(density, i) / rho0 - 1) / double(p.size());
        now.middle = std::max(now.middle, p.at(velocity, i)[0] / V0);
    }
    double most = 0;
    for (double x = 0; x < length; x += dx / 2)
        for (double y = dx / 4; y < D; y += dx / 2)
            for (double z = dx / 4; z < D; z += dx / 2) {
                if (std::hypot(y - R, z - R) > R - dx / 2) continue;
                double least = D * D;
                for (std::size_t i = 0; i < p.size(); ++i) {
                    const auto d = nearest_image(At{x, y, z} - p.at(position, i), s.system().grid());
                    least = std::min(least, d.squaredNorm());
                }
                most = std::max(most, least);
            }
    now.empty = std::sqrt(most) / dx;
    std::printf("t = %g: density %+.2e, fastest %.5f V0, emptiest %.3f dx\n", s.time(), now.drift, now.middle,
                now.empty);
    return now;
}

TEST(LongPipe, IsSteadyAfterTenTimesOfViscosity)
{
    const models::Case c("V14", "round pipe, Re = 0.0125, 10 D^2/nu", n);
    const Box<3> box{{0, 0, 0}, {length, D, D}};
    const Cylinder bore{.foot = {-length, R, R}, .radius = R, .height = 3 * length, .axis = 0};
    Simulation s(models::internal_flow<3>(dx, rho0, nu, V0, Gravity<3>{{F, 0, 0}}), SymplecticEuler{},
                 Bce(box, dx, Adami{}, periodic(x_axis), no_slip, obstacle(inside_out(bore))));
    s.fill(box, dx);
    s.run({.until = 9 * D * D / nu});
    const State before = state(s);
    s.run({.until = 10 * D * D / nu});
    const State after = state(s);
    EXPECT_NEAR(after.middle, before.middle, 1e-3);
    c.at_most("emptiest place [dx]", after.empty, 1);
    c.at_most("drift of density", std::abs(after.drift), 1e-4);
    EXPECT_EQ(Leaks{dx}(s), 0);
    s.refresh();
    const double weight = double(s.particles().size()) * rho0 * dx * dx * dx * F;
    std::printf("force on the wall over that on the fluid: %.5f\n", WallForce{}(s)[0] / weight);
    c.at_most("force on the wall, off by", std::abs(WallForce{}(s)[0] / weight - 1), 0.01);
}

} // namespace
