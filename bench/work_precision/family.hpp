// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A family: one composition of one case, which runs at any setting and tells what it cost and how wrong it was.
#pragma once

#include <chrono>
#include <ctime>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <spate/spate.hpp>

namespace work_precision {

using namespace spate;

/// One point of a ladder. A case takes what it knows, in its own units of length and time.
struct Setting {
    int n = 50;            ///< spacings in the length of the case [-]
    double cfl = 0.25;     ///< factor of the time step [-]
    double sound = 10;     ///< speed of sound over the fastest flow [-]
    double reynolds = 100; ///< [-]
    double length = 1;     ///< of the case [m]
    double until = 1;      ///< [units of the case]
    double jitter = 0.2;   ///< of the first places [spacings]
    double omega_dt = 0.1; ///< of a contact [-]
    double skin = 0;       ///< of the neighbour lists [ranges]; 0: that of the interaction
    int cell = 0;          ///< edge of a cell [ranges]; 0: by dimension
    int threads = 1;
    double at_most = 60; ///< CPU seconds after which a run is given up
};

/// What a run was like.
struct Outcome {
    std::size_t particles = 0; ///< walls too
    std::int64_t steps = 0, force_evals = 0, pairs = 0;
    double dt = 0;                                      ///< mean [s of the case]
    double wall = 0, cpu = 0, setup = 0;                ///< of the step loop; before it [s]
    std::vector<std::pair<std::string, double>> errors; ///< by name
    std::string status = "OK";                          ///< or the name of the stop
};

struct Family {
    std::string scene, kernel;
    double h_dx; ///< [-]
    std::string formulation, integrator, precision;
    std::function<Outcome(Setting const&)> run;
};
inline std::vector<Family>& families()
{
    static std::vector<Family> all;
    return all;
}

/// Runs what `make` makes, after a few steps of another one to warm up; `judge` gives the errors at the end.
template <class I>
Outcome measured(Setting const& s, RunOptions options, auto const& make, auto const& judge, auto&&... output)
{
    using Clock = std::chrono::steady_clock;
    auto since = [](auto t) { return std::chrono::duration<double>(Clock::now() - t).count(); };
    Outcome o;
    try {
        RunOptions few = options;
        few.steps = 3;
        make().run(few);
    }
    catch (Stop const&) { // the run itself will tell
    }
    const auto start = Clock::now();
    auto scene = make();
    o.setup = since(start);
    const std::clock_t loop = std::clock(); // CPU time: a core that others take is not the run's fault
    bool late = false;
    scene.interrupt_when([&] { return late = double(std::clock() - loop) > s.at_most * CLOCKS_PER_SEC; });
    try {
        scene.run(options, output...);
        if (late) o.status = "OverBudget";
        else o.errors = judge(scene);
    }
    catch (Stop const& stop) {
        o.status = stop.name();
    }
    o.particles = scene.system().total();
    o.steps = scene.report().steps, o.force_evals = o.steps * I::evaluations;
    o.pairs = scene.system().pairs_evaluated();
    o.dt = scene.time() / double(std::max<std::int64_t>(o.steps, 1));
    o.wall = scene.report().wall, o.cpu = scene.report().cpu;
    return o;
}

/// Lists with the skin that is asked for.
inline Neighbours lists_of(Setting const& s, Neighbours usual)
{
    if (s.skin > 0) usual.skin = s.skin;
    return usual;
}

template <class Precision>
std::string precision_name()
{
    return std::is_same_v<typename Precision::real, double> ? "double" : "float";
}

} // namespace work_precision
