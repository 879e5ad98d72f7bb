// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief All that a run needs to go on, as named tables of numbers and texts: what a checkpoint holds.
///        Not the file (io/checkpoint_file.hpp), and not what of a scene goes into it (io/state_of.hpp).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "spate/core/errors.hpp"

namespace spate::io {

/// Numbers in rows of a few columns.
struct Table {
    std::variant<std::vector<float>, std::vector<double>, std::vector<std::int32_t>, std::vector<std::int64_t>,
                 std::vector<std::uint32_t>>
        values;
    std::size_t columns = 1;

    [[nodiscard]] std::size_t size() const
    {
        return std::visit([](auto const& v) { return v.size(); }, values);
    }
    bool operator==(Table const&) const = default;
};

/// Tables and texts by name; a name such as "species_0/position" has the folder first.
struct State {
    std::string origin = "state"; ///< where it comes from: what a refusal names
    std::map<std::string, Table> tables;
    std::map<std::string, std::string> texts;

    template <class T>
    void put(std::string const& name, std::vector<T> values, std::size_t columns = 1)
    {
        tables[name] = {std::move(values), columns};
    }
    /// An empty table, to be filled.
    template <class T>
    [[nodiscard]] std::vector<T>& fresh(std::string const& name, std::size_t columns)
    {
        put(name, std::vector<T>{}, columns);
        return *std::get_if<std::vector<T>>(&tables[name].values);
    }
    template <class T>
    void put_one(std::string const& name, T value)
    {
        put(name, std::vector<T>{value});
    }
    [[noreturn, gnu::cold]] void refuse(std::string const& why) const
    {
        throw BadInput(origin, why, "a whole checkpoint of this scene");
    }
    [[nodiscard]] std::string const& text(std::string const& name) const
    {
        const auto found = texts.find(name);
        if (found == texts.end()) refuse("without " + name);
        return found->second;
    }
    [[nodiscard]] bool has(std::string const& name) const { return tables.count(name) > 0; }
    /// The numbers of a table of this type and shape.
    template <class T>
    [[nodiscard]] std::vector<T> const& table(std::string const& name, std::size_t columns = 1) const
    {
        const auto found = tables.find(name);
        if (found == tables.end()) refuse("without " + name);
        auto const* values = std::get_if<std::vector<T>>(&found->second.values);
        if (values == nullptr || found->second.columns != columns) refuse("with a " + name + " of another type");
        return *values;
    }
    template <class T>
    [[nodiscard]] std::vector<T> const& table(std::string const& name, std::size_t columns, std::size_t rows) const
    {
        auto const& values = table<T>(name, columns);
        if (values.size() != rows * columns) refuse("with a " + name + " of another length than is due");
        return values;
    }
    template <class T>
    [[nodiscard]] T one(std::string const& name) const
    {
        return table<T>(name, 1, 1)[0];
    }
};

} // namespace spate::io
