// SPDX-License-Identifier: BSD-3-Clause
// Features that join the loop over pairs that is there anyway.
#include "anatomy.hpp"

namespace work_precision {
namespace {
const bool added = [] {
    add_feature<Double>("base");
    add_feature<Double>("+LaminarViscosity", LaminarViscosity{.mu = 1e-3});
    add_feature<Double>("+MonaghanCleary", MonaghanCleary<3>{.mu = 1e-3});
    add_feature<Double>("+ArtificialViscosity", ArtificialViscosity{.alpha = 0.02});
    add_feature<Double>("+MolteniColagrossi", MolteniColagrossi{.delta = 0.1});
    add_feature<Double>("+DensityDiffusion", DensityDiffusion{.delta = 0.1});
    return true;
}();
} // namespace
} // namespace work_precision
