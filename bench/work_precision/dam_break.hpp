// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A column of water twice as high as wide falls in 2D: its front against Martin & Moyce (1952), numerics V25, figure
/// W5; the scene and the parameters of tests/models/dam_break.cpp. n is H/dx; time in T = t sqrt(2 g/a).
#pragma once

#include "family.hpp"

#include <array>
#include <cmath>

namespace work_precision {

/// Martin & Moyce (1952), Table 2: T and Z = x/a to T = 3.4, as in tests/data/martin_moyce_1952_n2_2_front.csv.
inline constexpr std::array<std::array<double, 2>, 15> martin_moyce{{
    {0.41, 1.11},
    {0.84, 1.22},
    {1.19, 1.44},
    {1.43, 1.67},
    {1.63, 1.89},
    {1.83, 2.11},
    {1.98, 2.33},
    {2.2, 2.56},
    {2.32, 2.78},
    {2.51, 3},
    {2.65, 3.22},
    {2.83, 3.44},
    {2.98, 3.67},
    {3.11, 3.89},
    {3.33, 4.11},
}};

/// The front over T, at even times.
struct FrontOverTime {
    double dx, a, g, next = 0;
    std::vector<double> T, Z;

    void begin(auto& scene) { step(scene); }
    void step(auto& scene)
    {
        const double now = scene.time() * std::sqrt(2 * g / a);
        if (now < next) return;
        next = now + 0.02;
        T.push_back(now), Z.push_back(Front{dx}(scene) / a);
    }
    void end(auto&) {}
    [[nodiscard]] double at(double time) const // linear between points
    {
        const auto n = std::ptrdiff_t(T.size());
        const auto k =
            std::size_t(std::clamp(std::upper_bound(T.begin(), T.end(), time) - T.begin(), std::ptrdiff_t(1), n - 1));
        return Z[k - 1] + (Z[k] - Z[k - 1]) * (time - T[k - 1]) / (T[k] - T[k - 1]);
    }
    /// rms of Z/Z_data - 1, the gate late by a shift.
    [[nodiscard]] double error(double shift) const
    {
        double sum = 0;
        for (auto const& [t, z] : martin_moyce) sum += std::pow(at(t - shift) / z - 1, 2);
        return std::sqrt(sum / double(martin_moyce.size()));
    }
    [[nodiscard]] double least_error() const
    {
        double least = error(0.05);
        for (double shift = 0.05; shift < 0.3005; shift += 0.001) least = std::min(least, error(shift));
        return least;
    }
};

template <int sigma, class K, class I, class Precision, class Wall>
void add_dam(std::string const& kernel, double h_dx, Wall wall)
{
    auto run = [=](Setting const& s) {
        const double a = s.length / 2, H = s.length, g = 9.81, dx = H / s.n, c0 = s.sound * std::sqrt(2 * g * H);
        auto make = [&] {
            const auto water = wcsph(K{.h = h_dx * dx}, Tait{.rho0 = 1000, .c0 = c0}, Continuity<sigma>{},
                                     DensityDiffusion{.delta = 0.1}, PressureForce<sigma>{},
                                     ArtificialViscosity{.alpha = 0.02}, Gravity<2>{{0, -g}});
            Simulation dam(water, I{}, Bce(Box<2>{{0, 0}, {4 * H, 2 * H}}, dx, wall, open(top)),
                           Threads{s.threads, s.cell}, Precision{}, Watch{}, lists_of(s, water.interaction.neighbours));
            dam.fill(Box<2>{{0, 0}, {a, H}}, dx, hydrostatic);
            return dam;
        };
        FrontOverTime front{dx, a, g, 0, {}, {}};
        auto judge = [&](auto& dam) {
            auto const& r = dam.report();
            std::vector<std::pair<std::string, double>> found{{"front", front.least_error()},
                                                              {"front_unshifted", front.error(0)},
                                                              {"density", r.density_change},
                                                              {"energy_rise", r.energy_rise}};
            for (auto const& row : martin_moyce) found.emplace_back("Z_at_" + text(row[0]), front.at(row[0]));
            return found;
        };
        return measured<I>(s, {.until = s.until * std::sqrt(a / (2 * g)), .cfl = s.cfl}, make, judge, front);
    };
    const std::string formulation = "sigma" + std::to_string(sigma) + "+diffusion+" + Wall::name;
    families().push_back({"dam_break", kernel, h_dx, formulation, I::name, precision_name<Precision>(), run});
}

} // namespace work_precision
