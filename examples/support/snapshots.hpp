// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Snapshots of a run for ParaView; HDF5 is compiled once for all compositions.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <spate/io/snapshots_in.hpp>

namespace spate::io {
class SnapshotSeries;
}

namespace example {

/// An io::SnapshotSeries.
class Series {
public:
    Series(std::filesystem::path const& directory, std::string const& name);
    Series(Series&&) noexcept;
    ~Series();

    std::filesystem::path write(spate::io::AnyRanks const& ranks, spate::io::Cloud cloud);
    std::vector<double> const& times() const;
    void go_on_from(std::vector<double> const& times);

private:
    std::unique_ptr<spate::io::SnapshotSeries> series_;
};

using Snapshots = spate::io::SnapshotsIn<Series>;

} // namespace example
