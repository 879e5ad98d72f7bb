// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The policies that examples/run.sh chooses before an example is compiled, under names that a scene can use.
#pragma once

#include <concepts>

#include <spate/spate.hpp>

#ifndef SPATE_DIM
#define SPATE_DIM 3
#endif
#ifndef SPATE_KERNEL
#define SPATE_KERNEL CubicSpline
#endif
#ifndef SPATE_INTEGRATOR
#define SPATE_INTEGRATOR RungeKutta2
#endif
#ifndef SPATE_PRECISION
#define SPATE_PRECISION Double
#endif
#ifndef SPATE_WALL
#define SPATE_WALL                                                                                                     \
    Adami { .suction = false }
#endif
#ifndef SPATE_VISCOSITY
#define SPATE_VISCOSITY ArtificialViscosity
#endif
#ifndef SPATE_BACKEND
#define SPATE_BACKEND Threads
#endif
#define SPATE_ONE_WORD_OF(a, b) a##b
#define SPATE_ONE_WORD(a, b) SPATE_ONE_WORD_OF(a, b)
#define SPATE_USES_Mpi 1
#if SPATE_ONE_WORD(SPATE_USES_, SPATE_BACKEND)
#include <spate/backend/mpi.hpp>
#endif

namespace scene {

inline constexpr int dim = SPATE_DIM;
using Kernel = spate::SPATE_KERNEL<dim>;
using Integrator = spate::SPATE_INTEGRATOR;
using Precision = spate::SPATE_PRECISION;
inline constexpr auto wall = spate::SPATE_WALL;
#if SPATE_ONE_WORD(SPATE_USES_, SPATE_BACKEND)
using Backend = spate::Mpi<spate::Threads>;
#else
using Backend = spate::SPATE_BACKEND;
#endif
#undef SPATE_USES_Mpi
#undef SPATE_ONE_WORD
#undef SPATE_ONE_WORD_OF

#define SPATE_TEXT_OF(...) #__VA_ARGS__
#define SPATE_TEXT(...) SPATE_TEXT_OF(__VA_ARGS__)
inline constexpr char const* wall_text = SPATE_TEXT(SPATE_WALL);
#undef SPATE_TEXT
#undef SPATE_TEXT_OF

/// Smoothing length over spacing: Wendland's kernels are exact enough on wide supports only (docs/models).
inline constexpr double smoothing = Kernel::smoothing;

/// The viscosity chosen, with its own of the two numbers of a scene: alpha [-], or mu [Pa s].
template <class V = spate::SPATE_VISCOSITY>
V viscosity(double alpha, double mu)
{
    if constexpr (requires(V v) { v.mu; }) return {.mu = mu};
    else return {.alpha = alpha};
}

/// The backend with the numbers of the command line.
template <class B = Backend>
B backend(auto const& options)
{
    const int threads = options.threads, cell = options.cell;
    if constexpr (requires(B b) { b.count; }) return {.count = threads, .cell = cell};
    else if constexpr (requires(B b) { b.local.count; }) // one thread a process, unless more are asked for
        return {.local = {.count = threads == 0 ? 1 : threads},
                .cell = cell,
                .balance = {.every = options.balance == "off" ? 0 : options.balance_every}};
    else {
        spate::require(threads == 0 || threads == 1, "threads", threads, "0 or 1 with this backend");
        return {.cell = cell};
    }
}

/// Along the last axis, which points up: `Gravity<dim>{scene::down(9.81)}`.
inline spate::Vec<dim, double> down(double g)
{
    spate::Vec<dim, double> v{};
    v[dim - 1] = -g;
    return v;
}

} // namespace scene
