// SPDX-License-Identifier: BSD-3-Clause
// A minimal fluid from the headers that it names, and no others: viscosity, diffusion, gravity, walls, images, watch do not
// exist here. check.sh also compiles it after the whole of spate and compares instructions and bits.
#include <spate/backend/serial.hpp>
#include <spate/boundary/open.hpp>
#include <spate/integrator/runge_kutta2.hpp>
#include <spate/kernel/cubic_spline.hpp>
#include <spate/physics/measures.hpp>
#include <spate/physics/physics.hpp>
#include <spate/physics/smoothing.hpp>
#include <spate/physics/sph/continuity.hpp>
#include <spate/physics/sph/pressure_force.hpp>
#include <spate/physics/sph/tait.hpp>

#include <cstdio>

using namespace spate;

int main()
{
    constexpr int n = 10;
    constexpr double dx = 0.01, c0 = 20;
    const auto water = physics(Smoothing<CubicSpline<3>>{{.h = 1.2 * dx}}, Uniform{mass, 1000 * dx * dx * dx},
                               Tait{.rho0 = 1000, .c0 = c0}, Continuity<2>{}, PressureForce<2>{});
    System<std::remove_cv_t<decltype(water)>, Open, Serial, Double> s(water, Open{}, Serial{}, Neighbours{},
                                                                      RungeKutta2::saves);
    auto& p = s.mobile();
    p.resize(n * n * n);
    for (int i = 0; i < n * n * n; ++i) {
        const Vec<3, double> x{{(i % n) * dx, (i / n % n) * dx, (i / n / n) * dx}};
        p.put(position, std::size_t(i), x);
        p.put(velocity, std::size_t(i), {{x[1], -x[2], 2 * x[0]}});
        p.put(density, std::size_t(i), 1000 + x[0]);
    }
    const Neighbours bins{};
    s.use(Grid<3>({{{0, 0, 0}}, {{0, 0, 0}}}, Edges<3>(Edge::open), water.interaction.range() * bins.bin_edge(),
                  bins.finer, 4));
    s.resized();
    for (int k = 0; k < 20; ++k) {
        if (k % 5 == 0) s.rebuild();
        RungeKutta2{}.step(s, 0.2 * dx / c0);
    }
    std::printf("%016lx\n", s.state_hash());
}
