// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A table of tests/data: '#' lines name its source, then a line of column names, then rows.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace spate::oracle {

using Row = std::map<std::string, std::string>;

inline std::filesystem::path data_folder()
{
#ifdef SPATE_TEST_DATA
    return SPATE_TEST_DATA;
#else
    return std::filesystem::path(__FILE__).parent_path().parent_path() / "data";
#endif
}
inline std::vector<Row> table(std::string const& name)
{
    std::ifstream file(data_folder() / name);
    if (!file) throw std::runtime_error("no table " + (data_folder() / name).string());
    auto cells = [](std::string const& line) {
        std::vector<std::string> c;
        std::istringstream s(line);
        for (std::string cell; std::getline(s, cell, ',');) c.push_back(cell);
        return c;
    };
    std::vector<std::string> names;
    std::vector<Row> rows;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#') continue;
        const auto c = cells(line);
        if (names.empty()) {
            names = c;
            continue;
        }
        if (c.size() != names.size()) throw std::runtime_error("a row of " + name + " has another number of columns");
        for (std::size_t k = 0; k < c.size(); ++k)
            k == 0 ? rows.push_back({{names[k], c[k]}}) : void(rows.back()[names[k]] = c[k]);
    }
    return rows;
}

} // namespace spate::oracle
