// SPDX-License-Identifier: BSD-3-Clause
#include "support/checkpoints.hpp"

#include <charconv>

#include <spate/io/checkpoint_file.hpp>

namespace example {

void CheckpointFile::write(std::filesystem::path const& file, spate::io::State const& state) const
{
    spate::io::write_checkpoint(file, state);
}
spate::io::State CheckpointFile::read(std::filesystem::path const& file) const
{
    return spate::io::read_checkpoint(file);
}

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
