// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief summary.json: what a run was, and what it cost.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <spate/core/errors.hpp>

namespace example {

using Words = std::vector<std::string>;

struct Summary {
    std::string scene;
    std::vector<std::pair<std::string, std::size_t>> particles; ///< by species
    std::int64_t steps = 0, force_evaluations = 0;
    std::int64_t pairs = 0;   ///< directed, within range, summed over evaluations
    double time = 0;          ///< reached [s]
    double wall = 0, cpu = 0; ///< of the step loop, output excluded [s]
    std::size_t bytes = 0;    ///< of all that is kept for the particles
    double mach = 0, density_change = 0;
    double energy_start = 0, energy_end = 0, energy_reference = 0; ///< [J]
    std::string stop = "ok";
    std::string stop_message = {};
    spate::StopFacts stop_facts = {};
    std::uint64_t state_hash = 0;
    std::vector<std::pair<std::string, std::string>> composition;
    Words terms;
    std::vector<std::pair<std::string, Words>> fields;    ///< by species
    std::vector<std::pair<std::string, double>> measures; ///< at the end, under the names of their columns
    Words warnings;
    Words files;
    int threads = 1, ranks = 1;
    std::uint64_t seed = 1;

    [[nodiscard]] std::size_t total() const;
    /// Change of total energy over the reference [-].
    [[nodiscard]] double energy_drift() const;
    [[nodiscard]] double ns_per_particle_step() const;
    [[nodiscard]] double ns_per_pair() const;

    void add_species(std::string const& species, std::size_t count, Words const& its_fields);
    void add_choice(std::string const& role, std::string const& choice);

    /// What a restart needs: f(name, number).
    void notes(auto const& f) { f("energy_start", energy_start); }
    /// Throws OutputError.
    void write(std::filesystem::path const& file) const;
};

/// "spate::CubicSpline<3>" as a reader would write it: without namespaces.
std::string type_name(char const* mangled);

} // namespace example
