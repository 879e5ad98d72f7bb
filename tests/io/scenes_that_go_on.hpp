// SPDX-License-Identifier: BSD-3-Clause
// Scenes that are cut in two by a checkpoint, whatever the transport: the dam break and grains that enter and leave.
#pragma once

#include "backend/scenes_of_ranks.hpp"
#include "spate/io/resume.hpp"
#include "spate/io/state_of.hpp"

#include <functional>
#include <tuple>

#include <gtest/gtest.h>

namespace going_on {

using namespace spate;

struct Column {
    static constexpr std::int64_t steps = 800, rebuilds = 20;
    static auto scene(auto backend) { return ranked::column(backend); }
    static void run(auto& sim, std::int64_t n) { sim.run({.steps = n, .cfl = 0.2}); }
    static auto outputs() { return std::tuple<>(); }
};
struct Hopper {
    static constexpr std::int64_t steps = 1500, rebuilds = 100; // each pour rebuilds
    static auto scene(auto backend) { return ranked::hopper_box(backend); }
    decltype(ranked::hopper_pour()) pour = ranked::hopper_pour();
    decltype(ranked::hopper_outlet()) outlet = ranked::hopper_outlet();
    void run(auto& sim, std::int64_t n) { sim.run({.steps = n, .dt = 2e-4}, pour, outlet); }
    auto outputs() { return std::tie(pour, outlet); }
};

/// What a run was like at its end, on rank 0 with its state.
struct End {
    std::uint64_t hash = 0;
    std::int64_t rebuilds = 0, pairs = 0, moved_cells = 0;
    double time = 0, entered = 0, left = 0;
    io::State state;
};
template <class Scene, class... Output>
io::ThisScene<Scene, Output...> any(Scene& scene, std::tuple<Output&...> outputs)
{
    return {scene, outputs};
}
/// n steps of a scene, from its start or from a state. \param keep  called with the io::AnyScene at the end
template <class Case>
End run(auto backend, std::int64_t n, io::State const* from = nullptr,
        std::function<void(io::AnyScene&)> const& keep = nullptr)
{
    Case outputs;
    auto sim = Case::scene(backend);
    auto this_scene = any(sim, outputs.outputs());
    io::AnyScene& scene = this_scene;
    if (from) io::resume(scene, *from);
    outputs.run(sim, n);
    End end;
    end.hash = sim.state_hash(), end.time = sim.time();
    end.rebuilds = sim.system().rebuilds(), end.pairs = sim.system().pairs_evaluated();
    end.entered = sim.exchanged().entered.energy, end.left = sim.exchanged().left.energy;
    if constexpr (requires { sim.system().parts().report(); })
        end.moved_cells = sim.system().ranks().all(sim.system().parts().report().moved_cells, agree::Sum{});
    if (keep) keep(scene);
    end.state = io::state_of(scene);
    return end;
}
/// Names of the tables and texts in which two states differ, but for what clocks have measured.
inline std::vector<std::string> differences(io::State const& a, io::State const& b)
{
    std::vector<std::string> names;
    auto measured = [](std::string const& name) {
        return name == "run/wall_s" || name == "run/cpu_s" || name.rfind("balance_", 0) == 0;
    };
    for (auto const& [name, table] : a.tables)
        if (!measured(name) && (!b.has(name) || !(b.tables.at(name) == table))) names.push_back(name);
    for (auto const& [name, table] : b.tables)
        if (!a.has(name)) names.push_back(name);
    if (a.texts != b.texts) names.emplace_back("texts");
    return names;
}
inline void expect_the_same(End const& a, End const& b, std::string const& where)
{
    EXPECT_EQ(a.hash, b.hash) << where;
    EXPECT_EQ(a.rebuilds, b.rebuilds) << where;
    EXPECT_EQ(a.pairs, b.pairs) << where;
    EXPECT_EQ(a.time, b.time) << where;
    EXPECT_EQ(a.entered, b.entered) << where;
    EXPECT_EQ(a.left, b.left) << where;
}

} // namespace going_on
