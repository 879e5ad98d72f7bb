// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The one set of parameters for flows without a free surface; no case has numbers of its own.
#pragma once

#include <spate/spate.hpp>

#include <algorithm>
#include <cmath>

namespace models {

/// Quintic spline at h = dx; c0 ten times the fastest flow; C = 0.25. Shifting goes with the C = 1.5 of Sun et al. (2017), for a
/// step of 1.5 h/c0, so with 6 times the Courant number of the step that is taken, by sound or by viscosity.
/// \param sound  over the fastest flow; 10 but where the limit of it is looked for
template <int Dim = 2, class... Term>
auto internal_flow_at(double sound, double dx, double rho0, double nu, double fastest, Term... term)
{
    using namespace spate;
    const double c0 = sound * fastest, courant = std::min(0.25, 0.125 * c0 * dx / nu);
    return wcsph(QuinticSpline<Dim>{.h = dx}, LinearEos{.rho0 = rho0, .c0 = c0}, Continuity<2>{},
                 MolteniColagrossi{.delta = 0.1}, PressureForce<2>{}, LaminarViscosity{.mu = rho0 * nu, .eps = 0},
                 Shifting{.mach = fastest / c0, .cfl = 6 * courant}, term...);
}

template <int Dim = 2, class... Term>
auto internal_flow(double dx, double rho0, double nu, double fastest, Term... term)
{
    return internal_flow_at<Dim>(10, dx, rho0, nu, fastest, term...);
}

/// The same for flows without walls, with gradients and viscosity corrected for how particles lie, and shifting that takes
/// velocity and density along; Wendland C2 at h = 2 dx.
inline auto corrected_flow_at(double sound, double dx, double rho0, double nu, double fastest)
{
    using namespace spate;
    const double c0 = sound * fastest, h = 2 * dx, courant = std::min(0.25, 0.125 * c0 * h / nu);
    return wcsph(WendlandC2<2>{.h = h}, LinearEos{.rho0 = rho0, .c0 = c0}, GradientCorrection{}, CorrectedContinuity{},
                 MolteniColagrossi{.delta = 0.1}, CorrectedPressureForce{}, CorrectedViscosity{.mu = rho0 * nu},
                 ConsistentShifting{.mach = fastest / c0, .cfl = 6 * courant});
}

/// The slope of the error over two halvings of the spacing.
inline double order(double coarse, double fine) { return std::log2(coarse / fine) / 2; }

/// Largest distance of a point of a box from the nearest particle [spacings]: at most 0.71 on the lattice, above 1 in a void.
template <class Scene>
double emptiest(Scene const& s, spate::Box<2> const& box, double dx)
{
    auto const& p = s.particles();
    double most = 0;
    for (double x = box.lo[0] + dx / 4; x < box.hi[0]; x += dx / 2)
        for (double y = box.lo[1] + dx / 4; y < box.hi[1]; y += dx / 2) {
            double least = box.size().squaredNorm();
            for (std::size_t i = 0; i < p.size(); ++i) {
                const auto d =
                    spate::nearest_image(spate::Vec<2, double>{x, y} - p.at(spate::position, i), s.system().grid());
                least = std::min(least, d.squaredNorm());
            }
            most = std::max(most, least);
        }
    return std::sqrt(most) / dx;
}

} // namespace models
