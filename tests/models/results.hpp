// SPDX-License-Identifier: BSD-3-Clause
// Where the tests of models leave their curves: in the folder SPATE_RESULTS, if the environment names one.
#pragma once

#include <cstdlib>
#include <fstream>
#include <string>

namespace models {

/// An open table, or a stream that swallows all.
inline std::ofstream results(std::string const& name, std::string const& header)
{
    std::ofstream file;
    if (const char* folder = std::getenv("SPATE_RESULTS")) {
        file.open(std::string(folder) + "/" + name);
        file << header << '\n';
    }
    return file;
}

} // namespace models
