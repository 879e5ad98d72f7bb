// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What a sensor at a fixed point reads: the mean of a field over the particles around it.
#pragma once

#include "spate/core/fields.hpp"
#include "spate/core/ranks.hpp"
#include "spate/core/reduction.hpp"
#include "spate/measure/nearest_image.hpp"

#include <array>
#include <limits>
#include <string>

namespace spate {

/// Shepard's mean (1968) with the model's kernel over the mobile particles: sum_j V_j F_j W(x - x_j) / sum_j V_j W(x - x_j),
/// V = m/rho. Of order 0: a sensor on a wall reads the fluid about half a support away from it. NaN where it sees nothing.
/// Derived fields are those of the last evaluation: refresh() the scene before.
template <Field F, int Dim>
struct Probe {
    std::string name;
    F field;
    Vec<Dim, double> at; ///< [m]

    [[gnu::cold]] Value<F, Dim, double> operator()(auto const& scene) const
    {
        auto const& p = scene.particles();
        auto const& interaction = scene.physics().interaction;
        auto const& kernel = interaction.kernel;
        const double reach2 = interaction.range() * interaction.range();
        std::array<ExactSum, std::size_t(1 + components<F, Dim>)> sums; // weights, and each component
        for (std::size_t i = 0; i < p.size(); ++i) {
            const double r2 = nearest_image(at - p.at(position, i), scene.system().grid()).squaredNorm();
            if (!(r2 < reach2)) continue;
            const double w = p.at(mass, i) / p.at(density, i) * kernel.f(std::sqrt(r2) / kernel.h);
            const auto value = w * p.at(field, i);
            sums[0].add(w);
            if constexpr (F::rank == 0) sums[1].add(value);
            else
                for (int c = 0; c < Dim; ++c) sums[std::size_t(1 + c)].add(value[c]);
        }
        party_of(scene).each(sums, agree::Sum{});
        const double weight = sums[0].value();
        if (!(weight > 0)) return all(std::numeric_limits<double>::quiet_NaN());
        auto mean = all(0);
        if constexpr (F::rank == 0) mean = sums[1].value() / weight;
        else
            for (int c = 0; c < Dim; ++c) mean[c] = sums[std::size_t(1 + c)].value() / weight;
        return mean;
    }

private:
    static Value<F, Dim, double> all(double value)
    {
        Value<F, Dim, double> v;
        if constexpr (F::rank == 0) v = value;
        else
            for (int c = 0; c < components<F, Dim>; ++c) v[c] = value;
        return v;
    }
};
template <Field F, int Dim>
Probe(std::string, F, Vec<Dim, double>) -> Probe<F, Dim>;
template <Field F, int Dim>
Probe(char const*, F, Vec<Dim, double>) -> Probe<F, Dim>;

} // namespace spate
