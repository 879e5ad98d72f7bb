// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Snapshots of a run at even times, for ParaView. The file itself is io/vtkhdf.hpp.
#pragma once

#include <filesystem>
#include <string>

#include "spate/io/snapshots_in.hpp"
#include "spate/io/vtkhdf.hpp"

namespace spate::io {

/// Snapshots{directory, "dam_break", 0.01}: an output of Simulation::run; NAME_000000.hdf, ... and NAME.hdf.series.
class Snapshots : public SnapshotsIn<SnapshotSeries> {
public:
    /// \param every  interval between two snapshots [s]; 0: the last state only
    Snapshots(std::filesystem::path const& directory, std::string const& name, double every)
        : SnapshotsIn(SnapshotSeries(directory, name), every)
    {}
};

} // namespace spate::io
