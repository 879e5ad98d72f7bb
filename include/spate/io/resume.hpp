// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A scene goes on from a state, on any backend with the same bits: from a file (io/checkpoint_file.hpp) or from
///        state_of(scene).
#pragma once

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "spate/core/fields.hpp"
#include "spate/io/detail/checked_state.hpp"
#include "spate/io/state.hpp"
#include "spate/io/state_of.hpp"

namespace spate::io {

namespace detail {

template <class P>
[[gnu::cold]] void take_particles(State const& state, int s, P& p, auto fields)
{
    auto const& id = state.table<std::uint32_t>(of_species(s, "id"));
    p.resize(id.size());
    p.set_ids(id, std::uint32_t(state.one<std::int64_t>(of_species(s, "next_id"))));
    for_each(P::fields, [&]<class F>(F field) {
        if constexpr (!decltype(fields)::template contains<F>)
            for (auto& column : p.column(field)) std::fill(column.begin(), column.end(), typename P::real(0));
        else {
            auto const& values = state.table<typename P::real>(of_species(s, F::name), components<F, P::dim>);
            for (std::size_t k = 0, i = 0; i < id.size(); ++i)
                for (auto& column : p.column(field)) column[i] = values[k++];
        }
    });
}

/// Pairs of ids and values, as terms keep them.
template <class Pair, class T>
[[gnu::cold]] std::vector<Pair> pairs_of(State const& state, int s, int q)
{
    constexpr std::size_t count = std::tuple_size_v<decltype(Pair::value)>;
    auto const& ids = state.table<std::uint32_t>(of_pair(s, q, "ids"), 2);
    auto const& values = state.table<T>(of_pair(s, q, "value"), count);
    std::vector<Pair> pairs(ids.size() / 2);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        pairs[k].i = ids[2 * k], pairs[k].j = ids[2 * k + 1];
        std::copy_n(values.begin() + std::ptrdiff_t(k * count), count, pairs[k].value.begin());
    }
    return pairs;
}

inline std::vector<std::string> lines(std::string const& text)
{
    std::vector<std::string> all;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
}

} // namespace detail

/// The scene goes on from a state, and so do the outputs that it remembers. The scene has to be put together and filled as
/// it was at its start. Throws BadInput before anything changes if the state is not whole, or of another scene.
template <class Scene, class... Output>
[[gnu::cold]] void resume(Scene& scene, State const& state, Output&... outputs)
{
    using Engine = typename Scene::Engine;
    using M = typename Engine::M;
    const detail::Checked<Scene> checked(scene, state);
    detail::each_note(
        [&]<class N>(std::string const& name, N const&) {
            if (state.has(name)) (void)detail::noted<N>(state, name);
        },
        outputs...);
    auto fill = [&] {
        scene.system().each_species([&](auto s) {
            detail::take_particles(state, s(), scene.system().template species<s()>().particles,
                                   M::template lasting<s()>());
        });
        Scene::numbers_of(scene, [&]<class N>(std::string const& name, N& value) {
            value = N(state.one<detail::Stored<N>>("run/" + name));
        });
    };
    auto lists = [&](Engine& system) {
        system.restore_lists(
            checked.local(), [&](int s, auto const& place) { return checked.skin_of(std::size_t(s), place); },
            [&]<class Pair>(int s, int q, std::type_identity<Pair>) {
                return detail::pairs_of<Pair, typename Engine::T>(state, s, q);
            });
    };
    scene.resume(checked.grid_box(), state.text("run/criterion"), detail::lines(state.text("run/warnings")), fill,
                 lists);
    detail::each_note(
        [&]<class N>(std::string const& name, N& value) {
            if (state.has(name)) value = detail::noted<N>(state, name);
        },
        outputs...);
}

} // namespace spate::io
