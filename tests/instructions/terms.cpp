// SPDX-License-Identifier: BSD-3-Clause
// Sweeps of one fluid with more and more terms: check.sh counts the instructions of each inner loop.
#include <spate/spate.hpp>

using namespace spate;

template <class... T>
void sweep(T... more)
{
    const auto water =
        wcsph(CubicSpline<3>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 20}, Continuity<2>{}, PressureForce<2>{}, more...);
    using S = System<std::remove_cv_t<decltype(water)>, Open, Serial, Double>;
    S s(water, Open{}, Serial{}, Neighbours{}, false);
    s.rebuild();
    s.rates(S::all);
}
template void sweep();
template void sweep(LaminarViscosity);
template void sweep(ArtificialViscosity);
template void sweep(DensityDiffusion);
template void sweep(ArtificialViscosity, DensityDiffusion);
template void sweep(MonaghanCleary<3>);
template void sweep(TensileCorrection);
template void sweep(Xsph);
