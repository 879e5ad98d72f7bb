// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The interaction of smoothed particles: every pair within the kernel's support.
#pragma once

#include "spate/cells/neighbours.hpp"
#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/kernel/kernel.hpp"

namespace spate {

/// What a term sees of a pair of smoothed particles.
template <int Dim, class V>
struct SmoothedPair {
    Vec<Dim, V> x;        ///< x_i - x_j [m]
    V r2;                 ///< |x|^2 [m^2]
    V h;                  ///< smoothing length [m]
    V over_r2;            ///< 1/(|x|^2 + 0.01 h^2), finite at r = 0 [m^-2] (Monaghan 1992, eq. 4.2)
    V w;                  ///< W(|x|, h) [m^-dim]
    Along<Dim, V> grad_w; ///< gradient of W with respect to x_i [m^-(dim+1)]
};

template <class K>
struct Smoothing {
    static_assert(Kernel<K>,
                  "spate: Smoothing needs a kernel: dim, h, radius, sigma(), f(q), g(q); see kernel/kernel.hpp");
    static constexpr int dim = K::dim;
    static constexpr Fields reads{position};
    /// Long lists: a skin by place, and blocks of like length.
    static constexpr Neighbours neighbours{.skin = 0.12, .local = true};
    K kernel;

    [[nodiscard]] double range() const { return K::radius * kernel.h; }
    /// Length of the time-step criteria [m].
    [[nodiscard]] double length() const { return kernel.h; }
    [[gnu::cold]] void check() const { require_positive("kernel.h", kernel.h, "m"); }
    /// Whether h is left to the spacing.
    [[nodiscard]] bool open() const
    {
        if constexpr (requires { K::smoothing; }) return kernel.h == from_spacing;
        else return false;
    }
    void complete(double spacing)
    {
        if constexpr (requires { K::smoothing; }) kernel.h = K::smoothing * spacing;
    }

    template <class V>
    [[gnu::always_inline]] auto pair(auto const& i, auto const& j) const
    {
        SmoothedPair<dim, V> ij; // built in place: g++ keeps it in registers
        ij.x = i[position] - j[position];
        ij.r2 = ij.x.squaredNorm();
        ij.h = V(kernel.h);
        ij.over_r2 = 1 / (ij.r2 + V(0.01 * kernel.h * kernel.h));
        const V q = sqrt(ij.r2) * V(1 / kernel.h);
        const V s = V(kernel.sigma());
        ij.w = s * K::f(q);
        const V unit = V(kernel.sigma() / (kernel.h * kernel.h));
        if constexpr (requires { K::g(q, q); })
            ij.grad_w.F = unit * K::g(q, q * (V(kernel.h * kernel.h) * (1 / ij.r2))); // divides beside the root
        else ij.grad_w.F = unit * K::g(q);
        ij.grad_w.x = i[position] - j[position]; // not a copy of ij.x: g++ would send it through the stack
        return ij;
    }
};

} // namespace spate
