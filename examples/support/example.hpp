// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What every example has around its scene: the frame, and the outputs and the summary of a scene.
#pragma once

#include <filesystem>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <vector>

#include <spate/io/history.hpp>
#include <spate/io/progress.hpp>
#include <spate/measure/front.hpp>
#include <spate/measure/gauge.hpp>
#include <spate/measure/leaks.hpp>
#include <spate/measure/probe.hpp>
#include <spate/measure/wall_force.hpp>

#include "support/checkpoints.hpp"
#include "support/composition.hpp"
#include "support/frame.hpp"
#include "support/interrupt.hpp"
#include "support/passive.hpp"
#include "support/pictures.hpp"
#include "support/same_words.hpp"
#include "support/snapshots.hpp"
#include "support/summary.hpp"

namespace example {

/// `Example example("name", "about", {.until = 0.9}); return example.main(argc, argv, [&] { ...; example.run(scene); });`
class Example : public Frame {
public:
    using Frame::Frame;

    int main(int argc, char** argv, std::function<void()> const& scene)
    {
        if constexpr (!many)
            return Frame::main(
                argc, argv, [] {}, scene);
        else {
            wait_passively(argv); // it may start the program again: before MPI
            bool met = false;
            auto meet = [&] {
                const auto ranks = spate::ranks_of(scene::Backend{});
                met = true, speaks_ = ranks.rank() == 0;
                require_same_words(ranks, argc, argv);
            };
            const int code = Frame::main(argc, argv, meet, scene);
            if (met) spate::ranks_of(scene::Backend{}).leave(code);
            return code;
        }
    }
    /// Runs a scene to its end with history (its columns the given measures), snapshots, pictures and summary.
    template <class Scene, class... Measure>
    [[gnu::cold]] void run(Scene& scene, Measure... measure)
    {
        const std::filesystem::path directory = options_.output;
        spate::io::History history(directory, options_.history_every, measure...);
        Pictures pictures(directory, name_, options_.picture_every, options_.colour);
        spate::require_non_negative("every", options_.every, "s");
        spate::RunOptions how{.until = options_.until, .steps = options_.steps, .cfl = options_.cfl, .dt = options_.dt};
        scene.check(how);
        const auto ranks = spate::party_of(scene);
        if constexpr (many)
            spate::require(options_.ranks == 0 || options_.ranks == ranks.count(), "ranks", options_.ranks,
                           "0, or " + std::to_string(ranks.count()) + ", as many as have been started");
        options_.quiet = options_.quiet || !speaks_;
        spate::by_one(ranks, [&] { require_writable(directory); });
        Snapshots snapshots(Series(directory, name_), options_.every);
        Summary& summary = summary_;
        summary.energy_start = scene.energy().total();
        Checkpoints<decltype(history), Snapshots, Pictures, Summary> checkpoints(
            {directory, keep_every(options_.checkpoint_every)}, history, snapshots, pictures, summary);
        Talk talk{.quiet = options_.quiet, .speaks = speaks_};
        if (!options_.restart.empty()) checkpoints.restart(scene, options_.restart);
        how.steps = std::max(std::int64_t(0), options_.steps - scene.steps());
        about(scene);
        spate::io::Progress progress(options_.until, how.steps, spate::io::Progress::usual(options_.quiet));
        scene.interrupt_when([] { return interrupt() != 0; });

        summary.files = {history.file().filename(), name_ + ".hdf.series", name_ + "_*.hdf",
                         pictures.file().filename()};
        talk.opening(summary);
        if (!options_.restart.empty()) talk.going_on(options_.restart, scene.steps(), scene.time());
        try {
            scene.run(how, history, snapshots, pictures, talk, progress, checkpoints);
            if (const int signal = ranks.all(interrupt(), spate::agree::Most{}); signal != 0)
                interrupted(summary, signal, scene.steps(), scene.time(), checkpoints.last());
        }
        catch (...) {
            ended_early(); // or it goes on
        }
        if (!checkpoints.last().empty()) summary.files.emplace_back("checkpoint_*.h5");
        finish(summary, scene);
        if (code_ != 3) (measured(summary, scene, measure), ...);
        ended(summary, talk, directory, pictures.file());
    }

private:
    static constexpr bool many = !decltype(spate::ranks_of(scene::Backend{}))::alone;

    template <class Scene>
    [[gnu::cold]] static void about_species(Scene const& scene, Summary& s)
    {
        using M = typename Scene::Engine::M;
        constexpr bool fluid = spate::has_equation_of_state<std::remove_cvref_t<decltype(scene.physics())>>;
        scene.system().each_species([&](auto k) {
            Words words;
            for (auto name : spate::names(M::template stored<k()>())) words.emplace_back(name);
            s.add_species(k() != 0 ? "wall"
                          : fluid  ? "fluid"
                                   : "grain",
                          scene.system().template total_of<k()>(), words);
        });
    }
    template <class Scene>
    [[gnu::cold]] void about(Scene const& sim)
    {
        using Engine = typename Scene::Engine;
        auto name = []<class T>(T const&) { return type_name(typeid(T).name()); };
        Summary& s = summary_;
        about_species(sim, s);
        s.scene = name_;
        s.add_choice("dimensions", std::to_string(Scene::dim));
        s.add_choice("interaction", name(sim.physics().interaction));
        s.add_choice("integrator", sim.integrator().name);
        s.add_choice("boundary", name(sim.system().boundary()));
        s.add_choice("backend", sim.system().backend().name);
        s.add_choice("precision", type_name(typeid(typename Engine::T).name()));
        s.add_choice("pack", std::to_string(spate::width<typename Engine::V>));
        s.add_choice("cell", std::to_string(options_.cell));
        if constexpr (Engine::species_count == 2) s.add_choice("walls", scene::wall_text);
        std::apply([&](auto const&... t) { (s.terms.push_back(name(t)), ...); }, sim.system().terms());
        s.threads = sim.system().backend().threads();
        s.ranks = sim.system().ranks().count();
        s.seed = options_.seed;
    }
    /// The columns that history.csv ends with.
    template <class Scene, class Measure>
    [[gnu::cold]] static void measured(Summary& s, Scene& scene, Measure& measure)
    {
        if constexpr (requires { measure.begin(); }) {
            for (auto& one : measure) measured(s, scene, one);
        }
        else {
            const auto value = measure(scene);
            const auto names = spate::io::detail::headings(measure.name, value);
            if constexpr (std::is_arithmetic_v<decltype(measure(scene))>)
                s.measures.emplace_back(names[0], double(value));
            else
                for (std::size_t c = 0; c < names.size(); ++c) s.measures.emplace_back(names[c], value[int(c)]);
        }
    }
    template <class Scene>
    [[gnu::cold]] static void finish(Summary& s, Scene const& scene)
    {
        auto const& r = scene.report();
        s.steps = scene.steps(), s.time = scene.time();
        s.force_evaluations = scene.system().evaluations(), s.pairs = scene.system().pairs_evaluated();
        s.wall = r.wall, s.cpu = r.cpu,
        s.bytes = scene.system().ranks().all(scene.system().bytes(), spate::agree::Sum{});
        s.mach = r.mach, s.density_change = r.density_change;
        s.energy_end = scene.energy().total(), s.energy_reference = r.energy_reference;
        s.state_hash = scene.state_hash();
        s.warnings = r.warnings;
    }
};

} // namespace example
