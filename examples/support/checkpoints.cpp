// SPDX-License-Identifier: BSD-3-Clause
#include "support/checkpoints.hpp"

#include <charconv>

#include <spate/io/checkpoint.hpp>

namespace example {

struct Recorder::Kept : spate::io::Recorder<spate::io::CheckpointFile> {
    using spate::io::Recorder<spate::io::CheckpointFile>::Recorder;
};

Recorder::Recorder(std::filesystem::path const& directory, spate::io::Keep keep)
    : kept_(std::make_unique<Kept>(spate::io::CheckpointFile{}, directory, keep))
{}
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder::~Recorder() = default;

void Recorder::restart(spate::io::AnyScene& scene, std::filesystem::path const& file) { kept_->restart(scene, file); }
void Recorder::begin(spate::io::AnyScene& scene) { kept_->begin(scene); }
spate::io::Due Recorder::due(std::int64_t step) const { return kept_->due(step); }
bool Recorder::by_the_clock() const { return kept_->by_the_clock(); }
void Recorder::keep(spate::io::AnyScene& scene, spate::io::Due due) { kept_->keep(scene, due); }
void Recorder::end(spate::io::AnyScene& scene) { kept_->end(scene); }
std::filesystem::path const& Recorder::last() const { return kept_->last(); }
std::filesystem::path const& Recorder::failing() const { return kept_->failing(); }
std::string const& Recorder::saved() const { return kept_->saved(); }

spate::io::Keep keep_every(std::string const& text)
{
    const char* const end = text.data() + text.size();
    std::int64_t steps = 0;
    if (const auto read = std::from_chars(text.data(), end, steps); read.ptr == end && steps >= 0)
        return {.steps = steps};
    double time = 0;
    const auto read = std::from_chars(text.data(), end, time);
    const std::string unit(read.ptr, end);
    const double seconds = unit == "s" ? 1 : unit == "min" ? 60 : unit == "h" ? 3600 : 0;
    if (read.ec != std::errc{} || seconds == 0 || !(time > 0) || !std::isfinite(time))
        throw spate::BadInput("checkpoint-every", "'" + text + "'",
                              "a number of steps such as 500, or a time above 0 such as 600s, 10min or 2h");
    return {.wall = time * seconds};
}

} // namespace example
