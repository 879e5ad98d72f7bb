// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief From a scene to the state that a run needs to go on: global arrays by id or by place, without a trace of who held
///        what. Not the way back (io/resume.hpp), not the file (io/checkpoint_file.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cxxabi.h>
#include <memory>
#include <numeric>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <typeinfo>
#include <vector>

#include "spate/core/fields.hpp"
#include "spate/io/state.hpp"

namespace spate::io {

namespace detail {

template <class T>
[[gnu::cold]] std::string name_of_type()
{
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> name(abi::__cxa_demangle(typeid(T).name(), nullptr, nullptr, &status),
                                                      std::free);
    return status == 0 ? name.get() : typeid(T).name();
}

inline std::string numbered(std::string text, int k)
{
    text += std::to_string(k);
    return text;
}

/// What the scene is put together from, as texts and numbers; the backend is not part of it.
template <class Scene>
[[gnu::cold]] State description(Scene const& scene)
{
    using Real = typename Scene::Engine::T;
    State d;
    d.texts["scene/real"] = name_of_type<Real>();
    d.texts["scene/interaction"] = name_of_type<std::remove_cvref_t<decltype(scene.physics().interaction)>>();
    d.texts["scene/integrator"] = name_of_type<std::remove_cvref_t<decltype(scene.integrator())>>();
    d.texts["scene/boundary"] = name_of_type<std::remove_cvref_t<decltype(scene.system().boundary())>>();
    int k = 0;
    auto term = [&]<class X>(X const&) { d.texts[numbered("scene/term ", k++)] = name_of_type<X>(); };
    std::apply([&](auto const&... t) { (term(t), ...); }, scene.physics().terms);
    scene.each_parameter([&](std::string const& name, auto value) { d.put_one("scene/" + name, double(value)); });
    scene.system().each_species([&](auto s) {
        using P = std::remove_cvref_t<decltype(scene.system().template species<s()>().particles)>;
        d.texts[numbered("scene/fields of species ", s())] = to_string(P::fields);
    });
    return d;
}

/// Numbers that may be saved: bool and integers as 64 bits.
template <class T>
using Stored = std::conditional_t<std::is_integral_v<T>, std::int64_t, T>;

inline std::string of_species(int s, std::string_view what)
{
    std::string name = "species_";
    name += std::to_string(s);
    name += '/';
    name += what;
    return name;
}
inline std::string of_pair(int s, int q, std::string_view what)
{
    std::string name = "pairs_";
    name += std::to_string(s);
    name += '_';
    name += std::to_string(q);
    name += '/';
    name += what;
    return name;
}

template <class P>
[[gnu::cold]] void put_particles(State& state, int s, P const& p, auto fields)
{
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p.id()[a] < p.id()[b]; });
    std::vector<std::uint32_t> id;
    for (const std::size_t i : order) id.push_back(p.id()[i]);
    state.put(of_species(s, "id"), std::move(id));
    state.put_one(of_species(s, "next_id"), std::int64_t(p.next_id()));
    for_each(fields, [&]<class F>(F field) {
        std::vector<typename P::real> values;
        values.reserve(order.size() * components<F, P::dim>);
        for (const std::size_t i : order)
            for (auto const& column : p.column(field)) values.push_back(column[i]);
        state.put(of_species(s, F::name), std::move(values), components<F, P::dim>);
    });
}

template <class System>
[[gnu::cold]] void put_skins(State& state, System const& system)
{
    constexpr auto dim = std::size_t(System::dim);
    system.each_species([&](auto s) {
        std::vector<std::pair<std::array<std::int32_t, dim>, double>> skins;
        system.each_skin([&](int of, std::array<std::int32_t, dim> const& place, double skin) {
            if (of == s()) skins.emplace_back(place, skin);
        });
        std::sort(skins.begin(), skins.end());
        std::vector<std::int32_t> places;
        std::vector<double> skin;
        for (auto const& [place, value] : skins)
            places.insert(places.end(), place.begin(), place.end()), skin.push_back(value);
        state.put(of_species(s(), "skin_place"), std::move(places), dim);
        state.put(of_species(s(), "skin"), std::move(skin));
    });
}

template <class System>
[[gnu::cold]] void put_pairs(State& state, System const& system)
{
    system.each_kept([&](int s, int q, auto const& pairs) {
        using Value = decltype(pairs.front().value);
        std::vector<std::uint32_t> ids;
        std::vector<typename Value::value_type> values;
        for (auto const& pair : pairs) {
            ids.push_back(pair.i), ids.push_back(pair.j);
            values.insert(values.end(), pair.value.begin(), pair.value.end());
        }
        state.put(of_pair(s, q, "ids"), std::move(ids), 2);
        state.put(of_pair(s, q, "value"), std::move(values), std::tuple_size_v<Value>);
    });
}

/// What an output has to remember: notes(f) calls f(name, number) or f(name, numbers).
template <class O>
concept Remembers = requires(O& o)
{
    o.notes([](std::string const&, auto&) {});
};
/// f(name, what an output has to remember): outputs are known by their place.
template <class... Output>
[[gnu::cold]] void each_note(auto const& f, Output&... outputs)
{
    [[maybe_unused]] int k = 0;
    [[maybe_unused]] auto one = [&]<class O>(O& output) {
        const std::string folder = numbered("output_", k++) + "/";
        if constexpr (Remembers<O>)
            output.notes([&](std::string const& name, auto& value) { f(folder + name, value); });
    };
    (one(outputs), ...);
}
template <class N>
[[gnu::cold]] N noted(State const& state, std::string const& name)
{
    if constexpr (std::is_arithmetic_v<N>) return N(state.one<Stored<N>>(name));
    else return state.table<typename N::value_type>(name);
}

} // namespace detail

/// All that the scene needs to go on, and what outputs have to remember. Of a scene that a Stop has ended: all fields, to
/// look at.
template <class Scene, class... Output>
[[gnu::cold]] State state_of(Scene& scene, Output&... outputs)
{
    using M = typename Scene::Engine::M;
    if (!scene.prepared()) scene.prepare();
    State state = detail::description(scene);
    Scene::numbers_of(scene, [&]<class N>(std::string const& name, N const& value) {
        state.put_one("run/" + name, detail::Stored<N>(value));
    });
    state.put_one("run/stopped", std::int64_t(scene.stopped()));
    state.texts["run/criterion"] = scene.criterion();
    for (auto const& warning : scene.report().warnings) state.texts["run/warnings"] += warning + "\n";
    state.texts["run/warnings"] += "";
    std::vector<double> corners;
    for (auto const& corner : {scene.system().grid().box().lo, scene.system().grid().box().hi})
        for (int c = 0; c < Scene::dim; ++c) corners.push_back(corner[c]);
    state.put("run/grid_box", std::move(corners), std::size_t(Scene::dim));
    scene.system().each_species([&](auto s) {
        auto const& p = scene.system().template species<s()>().particles;
        if (scene.stopped()) detail::put_particles(state, s(), p, p.fields);
        else detail::put_particles(state, s(), p, M::template lasting<s()>());
    });
    if (!scene.stopped()) detail::put_skins(state, scene.system());
    detail::put_pairs(state, scene.system());
    detail::each_note(
        [&]<class N>(std::string const& name, N const& value) {
            if constexpr (std::is_arithmetic_v<N>) state.put_one(name, detail::Stored<N>(value));
            else state.put(name, value);
        },
        outputs...);
    return state;
}

} // namespace spate::io
