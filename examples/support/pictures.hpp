// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Pictures of a run: particles to scale, coloured by speed or by pressure, wall markers as a ghost.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <spate/core/together.hpp>
#include <spate/io/ball.hpp>
#include <spate/io/detail/every.hpp>
#include <spate/physics/wcsph.hpp>

namespace example {

/// An output of Simulation::run: NAME.png of the last state and, if asked for, NAME_000001.png, ... on the way.
class Pictures {
public:
    Pictures(std::filesystem::path directory, std::string name, double every, std::string const& colour);
    void begin(auto& scene) { step(scene); }
    void step(auto& scene)
    {
        if (interval_ <= 0 || !every_.due(scene.time())) return;
        if (by_pressure_) scene.refresh();
        draw(scene, numbered());
    }
    [[gnu::cold]] void end(auto& scene)
    {
        if (by_pressure_) scene.refresh();
        draw(scene, file());
    }
    [[nodiscard]] std::filesystem::path file() const;
    /// What a restart needs: f(name, number).
    [[gnu::cold]] void notes(auto const& f)
    {
        every_.notes("pictures", f);
        f("pictures_count", count_);
    }

private:
    /// The ball that a particle fills: a grain's own radius, else that of the volume m/rho0.
    template <class Scene>
    [[gnu::cold]] static double radius_of(Scene const& scene, auto const& p, std::size_t i)
    {
        using P = std::remove_cvref_t<decltype(p)>;
        using Physics = std::remove_cvref_t<decltype(scene.physics())>;
        constexpr int dim = Scene::dim;
        if constexpr (P::template has<spate::Radius>) return p.at(spate::radius, i);
        else if constexpr (spate::has_equation_of_state<Physics> && P::template has<spate::Mass>) {
            const double volume = p.at(spate::mass, i) / spate::equation_of_state(scene.physics()).rho0;
            constexpr std::array unit{2.0, std::numbers::pi, 4 * std::numbers::pi / 3};
            return std::pow(volume / unit[std::size_t(dim - 1)], 1.0 / dim);
        }
        else return scene.physics().interaction.range() / 4;
    }
    template <class Scene>
    [[gnu::cold]] std::vector<spate::io::Ball> balls_of(Scene const& scene) const
    {
        std::vector<spate::io::Ball> balls;
        scene.system().each_species([&](auto s) {
            auto const& p = scene.system().template species<s()>().particles;
            for (std::size_t i = 0; i < p.size(); ++i) {
                spate::io::Ball ball{{0, 0, 0}, float(radius_of(scene, p, i)), 0, s() != 0};
                const auto x = p.at(spate::position, i);
                for (int c = 0; c < Scene::dim; ++c) ball.x[c] = float(x[c]);
                if constexpr (s() == 0) ball.value = float(std::sqrt(p.at(spate::velocity, i).squaredNorm()));
                if constexpr (s() == 0 && std::remove_cvref_t<decltype(p)>::template has<spate::Pressure>)
                    if (by_pressure_) ball.value = float(p.at(spate::pressure, i));
                balls.push_back(ball);
            }
        });
        return gathered(spate::party_of(scene), std::move(balls));
    }
    template <class Scene>
    [[gnu::cold]] void draw(Scene const& scene, std::filesystem::path const& file) const
    {
        double fastest = spate::io::Picture::automatic; // [m/s]
        if constexpr (spate::has_equation_of_state<std::remove_cvref_t<decltype(scene.physics())>>)
            fastest = spate::equation_of_state(scene.physics()).c0 / 10; // the flow that c0 was chosen for
        const auto balls = balls_of(scene);
        spate::by_one(spate::party_of(scene), [&] { write(file, scene.time(), Scene::dim, fastest, balls); });
    }
    /// NAME_000001.png, ...
    std::filesystem::path numbered();
    /// io::write_png, compiled once for all compositions.
    void write(std::filesystem::path const& file, double time, int dim, double fastest,
               std::vector<spate::io::Ball> const& balls) const;

    std::filesystem::path directory_;
    std::string name_;
    double interval_; ///< [s]
    spate::io::detail::Every every_;
    bool by_pressure_;
    int count_ = 0;
};

} // namespace example
