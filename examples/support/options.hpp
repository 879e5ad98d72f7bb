// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The command line of an example: what all of them take, and what one scene adds. Numbers only: policies are
///        chosen before the program is compiled.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace example {

/// What every example takes; a scene gives its own defaults.
struct Options {
    double until = 1;                                              ///< end time [s]
    std::int64_t steps = std::numeric_limits<std::int64_t>::max(); ///< at most
    double spacing = 0;                                            ///< of the particles [m]; 0: the scene's
    double cfl = 0.25;                                             ///< factor of the time-step criteria [-]
    double dt = 0;                                                 ///< [s]; 0: by the criteria
    double every = 0;                                              ///< between snapshots [s]; 0: the last state only
    double history_every = 0;                                      ///< between rows of history.csv [s]; 0: each step
    double picture_every = 0;                                      ///< between pictures [s]; 0: the last state only
    int threads = 0;                                               ///< 0: as many as there are
    int ranks = 0;                                                 ///< processes; 0: as many as mpirun has started
    int cell = 0;                                                  ///< ranges along a cell's edge; 0: by dimension
    int balance_every = 4;                                         ///< rebuilds of lists between two looks; 0: off
    std::string balance = "on";                                    ///< on or off
    std::uint64_t seed = 1;                                        ///< of random numbers
    std::string output = {};                                       ///< directory; empty: out/NAME
    std::string checkpoint_every = "0";                            ///< steps, or a time by the clock: 500, 600s, 2h
    std::string restart = {};                                      ///< checkpoint to go on from; empty: none
    std::string colour = "speed";                                  ///< of pictures: speed or pressure
    bool quiet = false;
};

/// `--help` and a wrong command line end the program through this.
struct Exit {
    int code;
};

class CommandLine {
public:
    CommandLine(std::string const& name, std::string const& about, Options& options);
    CommandLine(CommandLine const&) = delete;
    CommandLine& operator=(CommandLine const&) = delete;
    ~CommandLine();

    void choice(std::string const& option, std::string& value, std::vector<std::string> const& words,
                std::string const& help);
    void number(std::string const& option, double& value, std::string const& help, std::string const& unit);
    void text(std::string const& option, std::string& value, std::string const& help, std::string const& what);
    /// Only where a scene draws random numbers.
    void seed();
    /// Throws Exit{0} after --help and Exit{2}, after one sentence, for what cannot be understood.
    /// \param speaks  else without the sentence: another rank says it
    void parse(int argc, char** argv, bool speaks);

private:
    struct Parser;
    std::unique_ptr<Parser> parser_;
    Options& options_;
};

} // namespace example
