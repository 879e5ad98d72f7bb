// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Checkpoints of a run as an output of it. Not what keeps them: that is Recorder, such as io/recorder.hpp.
#pragma once

#include <filesystem>
#include <string>
#include <tuple>
#include <utility>

#include "spate/core/ranks.hpp"
#include "spate/io/any_scene.hpp"
#include "spate/io/keep.hpp"
#include "spate/io/this_scene.hpp"

namespace spate::io {

/// An output of Simulation::run, the last one: what other outputs have to remember is that of the same step. A Recorder is
/// as io::Recorder, or asks one that is compiled elsewhere.
template <class Recorder, class... Output>
class CheckpointsIn {
public:
    [[gnu::cold]] explicit CheckpointsIn(Recorder recorder, Output&... outputs)
        : recorder_(std::move(recorder)), outputs_(outputs...)
    {}
    /// The scene goes on from a file. Throws BadInput, and nothing has changed.
    [[gnu::cold]] void restart(auto& scene, std::filesystem::path const& file)
    {
        auto any = of(scene);
        recorder_.restart(any, file);
    }
    [[gnu::cold]] void begin(auto& scene)
    {
        auto any = of(scene);
        recorder_.begin(any);
    }
    void step(auto& scene)
    {
        Due due = recorder_.due(scene.steps());
        if (recorder_.by_the_clock()) due = party_of(scene).all(due, agree::Most{}); // clocks differ
        if (due == Due::nothing) return;
        auto any = of(scene);
        recorder_.keep(any, due);
    }
    [[gnu::cold]] void end(auto& scene)
    {
        auto any = of(scene);
        recorder_.end(any);
    }
    /// The last checkpoint on disk, empty if there is none.
    [[nodiscard]] std::filesystem::path const& last() const { return recorder_.last(); }
    /// The state that a Stop has ended, empty if none has.
    [[nodiscard]] std::filesystem::path const& failing() const { return recorder_.failing(); }
    /// For the message of a Stop: where the states are.
    [[nodiscard]] std::string const& saved() const { return recorder_.saved(); }

private:
    template <class Scene>
    ThisScene<Scene, Output...> of(Scene& scene) const
    {
        return {scene, outputs_};
    }

    Recorder recorder_;
    std::tuple<Output&...> outputs_;
};

} // namespace spate::io
