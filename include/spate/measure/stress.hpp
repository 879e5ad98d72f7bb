// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The stress in a bed of grains, from its contacts and from the motion of grains against each other.
#pragma once

#include "spate/core/box.hpp"
#include "spate/core/fields.hpp"
#include "spate/core/reduction.hpp"

#include <Eigen/Core>

#include <array>
#include <string>

namespace spate {

namespace detail {
/// One exact sum for each component.
template <int Dim>
struct ExactTensor {
    std::array<ExactSum, std::size_t(Dim* Dim)> of;
    void add(double factor, Vec<Dim, double> const& a, Vec<Dim, double> const& b)
    {
        for (int c = 0; c < Dim; ++c)
            for (int d = 0; d < Dim; ++d) of[std::size_t(c * Dim + d)].add(factor * (a[c] * b[d]));
    }
    void operator+=(ExactTensor const& b)
    {
        for (std::size_t k = 0; k < of.size(); ++k) of[k] += b.of[k];
    }
    [[nodiscard]] Eigen::Matrix<double, Dim, Dim> value() const
    {
        Eigen::Matrix<double, Dim, Dim> m;
        for (int c = 0; c < Dim; ++c)
            for (int d = 0; d < Dim; ++d) m(c, d) = of[std::size_t(c * Dim + d)].value();
        return m;
    }
};
} // namespace detail

/// Of the grains whose centres are in a box (Christoffersen, Mehrabadi & Nemat-Nasser 1981; Luding 2008), pressure positive:
/// sigma_ab = (sum_i m (v - u)_a (v - u)_b + 1/2 sum_i sum_j f_ij,a x_ij,b) / V, u the mean velocity by mass, f_ij the force
/// on i, x_ij = x_i - x_j; a contact through the face of the box counts half. `Stress{box}`; docs/models/dem.md.
template <int Dim>
struct Stress {
    Box<Dim> box; ///< [m]
    std::string name = "stress";

    Eigen::Matrix<double, Dim, Dim> operator()(auto& scene) const // [Pa], in 2D [N/m]
    {
        scene.make_lists_current();
        auto const& p = scene.particles();
        auto const& grid = scene.system().grid();
        const auto inside = [&](std::size_t i) {
            auto x = p.at(position, i);
            for (int c = 0; c < Dim; ++c) x[c] = grid.wrapped(c, x[c]);
            return box.contains(x);
        };
        auto sum = scene.system().template over_contacts<detail::ExactTensor<Dim>>(
            [&](auto& to, std::size_t i, std::size_t, auto const& x, auto const&, auto const& force) {
                if (inside(i)) to.add(0.5, force, x);
            });
        const auto total = [&](auto const& f) {
            return scene.system().sum([&](std::size_t i) { return inside(i) ? f(i) : 0.0; });
        };
        const double m = total([&](std::size_t i) { return p.at(mass, i); });
        Vec<Dim, double> u{};
        for (int c = 0; c < Dim && m > 0; ++c)
            u[c] = total([&](std::size_t i) { return p.at(mass, i) * p.at(velocity, i)[c]; }) / m;
        for (std::size_t i = 0; i < p.size(); ++i)
            if (inside(i)) sum.add(p.at(mass, i), p.at(velocity, i) - u, p.at(velocity, i) - u);
        double volume = 1;
        for (int c = 0; c < Dim; ++c) {
            require_positive(along_axis("Stress.box length", c), box.size()[c], "m");
            volume *= box.size()[c];
        }
        return sum.value() / volume;
    }
};
template <int Dim>
Stress(Box<Dim>) -> Stress<Dim>;
template <int Dim, class Name>
Stress(Box<Dim>, Name) -> Stress<Dim>;

} // namespace spate
