// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The dam break "big" in developed flow: computed once, kept in a file, and run on from there time and again.
#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "least.hpp"
#include "scenes.hpp"

namespace bench {

constexpr double developed = 0.30, window = 0.02; ///< [s]
constexpr RunOptions like_dam_break{.cfl = 0.2};

/// Position, velocity and density by id.
class Developed {
public:
    /// Reads the file, or runs the scene to the time of interest (minutes) and writes it.
    static Developed const& flow()
    {
        static const Developed d;
        return d;
    }
    template <class S>
    void put_into(S& dam) const
    {
        auto& p = dam.particles();
        for (std::size_t i = 0; i < p.size(); ++i) {
            double const* d = &data_[7 * p.id()[i]];
            p.put(position, i, {d[0], d[1], d[2]});
            p.put(velocity, i, {d[3], d[4], d[5]});
            p.put(density, i, d[6]);
        }
        dam.prepare();
    }

private:
    Developed()
    {
        const auto folder = std::filesystem::path("build/bench");
        const auto file =
            (std::filesystem::is_directory(folder) ? folder : ".") / std::filesystem::path("dam_break_big_0.30.bin");
        auto dam = big_dam(0);
        auto& p = dam.particles();
        data_.resize(7 * p.size());
        const auto bytes = std::streamsize(data_.size() * sizeof(double));
        std::ifstream in(file, std::ios::binary);
        if (in.read(reinterpret_cast<char*>(data_.data()), bytes) && in.peek() == std::ifstream::traits_type::eof())
            return;
        dam.run({.until = developed, .cfl = like_dam_break.cfl});
        for (std::size_t i = 0; i < p.size(); ++i) {
            const auto x = p.at(position, i), v = p.at(velocity, i);
            double* d = &data_[7 * p.id()[i]];
            for (int c = 0; c < 3; ++c) d[c] = x[c], d[3 + c] = v[c];
            d[6] = p.at(density, i);
        }
        std::ofstream(file, std::ios::binary).write(reinterpret_cast<char const*>(data_.data()), bytes);
    }
    std::vector<double> data_;
};

/// What a stretch of a run cost: of each ten steps the least over all repeats, summed; the steps are the same each time.
struct Cost {
    std::vector<double> wall, cpu; ///< of each ten steps [s]
    double pairs = 0, evaluations = 0, markers = 0;
    std::int64_t steps = 0, rebuilds = 0;

    [[nodiscard]] static double sum(std::vector<double> const& v)
    {
        double s = 0;
        for (double x : v) s += x;
        return s;
    }
    void say(benchmark::State& state, double threads) const
    {
        auto& c = state.counters;
        const double cpu_s = sum(cpu) / threads, wall_s = sum(wall);
        c["cpu_ns_pair"] = 1e9 * cpu_s / pairs; // of one thread
        c["wall_ns_pair"] = 1e9 * wall_s / pairs;
        c["cpu_ns_marker"] = 1e9 * cpu_s / (evaluations * markers);
        c["wall_ns_marker"] = 1e9 * wall_s / (evaluations * markers);
        c["steps"] = double(steps), c["rebuilds"] = double(rebuilds);
        c["pairs_a_marker"] = pairs / (evaluations * markers);
    }
};

/// Makes a scene anew and steps it on for a stretch of time [s].
template <class Make>
void run_on(Cost& cost, Make const& make, RunOptions const& o, double stretch)
{
    auto sim = make();
    auto& s = sim.system();
    sim.step(o); // lists, images and records are made
    const auto steps = sim.steps(), rebuilds = s.rebuilds(), pairs = s.pairs_evaluated(), evaluations = s.evaluations();
    std::size_t k = 0;
    const double end = sim.time() + stretch * (1 - 1e-9);
    for (bool more = true; more; ++k) {
        const auto before = sim.report();
        for (int n = 0; n < 10 && more; ++n) {
            sim.step(o);
            more = sim.time() < end;
        }
        const double wall = sim.report().wall - before.wall, cpu = sim.report().cpu - before.cpu;
        if (k == cost.wall.size()) cost.wall.push_back(wall), cost.cpu.push_back(cpu);
        cost.wall[k] = std::min(cost.wall[k], wall), cost.cpu[k] = std::min(cost.cpu[k], cpu);
    }
    cost.steps = sim.steps() - steps, cost.rebuilds = s.rebuilds() - rebuilds;
    cost.pairs = double(s.pairs_evaluated() - pairs), cost.evaluations = double(s.evaluations() - evaluations);
    cost.markers = double(s.total());
}

} // namespace bench
