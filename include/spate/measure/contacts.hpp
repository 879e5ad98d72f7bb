// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The contacts of grains, one by one.
#pragma once

#include "spate/core/vec.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <tuple>
#include <vector>

namespace spate {

/// Two grains that touch.
template <int Dim>
struct TouchingPair {
    std::uint32_t i, j;      ///< ids, i below j
    double overlap;          ///< [m]
    Vec<Dim, double> branch; ///< from the centre of j to that of i, across periodic faces [m]
    Vec<Dim, double> force;  ///< of j on i, all terms of contact together [N]
};

/// Each contact once, in the order of ids: the same list whoever ran the scene.
template <class Scene>
[[gnu::cold]] auto contacts(Scene& scene)
{
    using Pair = TouchingPair<Scene::dim>;
    struct List {
        std::vector<Pair> pairs;
        void operator+=(List const& b) { pairs.insert(pairs.end(), b.pairs.begin(), b.pairs.end()); }
    };
    scene.make_lists_current();
    auto const& id = scene.particles().id();
    auto list = scene.system().template over_contacts<List>(
        [&](List& l, std::size_t i, std::size_t j, auto const& x, auto const& ij, auto const& force) {
            if (id[i] < id[j]) l.pairs.push_back({id[i], id[j], ij.overlap, x, force});
        });
    const auto key = [](Pair const& p) { return std::tuple(p.i, p.j, p.branch[0], p.branch[Scene::dim - 1]); };
    std::sort(list.pairs.begin(), list.pairs.end(), [&](Pair const& a, Pair const& b) { return key(a) < key(b); });
    return list.pairs;
}

} // namespace spate
