// SPDX-License-Identifier: BSD-3-Clause
#include "support/hdf5_version.hpp"

#include <spate/io/detail/hdf5_rows.hpp>

namespace example {

std::string hdf5_version()
{
    unsigned major = 0, minor = 0, release = 0;
    H5get_libversion(&major, &minor, &release);
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release) +
           (spate::io::detail::hdf5_knows_mpi ? " for MPI" : "");
}

} // namespace example
