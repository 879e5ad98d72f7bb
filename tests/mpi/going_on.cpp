// SPDX-License-Identifier: BSD-3-Clause
#include "mpi/going_on.hpp"

namespace going_on {

template End run<Column>(Serial, std::int64_t, io::State const*, Keep const&);
template End run<Hopper>(Serial, std::int64_t, io::State const*, Keep const&);
template End run<Column>(Processes, std::int64_t, io::State const*, Keep const&);
template End run<Hopper>(Processes, std::int64_t, io::State const*, Keep const&);

} // namespace going_on
