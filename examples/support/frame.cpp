// SPDX-License-Identifier: BSD-3-Clause
#include "support/frame.hpp"

#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <numbers>

#include <spate/core/together.hpp>
#include <spate/io/detail/replace_file.hpp>
#include <spate/io/output_error.hpp>

#include "support/interrupt.hpp"
#include "support/passive.hpp"

namespace example {

namespace {
Options with_output(Options o, std::string const& name)
{
    if (o.output.empty()) o.output = "out/" + name;
    return o;
}
} // namespace

Frame::Frame(std::string name, std::string const& about, Options defaults)
    : name_(std::move(name)), options_(with_output(std::move(defaults), name_)), line_(name_, about, options_)
{}
Frame::~Frame() = default;

int Frame::main(int argc, char** argv, std::function<void()> const& meet, std::function<void()> const& scene)
{
    wait_passively(argv);
    try {
        meet();
        line_.parse(argc, argv, speaks_);
        catch_interrupts();
        scene();
        return code_;
    }
    catch (Exit const& e) {
        return e.code;
    }
    catch (spate::OutputError const& e) {
        if (speaks_) std::cerr << e.what() << '\n';
        return 4;
    }
    catch (spate::OtherRankFailed const&) { // which says itself why
        return 4;
    }
    catch (std::invalid_argument const& e) { // BadInput, and what the writers refuse
        if (speaks_) std::cerr << e.what() << '\n';
        return 2;
    }
    catch (std::bad_alloc const&) {
        std::cerr << "spate: there is not enough memory for this scene; take a larger spacing\n";
        return 2;
    }
}

void Frame::require_writable(std::filesystem::path const& directory)
{
    try {
        std::error_code error;
        std::filesystem::create_directories(directory, error);
        if (error) throw spate::OutputError(directory, error.value());
        spate::io::detail::Temporary probe(directory / "summary.json");
    }
    catch (spate::OutputError const& e) {
        throw spate::BadInput("output", directory.string(), std::string("a directory to write in (") + e.what() + ")");
    }
}

void Frame::ended_early()
{
    try {
        throw;
    }
    catch (spate::Stop const& e) {
        summary_.stop = e.name(), summary_.stop_message = e.what(), summary_.stop_facts = e.facts();
        code_ = 3;
    }
    catch (spate::OtherRankFailed const&) {
        code_ = 4;
    }
    catch (spate::OutputError const& e) {
        summary_.stop = "OutputError", summary_.stop_message = e.what();
        code_ = 4;
    }
}
void Frame::interrupted(Summary& s, int signal, std::int64_t step, double time, std::filesystem::path const& checkpoint)
{
    s.stop = "Interrupted";
    s.stop_message = std::string("spate: interrupted by ") +
                     (signal == SIGINT    ? "SIGINT"
                      : signal == SIGUSR1 ? "SIGUSR1"
                                          : "SIGTERM") +
                     " at step " + std::to_string(step) + ", t = " + spate::text(time) + " s; " +
                     (checkpoint.empty() ? "the last state has been written"
                                         : "--restart " + checkpoint.string() + " goes on from there");
    s.stop_facts.step = step, s.stop_facts.time = time;
    code_ = 128 + signal;
}

void Frame::ended(Summary const& s, Talk const& talk, std::filesystem::path const& directory,
                  std::filesystem::path const& picture) const
{
    if (!speaks_) return;
    if (code_ != 0) std::cerr << s.stop_message << '\n';
    s.write(directory / "summary.json");
    talk.closing(s, directory, picture);
}

void Frame::Talk::opening(Summary const& s) const
{
    if (quiet) return;
    std::string of;
    for (auto const& [species, count] : s.particles)
        of += (of.empty() ? "" : " + ") + std::to_string(count) + " " + species;
    std::printf("%s: %s = %zu particles\n", s.scene.c_str(), of.c_str(), s.total());
    for (auto const& [role, name] : s.composition) std::printf("  %-12s %s\n", role.c_str(), name.c_str());
    std::printf("  %-12s %d\n", "threads", s.threads);
    if (s.ranks > 1) std::printf("  %-12s %d\n", "ranks", s.ranks);
    std::fflush(stdout);
}

void Frame::Talk::going_on(std::filesystem::path const& checkpoint, std::int64_t step, double time) const
{
    if (quiet) return;
    std::printf("going on from %s: step %lld, t = %.6g s\n", checkpoint.c_str(), static_cast<long long>(step), time);
    std::fflush(stdout);
}

void Frame::Talk::first_step(double dt, std::string_view criterion, spate::TimeStep const& stable) const
{
    if (quiet) return;
    std::printf("dt = %.4g s at the start, by the %s criterion", dt, std::string(criterion).c_str());
    if (std::isfinite(stable.dt))
        std::printf("; margin %.2f to the %s limit of linear theory\n", stable.dt / dt,
                    std::string(stable.criterion).c_str());
    else std::printf("; linear theory has no limit without damping: heed the warnings\n");
    std::fflush(stdout);
}

void Frame::Talk::contact(char const* integrator, double omega, double dt, double growth, double error) const
{
    if (quiet) return;
    const double time = std::numbers::pi / omega;
    std::printf("contact time %.4g s, omega dt = %.4g, %.3g steps a contact: %s ", time, omega * dt, time / dt,
                integrator);
    if (growth > 0)
        std::printf("multiplies the energy of a contact by %.5g\n", std::exp(2 * std::log1p(growth) * time / dt));
    else if (omega * dt < 2) std::printf("keeps the energy of a contact within about %.2g %%\n", 100 * error);
    else std::printf("is unstable: omega dt must be below 2\n");
    std::fflush(stdout);
}

void Frame::Talk::warn(std::vector<std::string> const& all)
{
    for (; speaks && told < all.size(); ++told) std::cerr << "warning: " << all[told] << '\n';
}

void Frame::Talk::closing(Summary const& s, std::filesystem::path const& directory,
                          std::filesystem::path const& picture) const
{
    if (quiet) return;
    std::printf("%s: t = %.4g s after %lld steps in %.1f s", s.stop.c_str(), s.time, static_cast<long long>(s.steps),
                s.wall);
    if (s.steps > 0)
        std::printf(" (%.1f ns a particle-step, %.2f ns a pair)", s.ns_per_particle_step(), s.ns_per_pair());
    std::printf("\n");
    if (s.mach > 0)
        std::printf("largest Mach number %.3f, largest density change %.2f %%\n", s.mach, 100 * s.density_change);
    std::printf("total energy %.6g J at the start, %.6g J at the end", s.energy_start, s.energy_end);
    if (std::isfinite(s.energy_drift()))
        std::printf(": %+.2f %% of the reference %.6g J", 100 * s.energy_drift(), s.energy_reference);
    std::printf("\n");
    std::printf("picture: %s\nfiles in %s: summary.json", picture.c_str(), directory.c_str());
    for (auto const& file : s.files) std::printf(" %s", file.c_str());
    std::printf("\n");
}

} // namespace example
