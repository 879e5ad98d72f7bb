// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The version of the HDF5 that writes the files of a run.
#pragma once

#include <string>

namespace example {

std::string hdf5_version();

} // namespace example
