// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Snapshots of particles for ParaView, VTK and h5py: VTKHDF UnstructuredGrid 1.0, one vertex a particle.
///        Not a checkpoint: values are float, and a run cannot go on from them.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "spate/io/any_ranks.hpp"
#include "spate/io/cloud.hpp"
#include "spate/io/detail/replace_file.hpp"
#include "spate/io/detail/shared_file.hpp"
#include "spate/io/detail/stretches.hpp"
#include "spate/io/output_error.hpp"

namespace spate::io {

namespace detail {

/// f(name below VTKHDF, values of the particles that are here, components) for each array with a row a particle.
/// \param named  with ids and species
void each_array(Cloud const& cloud, bool named, auto const& f)
{
    f("Points", std::span(cloud.points), std::size_t{3});
    for (Column const& c : cloud.columns)
        f("PointData/" + c.name, std::span(c.values), static_cast<std::size_t>(c.components));
    for (IntegerColumn const& c : cloud.integers) f("PointData/" + c.name, std::span(c.values), std::size_t{1});
    if (named || !cloud.id.empty()) f("PointData/id", std::span(cloud.id), std::size_t{1});
    if (named || !cloud.species.empty()) f("PointData/species", std::span(cloud.species), std::size_t{1});
}

/// Instead of the particles that are here a stretch of all, in the order of species and ids.
inline Where stretch(AnyRanks const& ranks, Cloud& cloud)
{
    if (ranks.count() == 1) return {0, cloud.size()};
    std::vector<Key> keys;
    for (std::size_t k = 0; k < cloud.size(); ++k) {
        const auto id = static_cast<std::uint64_t>(cloud.id[k]);
        keys.push_back({cloud.species[k], static_cast<std::uint32_t>(id >> 32), static_cast<std::uint32_t>(id)});
    }
    const Stretches stretches(ranks, keys, std::tuple_size_v<Key>);
    auto take = [&](auto& values, std::size_t components) { values = stretches(values, components); };
    take(cloud.points, 3);
    for (Column& c : cloud.columns) take(c.values, static_cast<std::size_t>(c.components));
    for (IntegerColumn& c : cloud.integers) take(c.values, 1);
    take(cloud.id, 1), take(cloud.species, 1);
    return stretches.where();
}

/// One VTK_VERTEX a particle, in one partition: Threshold, Clip and selections of VTK work on cells.
inline void outline_topology(Hdf5Outline const& file, hid_t vtk, std::uint64_t n)
{
    const std::array<std::int64_t, 1> count{static_cast<std::int64_t>(n)};
    for (auto* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
        file.dataset(vtk, name, std::span<std::int64_t const>(count));
    auto number = [](std::uint64_t k) { return static_cast<std::int64_t>(k); };
    file.formula<std::int64_t>(vtk, "Connectivity", n, number);
    file.formula<std::int64_t>(vtk, "Offsets", n + 1, number);
    file.formula<std::uint8_t>(vtk, "Types", n, [](std::uint64_t) { return std::uint8_t{1}; });
}

inline void outline_vtkhdf(Hdf5Outline const& file, Cloud const& cloud, bool named, std::uint64_t n)
{
    const Hdf5Group vtk = file.group(file.root(), "VTKHDF");
    constexpr std::array<std::int64_t, 2> version{1, 0};
    file.attribute(vtk, "Version", std::span<std::int64_t const>(version));
    file.attribute(vtk, "Type", "UnstructuredGrid");
    (void)file.group(vtk, "PointData");
    each_array(cloud, named, [&]<class T>(std::string const& name, std::span<T const>, std::size_t components) {
        (void)file.room<T>(vtk, name, n, components);
    });
    outline_topology(file, vtk, n);
    const Hdf5Group group = file.group(vtk, "FieldData");
    file.dataset(group, "TimeValue", std::span<double const>(&cloud.time, 1));
    file.dataset(group, "step", std::span<std::int64_t const>(&cloud.step, 1));
}

/// The shortest decimal that reads back as the same double, in any locale.
inline std::string shortest(double value)
{
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

} // namespace detail

/// Of the particles that ranks hold, with ids and species if there are several of them; all of them call it. Name the file
/// *.hdf: ParaView 5.11 opens no other. Throws OutputError, OtherRankFailed where another rank does, and the file is then
/// what it was before.
inline void write_vtkhdf(AnyRanks const& ranks, std::filesystem::path const& file, Cloud cloud)
{
    ranks.together([&] {
        detail::check_cloud(cloud);
        if (ranks.count() == 1) return;
        detail::check_size("id", cloud.id.size(), cloud.size());
        detail::check_size("species", cloud.species.size(), cloud.size());
    });
    const auto [first, total] = detail::stretch(ranks, cloud);
    const bool named = ranks.count() > 1 || total == 0;
    detail::SharedFile::Room room{0, 8 + 17 * total, 20}; // the topology, as if it were not compressed
    detail::each_array(cloud, named, [&, n = total]<class T>(auto const&, std::span<T const>, std::size_t components) {
        room.rows += n * components * sizeof(T), ++room.objects;
    });
    detail::SharedFile shared(ranks, file, room,
                              [&, n = total](auto& outline) { detail::outline_vtkhdf(outline, cloud, named, n); });
    if (total > 0)
        shared.fill([&, from = first](detail::Hdf5Rows& rows) {
            detail::each_array(cloud, named, [&](std::string const& name, auto values, std::size_t components) {
                rows.write("VTKHDF/" + name, values, components, from);
            });
        });
    shared.finish({});
}
/// Of particles that are all here.
inline void write_vtkhdf(std::filesystem::path const& file, Cloud const& cloud)
{
    write_vtkhdf(TheseRanks(Alone{}), file, cloud);
}

/// DIRECTORY/NAME_000000.hdf, NAME_000001.hdf, ... and NAME.hdf.series, which tells ParaView their times.
class SnapshotSeries {
public:
    /// `times` are those of the snapshots already there when a run is continued: the next one gets number times.size().
    SnapshotSeries(std::filesystem::path directory, std::string name, std::vector<double> times = {})
        : directory_(std::move(directory)), name_(std::move(name)), times_(std::move(times))
    {
        const auto plain = [](char c) {
            return c != '/' && c != '"' && c != '\\' && static_cast<unsigned char>(c) >= ' ';
        };
        if (name_.empty() || !std::all_of(name_.begin(), name_.end(), plain))
            throw std::invalid_argument("spate: \"" + name_ +
                                        "\" cannot name a series of snapshots; use letters and digits");
        std::error_code error;
        std::filesystem::create_directories(directory_, error);
        if (error) throw OutputError(directory_, error.value());
    }

    /// Returns the file that holds the particles of all ranks, which all call it.
    std::filesystem::path write(AnyRanks const& ranks, Cloud cloud)
    {
        std::filesystem::path file = directory_ / file_name(times_.size());
        std::vector<double> times = times_;
        times.push_back(cloud.time);
        write_vtkhdf(ranks, file, std::move(cloud));
        ranks.together([&] {
            if (ranks.rank() == 0) detail::replace_file(directory_ / (name_ + ".hdf.series"), series(times));
        });
        times_ = std::move(times);
        return file;
    }
    /// Of particles that are all here.
    std::filesystem::path write(Cloud const& cloud) { return write(TheseRanks(Alone{}), cloud); }

    /// Of the snapshots written so far [s].
    std::vector<double> const& times() const { return times_; }
    /// The next snapshot follows those of these times; what comes after them is written over.
    void go_on_from(std::vector<double> times) { times_ = std::move(times); }

private:
    std::string file_name(std::size_t number) const
    {
        constexpr std::size_t digits = 6;
        const std::string tail = std::to_string(number);
        return name_ + "_" + std::string(digits - std::min(digits, tail.size()), '0') + tail + ".hdf";
    }

    std::string series(std::vector<double> const& times) const
    {
        std::string text = R"({"file-series-version":"1.0","files":[)";
        for (std::size_t k = 0; k < times.size(); ++k)
            text += std::string(k == 0 ? "\n" : ",\n") + R"({"name":")" + file_name(k) + R"(","time":)" +
                    detail::shortest(times[k]) + "}";
        return text + "\n]}\n";
    }

    std::filesystem::path directory_;
    std::string name_;
    std::vector<double> times_;
};

} // namespace spate::io
