// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Terms of a contact that differ by the pair of materials.
#pragma once

#include "spate/core/term.hpp"
#include "spate/physics/dem/dissipation.hpp"
#include "spate/physics/dem/normal_law.hpp"

#include <array>

namespace spate {

/// 0, 1, 2, ...: of which material a grain is.
inline constexpr struct Material : ScalarField {
    static constexpr std::string_view name = "material", unit = "-";
} material{};

/// One term for each pair of N materials: (0, 0), (1, 0), (1, 1), (2, 0), ...; only pairs that meet are computed.
template <class T, int N>
struct ByMaterial {
    static constexpr int count = N * (N + 1) / 2;
    static constexpr auto reads = Fields{material} | detail::reads_both<T>();
    static constexpr auto reads_i = detail::only_i<T>(), reads_j = detail::only_j<T>();
    static constexpr auto adds = spate::adds<T>(), keeps = spate::keeps<T>();
    static constexpr bool stores_energy = requires { requires T::stores_energy; };
    std::array<T, std::size_t(count)> of;

    [[gnu::cold]] void check() const
    {
        for (auto const& t : of)
            if constexpr (requires { t.check(); }) t.check();
    }
    [[nodiscard]] double contact_frequency(auto... grain) const
        requires(requires(T t) { t.contact_frequency(grain...); })
    {
        double most = 0;
        for (auto const& t : of) most = std::max(most, t.contact_frequency(grain...));
        return most;
    }
    [[nodiscard]] double energy(auto const& i, auto const& j, auto const& ij) const requires(stores_energy)
    {
        const auto a = std::size_t(std::max(i[material], j[material])),
                   b = std::size_t(std::min(i[material], j[material]));
        auto const& t = of[a * (a + 1) / 2 + b];
        if constexpr (requires { t.energy(i, j, ij); }) return t.energy(i, j, ij);
        else return t.energy(ij);
    }
    void operator()(auto& i, auto const& j, auto const& ij) const requires PairTerm<T>
    {
        using M = std::remove_cvref_t<decltype(i.mask)>;
        auto both = [](auto const& x, auto const& y, int of_x, int of_y) __attribute__((always_inline))
        {
            return M((x[material] == of_x) & (y[material] == of_y));
        };
        std::size_t k = 0;
        for (int a = 0; a < N; ++a)
            for (int b = 0; b <= a; ++b, ++k) {
                auto mine = i;
                mine.mask = M(i.mask & (both(i, j, a, b) | both(i, j, b, a)));
                if (spate::any(mine.mask)) of[k](mine, j, ij);
            }
    }
};
/// `by_material(LinearSpring{.k = 1e5}, LinearSpring{.k = 2e4}, LinearSpring{.k = 1e4})`.
template <class T, class... More>
auto by_material(T first, More... more)
{
    constexpr int count = 1 + int(sizeof...(More));
    constexpr int N = count == 1 ? 1 : count == 3 ? 2 : count == 6 ? 3 : count == 10 ? 4 : 0;
    static_assert(
        N > 0 && (std::same_as<T, More> && ...),
        "spate: by_material takes one term of a kind for each pair of materials: (0, 0), (1, 0), (1, 1), (2, 0), "
        "...: 3 for two materials, 6 for three");
    return ByMaterial<T, N>{{first, more...}};
}

namespace detail {
template <class T>
inline constexpr int materials = 0;
template <class T, int N>
inline constexpr int materials<ByMaterial<T, N>> = N;

/// Pair k of the materials: its own term, or that of all pairs.
template <class T>
auto const& of_pair(T const& t, std::size_t k)
{
    if constexpr (materials < T >> 0) return t.of[k];
    else return t;
}
template <std::size_t k, class T, class... All>
auto completed_pair(T const& t, All const&... all)
{
    return completed(of_pair(t, k), of_pair(all, k)...);
}
template <class T, class... All, std::size_t... k>
auto completed_pairs(std::index_sequence<k...>, T const& t, All const&... all)
{
    return by_material(completed_pair<k>(t, all...)...);
}
/// A term completed by the others; where some differ by pair of N materials, pair by pair.
template <int N, class T, class... All>
auto completed_in(T const& t, All const&... all)
{
    if constexpr (N == 0) return completed(t, all...);
    else if constexpr (materials<T> == 0 && !requires { t.with(of_pair(all, 0)...); }) return t;
    else {
        static_assert(materials<T> == 0 || materials<T> == N,
                      "spate: terms by_material are for one number of materials");
        return completed_pairs(std::make_index_sequence<std::size_t(N * (N + 1) / 2)>{}, t, all...);
    }
}
template <class... T>
inline constexpr int most_materials = [] {
    int most = 0;
    ((most = materials<T> > most ? materials<T> : most), ...);
    return most;
}();
} // namespace detail

} // namespace spate
