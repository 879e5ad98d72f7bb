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
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "spate/io/cloud.hpp"
#include "spate/io/detail/hdf5.hpp"
#include "spate/io/detail/replace_file.hpp"
#include "spate/io/output_error.hpp"

namespace spate::io {

namespace detail {

/// Memory of the arrays that are stored as they are.
inline std::size_t bytes(Cloud const& cloud)
{
    std::size_t sum =
        cloud.points.size() * sizeof(float) + cloud.id.size() * sizeof(std::int64_t) + cloud.species.size();
    for (Column const& column : cloud.columns) sum += column.values.size() * sizeof(float);
    for (IntegerColumn const& column : cloud.integers) sum += column.values.size() * sizeof(std::int64_t);
    return sum;
}

template <class T>
std::span<T const> view(std::vector<T> const& values)
{
    return values;
}

/// One VTK_VERTEX a particle, in one partition: Threshold, Clip and selections of VTK work on cells.
inline void write_topology(Hdf5Image const& image, hid_t vtk, std::size_t n)
{
    const std::array<std::int64_t, 1> count{static_cast<std::int64_t>(n)};
    for (auto* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
        image.dataset(vtk, name, std::span<std::int64_t const>(count));
    std::vector<std::int64_t> offsets(n + 1);
    std::iota(offsets.begin(), offsets.end(), std::int64_t{0});
    const std::vector<std::uint8_t> types(n, 1);
    image.dataset(vtk, "Connectivity", view(offsets).first(n), 1, true);
    image.dataset(vtk, "Offsets", view(offsets), 1, true);
    image.dataset(vtk, "Types", view(types), 1, true);
}

inline void write_point_data(Hdf5Image const& image, hid_t vtk, Cloud const& cloud)
{
    const Hdf5Group group = image.group(vtk, "PointData");
    for (Column const& column : cloud.columns)
        image.dataset(group, column.name, view(column.values), static_cast<std::size_t>(column.components));
    for (IntegerColumn const& column : cloud.integers) image.dataset(group, column.name, view(column.values));
    if (!cloud.id.empty() || cloud.size() == 0) image.dataset(group, "id", view(cloud.id));
    if (!cloud.species.empty() || cloud.size() == 0) image.dataset(group, "species", view(cloud.species));
}

inline void write_field_data(Hdf5Image const& image, hid_t vtk, Cloud const& cloud)
{
    const Hdf5Group group = image.group(vtk, "FieldData");
    image.dataset(group, "TimeValue", std::span<double const>(&cloud.time, 1));
    image.dataset(group, "step", std::span<std::int64_t const>(&cloud.step, 1));
}

inline std::vector<std::byte> vtkhdf_bytes(std::filesystem::path const& file, Cloud const& cloud)
{
    const Hdf5Image image(file, bytes(cloud));
    const Hdf5Group vtk = image.group(image.root(), "VTKHDF");
    constexpr std::array<std::int64_t, 2> version{1, 0};
    image.attribute(vtk, "Version", std::span<std::int64_t const>(version));
    image.attribute(vtk, "Type", "UnstructuredGrid");
    image.dataset(vtk, "Points", view(cloud.points), 3);
    write_topology(image, vtk, cloud.size());
    write_point_data(image, vtk, cloud);
    write_field_data(image, vtk, cloud);
    return image.bytes();
}

/// The shortest decimal that reads back as the same double, in any locale.
inline std::string shortest(double value)
{
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

} // namespace detail

/// Name the file *.hdf: ParaView 5.11 opens no other. Throws OutputError, and the file is then what it was before.
inline void write_vtkhdf(std::filesystem::path const& file, Cloud const& cloud)
{
    detail::check_cloud(cloud);
    detail::replace_file(file, detail::vtkhdf_bytes(file, cloud));
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

    /// Returns the file that holds the cloud.
    std::filesystem::path write(Cloud const& cloud)
    {
        std::filesystem::path file = directory_ / file_name(times_.size());
        write_vtkhdf(file, cloud);
        std::vector<double> times = times_;
        times.push_back(cloud.time);
        detail::replace_file(directory_ / (name_ + ".hdf.series"), series(times));
        times_ = std::move(times);
        return file;
    }

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
