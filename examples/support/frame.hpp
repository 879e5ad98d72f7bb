// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What an example has around its scene whatever the scene is: command line, exit code, what is printed.
///        Compiled once for all compositions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "support/options.hpp"
#include "support/summary.hpp"

#include <spate/physics/time_step.hpp>

namespace example {

class Frame {
public:
    Frame(std::string name, std::string const& about, Options defaults);
    Frame(Frame const&) = delete;
    Frame& operator=(Frame const&) = delete;
    ~Frame();
    Options const& options() const { return options_; }
    CommandLine& command_line() { return line_; }

    /// 0 ok, 2 bad input, 3 a typed stop, 4 an output could not be written, 128 + signal: 130 SIGINT, 138 SIGUSR1,
    /// 143 SIGTERM, each with a checkpoint.
    /// \param meet  called first: ranks that share the scene find each other
    int main(int argc, char** argv, std::function<void()> const& meet, std::function<void()> const& scene);

protected:
    /// Before step 0 a directory that cannot be written in is bad input; later it is an OutputError.
    static void require_writable(std::filesystem::path const& directory);
    /// In a handler: the exit code and the summary of a Stop, of a failed output, or of another rank's failure.
    void ended_early();
    void interrupted(Summary& s, int signal, std::int64_t step, double time, std::filesystem::path const& checkpoint);
    /// What is printed on standard output.
    struct Talk {
        bool quiet;
        bool speaks = true;   ///< one rank does
        std::size_t told = 0; ///< warnings

        void opening(Summary const& s) const;
        void begin(auto const& scene) { warn(scene.report().warnings); }
        void going_on(std::filesystem::path const& checkpoint, std::int64_t step, double time) const;
        void step(auto const& scene)
        {
            if (scene.report().steps == 1) {
                first_step(scene.dt(), scene.criterion(), scene.report().stable);
                if (const double omega = scene.stiffness().contact_frequency; omega > 0)
                    contact(scene.integrator().name, omega, scene.dt(), scene.integrator().growth(omega * scene.dt()),
                            scene.integrator().energy_error(omega * scene.dt()));
            }
            warn(scene.report().warnings);
        }
        void end(auto const& scene) { warn(scene.report().warnings); }
        void first_step(double dt, std::string_view criterion, spate::TimeStep const& stable) const;
        /// What the integrator makes of an undamped contact of angular frequency omega [1/s].
        void contact(char const* integrator, double omega, double dt, double growth, double error) const;
        /// Warnings are errors in waiting: they are told even to the quiet.
        void warn(std::vector<std::string> const& all);
        void closing(Summary const& s, std::filesystem::path const& directory,
                     std::filesystem::path const& picture) const;
    };
    void ended(Summary const& s, Talk const& talk, std::filesystem::path const& directory,
               std::filesystem::path const& picture) const;

    std::string name_;
    Options options_;
    CommandLine line_;
    Summary summary_;
    int code_ = 0;
    bool speaks_ = true; ///< for all ranks
};

} // namespace example
