// SPDX-License-Identifier: BSD-3-Clause
// A user's project: a kernel and a term that the library does not have, in a drop that flies and stretches.
// Pairs only exchange momentum, so the drop's is that of the start; friction takes energy, so it only falls.
#include <spate/spate.hpp>

#include <cstdio>

using namespace spate;

/// W = 4/(pi h^2) (1 - q^2)^3 in the plane (Mueller et al. 2003, "poly6").
struct Poly6 {
    static constexpr int dim = 2;
    static constexpr double radius = 1;
    double h; ///< smoothing length [m], which is the support too

    double sigma() const { return 4 / (3.14159265358979323846 * h * h); }
    template <class V>
    static V f(V const& q)
    {
        const V t = max(1 - q * q, V(0));
        return t * t * t;
    }
    template <class V>
    static V g(V const& q)
    {
        const V t = max(1 - q * q, V(0));
        return -6 * (t * t);
    }
};

/// dv_i/dt = k sum_j m_j (v_j - v_i) W_ij / rho_i rho_j
struct MutualDrag {
    static constexpr Fields reads{velocity, density};
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{acceleration};
    double k; ///< [kg/(m^3 s)]
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        i[acceleration] += (k * j[mass] * ij.w / (i[density] * j[density])) * (j[velocity] - i[velocity]);
    }
};

int main()
{
    constexpr double dx = 0.01, R = 0.1;
    Simulation drop(wcsph(Poly6{.h = 2.6 * dx}, Tait{.rho0 = 1000, .c0 = 20}, Continuity<2>{}, PressureForce<2>{},
                          MutualDrag{.k = 5e3}),
                    RungeKutta2{}, Open{}, Threads{2});
    drop.fill(Box<2>{{-R, -R}, {R, R}}, dx, [](auto& p, std::size_t i) {
        const auto x = p.at(position, i);
        p.put(velocity, i, {1 - 5 * x[0], 5 * x[1]});
    });
    const double m = drop.particles().at(mass, 0), n = double(drop.particles().size());
    const auto start = drop.momentum();
    const double energy = drop.energy().total();
    drop.run({.steps = 300});

    const auto end = drop.momentum();
    const double lost = (energy - drop.energy().total()) / energy, flown = n * m * drop.time();
    double centre = 0;
    for (std::size_t i = 0; i < drop.particles().size(); ++i) centre += m * drop.particles().at(position, i)[0];
    const double off = std::abs(end[0] - start[0]) + std::abs(end[1] - start[1]);
    std::printf("t %g s: momentum off by %.1e, centre by %.1e, energy lost %.3g\n", drop.time(), off / (n * m),
                std::abs(centre - flown) / flown, lost);
    const bool conserved = off < 1e-12 * n * m && std::abs(centre - flown) < 1e-12 * flown;
    const bool dissipated = lost > 0.003 && lost<0.2, pressed = drop.energy().internal> 0;
    return conserved && dissipated && pressed ? 0 : 1;
}
