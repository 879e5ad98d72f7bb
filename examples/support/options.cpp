// SPDX-License-Identifier: BSD-3-Clause
#include "support/options.hpp"

#include <iostream>

#include <CLI/CLI.hpp>

namespace example {

struct CommandLine::Parser {
    CLI::App app;
};

namespace {
/// "--until FLOAT [s]  (0.9)": CLI11 shows the type, the unit and the default.
CLI::Option* with_unit(CLI::Option* option, std::string const& unit)
{
    return option->type_name(unit)->capture_default_str();
}
} // namespace

CommandLine::CommandLine(std::string const& name, std::string const& about, Options& o)
    : parser_(std::make_unique<Parser>()), options_(o)
{
    auto& app = parser_->app;
    app.name(name);
    app.description(about);
    app.set_help_flag("--help,-h", "print this and end");
    with_unit(app.add_option("--until", o.until, "end time"), "[s]");
    app.add_option("--steps", o.steps, "end after so many steps, those before a restart too")->type_name("N");
    with_unit(app.add_option("--spacing", o.spacing, "of the particles; 0: the scene's"), "[m]");
    with_unit(app.add_option("--cfl", o.cfl, "factor of the time-step criteria"), "[-]");
    with_unit(app.add_option("--dt", o.dt, "fixed time step; 0: by the criteria"), "[s]");
    with_unit(app.add_option("--threads", o.threads, "threads; 0: as many as there are"), "N");
    with_unit(app.add_option("--ranks", o.ranks, "processes, with --backend mpi; 0: as many as there are"), "N");
    with_unit(app.add_option("--cell", o.cell, "ranges along the edge of a cell, 1 to 32; 0: by dimension"), "M");
    with_unit(app.add_option("--balance-every", o.balance_every,
                             "with --backend mpi: rebuilds of neighbour lists between two looks at what ranks cost"),
              "N");
    choice("--balance", o.balance, {"on", "off"}, "with --backend mpi: whether cells move between ranks");
    app.add_option("--output", o.output, "directory of the results")->type_name("DIR")->default_str(o.output);
    with_unit(app.add_option("--every", o.every, "between two snapshots; 0: the last state only"), "[s]");
    with_unit(app.add_option("--history-every", o.history_every, "between two rows of history.csv; 0: each step"),
              "[s]");
    with_unit(app.add_option("--picture-every", o.picture_every, "between two pictures; 0: the last state only"),
              "[s]");
    app.add_option(
           "--checkpoint-every", o.checkpoint_every,
           "between two checkpoints: steps, or a time by the clock with s, min or h, such as 600s; 0: only when "
           "the run is interrupted or stopped")
        ->type_name("N|T")
        ->capture_default_str();
    app.add_option("--restart", o.restart, "go on from this checkpoint of the same scene")->type_name("FILE");
    choice("--colour", o.colour, {"speed", "pressure"}, "of the particles in pictures");
    app.add_flag("--quiet", o.quiet, "print nothing but errors");
}
CommandLine::~CommandLine() = default;

void CommandLine::choice(std::string const& option, std::string& value, std::vector<std::string> const& words,
                         std::string const& help)
{
    std::string all;
    for (auto const& word : words) all += (all.empty() ? "" : "|") + word;
    parser_->app.add_option(option, value, help)
        ->type_name(all)
        ->capture_default_str()
        ->check([words, all](std::string const& s) {
            const bool known = std::find(words.begin(), words.end(), s) != words.end();
            return known ? std::string() : "'" + s + "' is not one of " + all;
        });
}
void CommandLine::number(std::string const& option, double& value, std::string const& help, std::string const& unit)
{
    with_unit(parser_->app.add_option(option, value, help), "[" + unit + "]");
}
void CommandLine::text(std::string const& option, std::string& value, std::string const& help, std::string const& what)
{
    parser_->app.add_option(option, value, help)->type_name(what);
}
void CommandLine::seed() { with_unit(parser_->app.add_option("--seed", options_.seed, "of the random numbers"), "N"); }

void CommandLine::parse(int argc, char** argv, bool speaks)
{
    try {
        parser_->app.parse(argc, argv);
    }
    catch (CLI::CallForHelp const&) {
        if (speaks) std::cout << parser_->app.help();
        throw Exit{0};
    }
    catch (CLI::ParseError const& e) {
        if (speaks) std::cerr << "spate: " << e.what() << "; --help lists the options\n";
        throw Exit{2};
    }
}

} // namespace example
