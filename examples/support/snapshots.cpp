// SPDX-License-Identifier: BSD-3-Clause
#include "support/snapshots.hpp"

#include <spate/io/vtkhdf.hpp>

namespace example {

Series::Series(std::filesystem::path const& directory, std::string const& name)
    : series_(std::make_unique<spate::io::SnapshotSeries>(directory, name))
{}
Series::Series(Series&&) noexcept = default;
Series::~Series() = default;

std::filesystem::path Series::write(spate::io::AnyRanks const& ranks, spate::io::Cloud cloud)
{
    return series_->write(ranks, std::move(cloud));
}
std::vector<double> const& Series::times() const { return series_->times(); }
void Series::go_on_from(std::vector<double> const& times) { series_->go_on_from(times); }

} // namespace example
