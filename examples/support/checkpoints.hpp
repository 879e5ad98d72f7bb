// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Checkpoints of a run; HDF5 is compiled once for all compositions.
#pragma once

#include <filesystem>
#include <string>

#include <spate/io/checkpoints_in.hpp>

namespace example {

/// An io::CheckpointFile.
struct CheckpointFile {
    void write(std::filesystem::path const& file, spate::io::State const& state) const;
    [[nodiscard]] spate::io::State read(std::filesystem::path const& file) const;
};

template <class... Output>
using Checkpoints = spate::io::CheckpointsIn<CheckpointFile, Output...>;

/// What --checkpoint-every asks for: "500" steps, "600s", "10min" or "2h" by the clock. Throws BadInput.
spate::io::Keep keep_every(std::string const& text);

} // namespace example
