// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A column of water twice as high as wide falls in 2D: its front against Martin & Moyce (1952), numerics V25, figure
/// W5; the scene and the parameters of tests/models/dam_break.cpp. n is H/dx; time in T = t sqrt(2 g/a).
#pragma once

#include "family.hpp"
#include "models/series.hpp"

namespace work_precision {

/// Table 2 of Martin & Moyce: Z = x/a over T.
inline models::Series const& martin_moyce()
{
    static const auto data = models::column_of("martin_moyce_1952_n2_2_front.csv", "T", "Z", 3.4);
    return data;
}

/// The front over T, at even times.
struct FrontOverTime {
    double dx, a, g, next = 0;
    models::Series front{};

    void begin(auto& scene) { step(scene); }
    void step(auto& scene)
    {
        const double now = scene.time() * std::sqrt(2 * g / a);
        if (now < next) return;
        next = now + 0.02;
        front.add(now, Front{dx}(scene) / a);
    }
    void end(auto&) {}
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
        FrontOverTime recorder{dx, a, g};
        auto judge = [&](auto& dam) {
            auto const& r = dam.report();
            auto const& front = recorder.front;
            auto const& data = martin_moyce();
            const double unshifted = models::relative_error(models::shifted(front, data, 0), data);
            std::vector<std::pair<std::string, double>> found{{"front", models::best_shift(front, data).error},
                                                              {"front_unshifted", unshifted},
                                                              {"density", r.density_change},
                                                              {"energy_rise", r.energy_rise}};
            for (double t : data.t) found.emplace_back("Z_at_" + text(t), front.at(t));
            return found;
        };
        return measured<I>(s, {.until = s.until * std::sqrt(a / (2 * g)), .cfl = s.cfl}, make, judge, recorder);
    };
    const std::string formulation = "sigma" + std::to_string(sigma) + "+diffusion+" + Wall::name;
    families().push_back({"dam_break", kernel, h_dx, formulation, I::name, precision_name<Precision>(), run});
}

} // namespace work_precision
