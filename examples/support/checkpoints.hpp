// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Checkpoints of a run; what keeps them, and HDF5, is compiled once for all compositions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <spate/io/checkpoints_in.hpp>
#include <spate/io/keep.hpp>

namespace example {

/// An io::Recorder.
class Recorder {
public:
    Recorder(std::filesystem::path const& directory, spate::io::Keep keep);
    Recorder(Recorder&&) noexcept;
    ~Recorder();

    void restart(spate::io::AnyScene& scene, std::filesystem::path const& file);
    void begin(spate::io::AnyScene& scene);
    [[nodiscard]] spate::io::Due due(std::int64_t step) const;
    [[nodiscard]] bool by_the_clock() const;
    void keep(spate::io::AnyScene& scene, spate::io::Due due);
    void end(spate::io::AnyScene& scene);
    [[nodiscard]] std::filesystem::path const& last() const;
    [[nodiscard]] std::filesystem::path const& failing() const;
    [[nodiscard]] std::string const& saved() const;

private:
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

template <class... Output>
using Checkpoints = spate::io::CheckpointsIn<Recorder, Output...>;

/// What --checkpoint-every asks for: "500" steps, "600s", "10min" or "2h" by the clock. Throws BadInput.
spate::io::Keep keep_every(std::string const& text);

} // namespace example
