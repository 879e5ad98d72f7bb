// SPDX-License-Identifier: BSD-3-Clause
// What else the vortices can be computed with, beside the default.
#include "taylor_green.hpp"

namespace work_precision {
namespace {
/// Gradients corrected for how particles lie, and shifting that takes velocity and density along.
template <class K>
void add_corrected(std::string const& kernel, double h_dx)
{
    auto fluid = [](double h, double c0, double nu, Shifting const& shifting) {
        return wcsph(K{.h = h}, LinearEos{.rho0 = 1, .c0 = c0}, GradientCorrection{}, CorrectedContinuity{},
                     MolteniColagrossi{.delta = 0.1}, CorrectedPressureForce{}, CorrectedViscosity{.mu = nu},
                     ConsistentShifting{.mach = shifting.mach, .cfl = shifting.cfl});
    };
    add_vortices<SymplecticEuler, Double>(kernel, h_dx, "corrected+diffusion+shifting", fluid);
}
const bool added = [] {
    add_corrected<QuinticSpline<2>>("quintic_spline", 1);
    add_corrected<WendlandC2<2>>("wendland_c2", 2);
    const std::string quintic = "quintic_spline";
    add_shifted<1, QuinticSpline<2>, SymplecticEuler, Double>(quintic, 1);
    add_vortices<SymplecticEuler, Double>(
        quintic, 1, "sigma2+diffusion", [](double h, double c0, double nu, Shifting const&) {
            return wcsph(QuinticSpline<2>{.h = h}, LinearEos{.rho0 = 1, .c0 = c0}, Continuity<2>{},
                         MolteniColagrossi{.delta = 0.1}, PressureForce<2>{}, LaminarViscosity{.mu = nu, .eps = 0});
        });
    // The seed's: cubic spline at h = dx, Tait, eps = 0.01, midpoint, nothing else.
    add_vortices<RungeKutta2, Double>("cubic_spline", 1, "sigma2", [](double h, double c0, double nu, Shifting const&) {
        return wcsph(CubicSpline<2>{.h = h}, Tait{.rho0 = 1, .c0 = c0}, Continuity<2>{}, PressureForce<2>{},
                     LaminarViscosity{.mu = nu});
    });
    return true;
}();
} // namespace
} // namespace work_precision
