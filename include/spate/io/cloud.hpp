// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The particles as columns of numbers, for a file or another program: what a snapshot holds.
///        Not the particles of a run: those are core/particles.hpp.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace spate::io {

/// A field of the particles; a vector in 2D is padded with z = 0.
struct Column {
    std::string name = {};
    int components = 1; ///< 1 or 3
    std::vector<float> values = {};
};

struct IntegerColumn {
    std::string name = {};
    std::vector<std::int64_t> values = {};
};

struct Cloud {
    double time = 0; ///< [s]
    std::int64_t step = 0;
    std::vector<float> points = {}; ///< N x 3, padded with z = 0 in 2D  [m]
    std::vector<Column> columns = {};
    std::vector<std::int64_t> id = {};      ///< N, or empty: not written
    std::vector<std::uint8_t> species = {}; ///< N, or empty: not written
    std::vector<IntegerColumn> integers = {};

    std::size_t size() const { return points.size() / 3; }
};

namespace detail {

inline void check_size(std::string const& name, std::size_t size, std::size_t expected)
{
    if (size == expected) return;
    throw std::invalid_argument("spate: snapshot column \"" + name + "\" holds " + std::to_string(size) +
                                " numbers where its particles need " + std::to_string(expected));
}

/// VTK cannot read a file with such a name at all.
inline void check_name(std::string const& name, std::set<std::string>& taken)
{
    if (name.empty() || name.find_first_of("/.") != std::string::npos)
        throw std::invalid_argument("spate: snapshot column \"" + name + "\" needs a name without '/' and '.'");
    if (!taken.insert(name).second)
        throw std::invalid_argument("spate: two snapshot columns are called \"" + name + "\"; rename one");
}

inline void check_cloud(Cloud const& cloud)
{
    const std::size_t n = cloud.size();
    std::set<std::string> taken{"id", "species"};
    if (!std::isfinite(cloud.time)) throw std::invalid_argument("spate: the time of a snapshot is not a finite number");
    check_size("points", cloud.points.size(), 3 * n);
    if (!cloud.id.empty()) check_size("id", cloud.id.size(), n);
    if (!cloud.species.empty()) check_size("species", cloud.species.size(), n);
    for (Column const& column : cloud.columns) {
        check_name(column.name, taken);
        if (column.components != 1 && column.components != 3)
            throw std::invalid_argument("spate: snapshot column \"" + column.name + "\" needs 1 or 3 components, not " +
                                        std::to_string(column.components));
        check_size(column.name, column.values.size(), n * static_cast<std::size_t>(column.components));
    }
    for (IntegerColumn const& column : cloud.integers) {
        check_name(column.name, taken);
        check_size(column.name, column.values.size(), n);
    }
}

} // namespace detail

} // namespace spate::io
