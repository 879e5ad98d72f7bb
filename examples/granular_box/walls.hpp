// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The walls that examples/run.sh chooses: they reflect, or push as the grains do.
#pragma once

#include <spate/boundary/contact.hpp>

#ifndef SPATE_GRAIN_WALLS
#define SPATE_GRAIN_WALLS Elastic
#endif

namespace granular {

struct Elastic {
    static auto with(auto const&...) { return spate::open(spate::nowhere); } // faces are mirrors unless they are named
};
struct Spring {
    static auto with(auto const&... term) { return spate::contact(term...); }
};
using Faces = SPATE_GRAIN_WALLS;

} // namespace granular
