// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What every example has around its scene: command line, outputs, summary, exit code.
#pragma once

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <typeinfo>
#include <vector>

#include <spate/io/history.hpp>
#include <spate/io/progress.hpp>
#include <spate/measure/front.hpp>
#include <spate/measure/gauge.hpp>
#include <spate/measure/leaks.hpp>
#include <spate/measure/probe.hpp>
#include <spate/measure/wall_force.hpp>

#include "support/composition.hpp"
#include "support/interrupt.hpp"
#include "support/options.hpp"
#include "support/passive.hpp"
#include "support/pictures.hpp"
#include "support/snapshots.hpp"
#include "support/summary.hpp"

namespace example {

/// `Example example("name", "about", {.until = 0.9}); return example.main(argc, argv, [&] { ...; example.run(scene); });`
class Example {
public:
    Example(std::string name, std::string const& about, Options defaults)
        : name_(std::move(name)), options_(with_output(std::move(defaults), name_)), line_(name_, about, options_)
    {}
    Options const& options() const { return options_; }
    CommandLine& command_line() { return line_; }

    /// 0 ok, 2 bad input, 3 a typed stop, 4 an output could not be written, 128 + signal.
    int main(int argc, char** argv, auto const& scene)
    {
        wait_passively(argv);
        try {
            line_.parse(argc, argv);
            catch_interrupts();
            scene();
            return code_;
        }
        catch (Exit const& e) {
            return e.code;
        }
        catch (spate::OutputError const& e) {
            std::cerr << e.what() << '\n';
            return 4;
        }
        catch (std::invalid_argument const& e) { // BadInput, and what the writers refuse
            std::cerr << e.what() << '\n';
            return 2;
        }
        catch (std::bad_alloc const&) {
            std::cerr << "spate: there is not enough memory for this scene; take a larger spacing\n";
            return 2;
        }
    }

    /// Runs a scene to its end with history (its columns the given measures), snapshots, pictures and summary.
    template <class Scene, class... Measure>
    void run(Scene& scene, Measure... measure)
    {
        const std::filesystem::path directory = options_.output;
        spate::io::History history(directory, options_.history_every, measure...);
        Pictures pictures(directory, name_, options_.picture_every);
        spate::require_non_negative("every", options_.every, "s");
        const spate::RunOptions how{
            .until = options_.until, .steps = options_.steps, .cfl = options_.cfl, .dt = options_.dt};
        scene.check(how);
        require_writable(directory);
        Snapshots snapshots(Series(directory, name_), options_.every);
        Talk talk{.quiet = options_.quiet};
        spate::io::Progress progress(options_.until, options_.steps, spate::io::Progress::usual(options_.quiet));
        scene.interrupt_when([] { return interrupt() != 0; });

        Summary summary = about(scene);
        summary.files = {history.file().filename(), name_ + ".hdf.series", name_ + "_*.hdf",
                         pictures.file().filename()};
        talk.opening(summary);
        summary.energy_start = scene.energy().total();
        const auto file = directory / "summary.json";
        try {
            scene.run(how, history, snapshots, pictures, talk, progress);
            if (interrupt() != 0) interrupted(summary, scene);
        }
        catch (spate::Stop const& e) {
            summary.stop = e.name(), summary.stop_message = e.what(), summary.stop_facts = e.facts();
            code_ = 3;
        }
        catch (spate::OutputError const& e) {
            summary.stop = "OutputError", summary.stop_message = e.what();
            code_ = 4;
        }
        finish(summary, scene);
        if (code_ != 0) std::cerr << summary.stop_message << '\n';
        summary.write(file);
        talk.closing(summary, directory, pictures.file());
    }

private:
    static Options with_output(Options o, std::string const& name)
    {
        if (o.output.empty()) o.output = "out/" + name;
        return o;
    }
    /// Before step 0 a directory that cannot be written in is bad input; later it is an OutputError.
    static void require_writable(std::filesystem::path const& directory)
    {
        try {
            std::error_code error;
            std::filesystem::create_directories(directory, error);
            if (error) throw spate::OutputError(directory, error.value());
            spate::io::detail::Temporary probe(directory / "summary.json");
        }
        catch (spate::OutputError const& e) {
            throw spate::BadInput("output", directory.string(),
                                  std::string("a directory to write in (") + e.what() + ")");
        }
    }
    template <class Scene>
    [[gnu::cold]] static Summary about_species(Scene const& scene, Summary s)
    {
        using M = typename Scene::Engine::M;
        constexpr bool fluid = spate::has_equation_of_state<std::remove_cvref_t<decltype(scene.physics())>>;
        scene.system().each_species([&](auto k) {
            const std::string species = k() != 0 ? "wall" : fluid ? "fluid" : "grain";
            s.particles.emplace_back(species, scene.system().template species<k()>().particles.size());
            Words words;
            for (auto name : spate::names(M::template stored<k()>())) words.emplace_back(name);
            s.fields.emplace_back(species, words);
        });
        return s;
    }
    template <class Scene>
    [[gnu::cold]] Summary about(Scene const& sim) const
    {
        using Engine = typename Scene::Engine;
        auto name = []<class T>(T const&) { return type_name(typeid(T).name()); };
        Summary s = about_species(sim, {});
        s.scene = name_;
        s.composition = {{"dimensions", std::to_string(Scene::dim)},
                         {"interaction", name(sim.physics().interaction)},
                         {"integrator", sim.integrator().name},
                         {"boundary", name(sim.system().boundary())},
                         {"backend", sim.system().backend().name},
                         {"precision", type_name(typeid(typename Engine::T).name())},
                         {"pack", std::to_string(spate::width<typename Engine::V>)},
                         {"cell", std::to_string(options_.cell)}};
        if constexpr (Engine::species_count == 2) s.composition.emplace_back("walls", scene::wall_text);
        std::apply([&](auto const&... t) { (s.terms.push_back(name(t)), ...); }, sim.system().terms());
        s.threads = sim.system().backend().threads();
        s.seed = options_.seed;
        return s;
    }
    void interrupted(Summary& s, auto const& scene)
    {
        s.stop = "Interrupted";
        s.stop_message = std::string("spate: interrupted by ") + (interrupt() == SIGINT ? "SIGINT" : "SIGTERM") +
                         " at step " + std::to_string(scene.steps()) + ", t = " + spate::text(scene.time()) +
                         " s; the last state has been written";
        s.stop_facts.step = scene.steps(), s.stop_facts.time = scene.time();
        code_ = 128 + interrupt();
    }
    template <class Scene>
    [[gnu::cold]] static void finish(Summary& s, Scene const& scene)
    {
        auto const& r = scene.report();
        s.steps = scene.steps(), s.time = scene.time();
        s.force_evaluations = scene.system().evaluations(), s.pairs = scene.system().pairs_evaluated();
        s.wall = r.wall, s.cpu = r.cpu, s.bytes = scene.system().bytes();
        s.mach = r.mach, s.density_change = r.density_change;
        s.energy_end = scene.energy().total(), s.energy_reference = r.energy_reference;
        s.state_hash = scene.state_hash();
        s.warnings = r.warnings;
    }

    /// What is printed on standard output.
    struct Talk {
        bool quiet;
        std::size_t told = 0; ///< warnings

        void opening(Summary const& s) const
        {
            if (quiet) return;
            std::string of;
            for (auto const& [species, count] : s.particles)
                of += (of.empty() ? "" : " + ") + std::to_string(count) + " " + species;
            std::printf("%s: %s = %zu particles\n", s.scene.c_str(), of.c_str(), s.total());
            for (auto const& [role, name] : s.composition) std::printf("  %-12s %s\n", role.c_str(), name.c_str());
            std::printf("  %-12s %d\n", "threads", s.threads);
            std::fflush(stdout);
        }
        void begin(auto const& scene) { warn(scene.report().warnings); }
        void step(auto const& scene)
        {
            if (scene.report().steps == 1 && !quiet) {
                std::printf("dt = %.4g s at the start, by the %s criterion\n", scene.dt(),
                            std::string(scene.criterion()).c_str());
                std::fflush(stdout);
            }
            warn(scene.report().warnings);
        }
        void end(auto const& scene) { warn(scene.report().warnings); }
        /// Warnings are errors in waiting: they are told even to the quiet.
        void warn(std::vector<std::string> const& all)
        {
            for (; told < all.size(); ++told) std::cerr << "warning: " << all[told] << '\n';
        }
        void closing(Summary const& s, std::filesystem::path const& directory,
                     std::filesystem::path const& picture) const
        {
            if (quiet) return;
            std::printf("%s: t = %.4g s after %lld steps in %.1f s", s.stop.c_str(), s.time,
                        static_cast<long long>(s.steps), s.wall);
            if (s.steps > 0)
                std::printf(" (%.1f ns a particle-step, %.2f ns a pair)", s.ns_per_particle_step(), s.ns_per_pair());
            std::printf("\n");
            if (s.mach > 0)
                std::printf("largest Mach number %.3f, largest density change %.2f %%\n", s.mach,
                            100 * s.density_change);
            std::printf("total energy %.6g J at the start, %.6g J at the end: %+.2f %% of the reference %.6g J\n",
                        s.energy_start, s.energy_end, 100 * s.energy_drift(), s.energy_reference);
            std::printf("picture: %s\nfiles in %s: summary.json", picture.c_str(), directory.c_str());
            for (auto const& file : s.files) std::printf(" %s", file.c_str());
            std::printf("\n");
        }
    };

    std::string name_;
    Options options_;
    CommandLine line_;
    int code_ = 0;
};

} // namespace example
