// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Checkpoints of a run in HDF5 files, and restarts from them that go on with the same bits.
#pragma once

#include <filesystem>
#include <utility>

#include "spate/io/checkpoint_file.hpp"
#include "spate/io/checkpoints_in.hpp"
#include "spate/io/recorder.hpp"

namespace spate::io {

struct CheckpointFile {
    void write(AnyRanks const& ranks, std::filesystem::path const& file, State part) const
    {
        write_checkpoint(ranks, file, std::move(part));
    }
    [[nodiscard]] State read(std::filesystem::path const& file) const { return read_checkpoint(file); }
};

/// Checkpoints{"out", {.steps = 1000}, history, snapshots}: an output of Simulation::run, after those that it names;
/// restart(scene, file) before the run lets the scene, put together as at its start, and the outputs go on.
template <class... Output>
class Checkpoints : public CheckpointsIn<Recorder<CheckpointFile>, Output...> {
public:
    [[gnu::cold]] Checkpoints(std::filesystem::path const& directory, Keep keep, Output&... outputs)
        : CheckpointsIn<Recorder<CheckpointFile>, Output...>({CheckpointFile{}, directory, keep}, outputs...)
    {}
};
template <class... Output>
Checkpoints(std::filesystem::path const&, Keep, Output&...) -> Checkpoints<Output...>;

} // namespace spate::io
