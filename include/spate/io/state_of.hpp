// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief From a scene to the state that a run needs to go on: global arrays by id or by place, without a trace of who held
///        what; on many ranks each has its part. Not the way back (io/resume.hpp), not the file (io/checkpoint_file.hpp).
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
#include <utility>
#include <vector>

#include "spate/io/any_scene.hpp"
#include "spate/io/detail/rows_of_ranks.hpp"
#include "spate/io/state.hpp"
#include "spate/io/this_scene.hpp"

namespace spate::io {

namespace detail {

[[gnu::cold]] inline std::string name_of_type(std::type_info const& type)
{
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> name(abi::__cxa_demangle(type.name(), nullptr, nullptr, &status),
                                                      std::free);
    return status == 0 ? name.get() : type.name();
}
inline std::string of_species(int s, std::string_view what)
{
    return "species_" + std::to_string(s) + "/" + std::string(what);
}
inline std::string of_pair(int s, int q, std::string_view what)
{
    return "pairs_" + std::to_string(s) + "_" + std::to_string(q) + "/" + std::string(what);
}

/// What the scene is put together from, as texts and numbers; the backend is not part of it.
[[gnu::cold]] inline State description(AnyScene const& scene)
{
    struct : AnyScene::Parts {
        State d;
        int terms = 0, species = 0;
        void type(std::string_view role, std::type_info const& type) override
        {
            std::string name = "scene/" + std::string(role);
            if (role == "term ") name += std::to_string(terms++);
            d.texts[name] = name_of_type(type);
        }
        void parameter(std::string_view name, double value) override { d.put_one("scene/" + std::string(name), value); }
        void fields(std::string const& names) override
        {
            d.texts["scene/fields of species " + std::to_string(species++)] = names;
        }
    } all;
    scene.parts(all);
    return std::move(all.d);
}

/// Numbers as they are saved: bool and integers as 64 bits.
template <class T>
using Stored = std::conditional_t<std::is_integral_v<T>, std::int64_t, T>;

/// Notes of outputs are in a folder for each: outputs are known by their place.
class Foldered : public Notes {
public:
    explicit Foldered(std::string folder = "") : folder_(std::move(folder)) {}
    void next() override { folder_ = "output_" + std::to_string(output_++) + "/"; }

protected:
    ~Foldered() = default;
    [[nodiscard]] std::string path(std::string_view name) const { return folder_ + std::string(name); }

private:
    std::string folder_;
    int output_ = 0;
};
/// Into a state.
class Written final : public Foldered {
public:
    explicit Written(State& state, std::string folder = "") : Foldered(std::move(folder)), state_(state) {}

private:
    [[gnu::cold]] void note(std::string_view name, Numbers numbers) const override
    {
        auto put = [&]<class N>(N* value) {
            if constexpr (std::is_arithmetic_v<N>) state_.put_one(path(name), Stored<N>(*value));
            else state_.put(path(name), *value);
        };
        std::visit(put, numbers);
    }
    State& state_;
};

/// Lasting fields, or all, by id.
template <class T>
[[gnu::cold]] void put_particles(State& state, int s, AnyScene& scene, bool all)
{
    struct Put : AnyScene::Columns {
        State& state;
        int s;
        bool all;
        std::vector<std::size_t> order;
        Put(State& into, int of, bool whole) : state(into), s(of), all(whole) {}
        void field(std::string_view name, bool lasting, int components, void* const* columns) override
        {
            if (!lasting && !all) return;
            const auto n = std::size_t(components);
            std::vector<T> values;
            values.reserve(order.size() * n);
            for (const std::size_t i : order)
                for (std::size_t c = 0; c < n; ++c) values.push_back(static_cast<T const*>(columns[c])[i]);
            state.put(of_species(s, name), std::move(values), n);
        }
    } put(state, s, all);
    auto const& ids = scene.ids(s);
    put.order.resize(ids.size());
    std::iota(put.order.begin(), put.order.end(), std::size_t{0});
    std::sort(put.order.begin(), put.order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
    std::vector<std::uint32_t> id;
    for (const std::size_t i : put.order) id.push_back(ids[i]);
    state.put(of_species(s, "id"), std::move(id));
    state.put_one(of_species(s, "next_id"), std::int64_t(scene.next_id(s)));
    scene.columns(s, put);
}

[[gnu::cold]] inline void put_skins(State& state, AnyScene const& scene, Facts const& facts)
{
    const auto dim = std::size_t(facts.dim);
    struct : AnyScene::Patches {
        std::size_t dim = 0;
        std::vector<std::vector<std::pair<std::array<std::int32_t, 3>, double>>> of;
        void patch(int s, std::int32_t const* place, double skin) override
        {
            std::array<std::int32_t, 3> at{};
            std::copy_n(place, dim, at.begin());
            of[std::size_t(s)].emplace_back(at, skin);
        }
    } skins;
    skins.dim = dim, skins.of.resize(std::size_t(facts.species));
    scene.skins(skins);
    for (int s = 0; s < facts.species; ++s) {
        auto& mine = skins.of[std::size_t(s)];
        std::sort(mine.begin(), mine.end());
        std::vector<std::int32_t> places;
        std::vector<double> skin;
        for (auto const& [place, value] : mine)
            places.insert(places.end(), place.begin(), place.begin() + std::ptrdiff_t(dim)), skin.push_back(value);
        state.put(of_species(s, "skin_place"), std::move(places), dim);
        state.put(of_species(s, "skin"), std::move(skin));
    }
}

/// What the patches have cost of late: measured, so that it differs from run to run; empty where nobody looks.
[[gnu::cold]] inline void put_costs(State& state, AnyScene const& scene, Facts const& facts)
{
    struct : AnyScene::Costs {
        std::size_t dim = 0;
        std::vector<std::vector<std::int32_t>*> place;
        std::vector<std::vector<std::int64_t>*> cost;
        void patch(int s, std::int32_t const* at, std::int64_t of) override
        {
            place[std::size_t(s)]->insert(place[std::size_t(s)]->end(), at, at + dim);
            cost[std::size_t(s)]->push_back(of);
        }
    } costs;
    costs.dim = std::size_t(facts.dim);
    for (int s = 0; s < facts.species; ++s) {
        const std::string folder = "balance_" + std::to_string(s);
        costs.place.push_back(&state.fresh<std::int32_t>(folder + "/place", costs.dim));
        costs.cost.push_back(&state.fresh<std::int64_t>(folder + "/cost", 1));
    }
    scene.costs(costs);
}

template <class T>
[[gnu::cold]] void put_pairs(State& state, AnyScene const& scene)
{
    struct Put : AnyScene::Pairs {
        explicit Put(State& into) : state(into) {}
        State& state;
        std::vector<std::uint32_t>* ids = nullptr;
        std::vector<T>* values = nullptr;
        std::size_t count = 0;
        void kept(int s, int q, std::size_t numbers) override
        {
            count = numbers;
            ids = &state.fresh<std::uint32_t>(of_pair(s, q, "ids"), 2);
            values = &state.fresh<T>(of_pair(s, q, "value"), numbers);
        }
        void pair(std::uint32_t i, std::uint32_t j, void const* of) override
        {
            ids->push_back(i), ids->push_back(j);
            auto const* value = static_cast<T const*>(of);
            values->insert(values->end(), value, value + count);
        }
    } put(state);
    scene.pairs(put);
}

/// The part of the state that is here, its rows in order.
[[gnu::cold]] inline State part_of(AnyScene& scene)
{
    scene.prepare();
    const Facts facts = scene.facts();
    State state = description(scene);
    scene.numbers(Written(state, "run/"));
    state.put_one("run/stopped", std::int64_t(facts.stopped));
    state.texts["run/criterion"] = facts.criterion;
    std::string warnings;
    for (auto const& warning : *facts.warnings) warnings += warning + "\n";
    state.texts["run/warnings"] = warnings;
    std::vector<double> corners(facts.grid.lo.begin(), facts.grid.lo.begin() + facts.dim);
    corners.insert(corners.end(), facts.grid.hi.begin(), facts.grid.hi.begin() + facts.dim);
    state.put("run/grid_box", std::move(corners), std::size_t(facts.dim));
    for (int s = 0; s < facts.species; ++s)
        facts.single ? put_particles<float>(state, s, scene, facts.stopped)
                     : put_particles<double>(state, s, scene, facts.stopped);
    if (!facts.stopped) put_skins(state, scene, facts), put_costs(state, scene, facts);
    facts.single ? put_pairs<float>(state, scene) : put_pairs<double>(state, scene);
    Written notes(state);
    scene.notes(notes);
    return state;
}

} // namespace detail

[[gnu::cold]] inline State state_of(AnyScene& scene) { return detail::whole(scene, detail::part_of(scene)); }
/// All that the scene needs to go on, and what outputs have to remember; of many ranks, which all call it, on rank 0. Of a
/// scene that a Stop has ended: all fields, to look at.
template <class Scene, class... Output>
State state_of(Scene& scene, Output&... outputs)
{
    ThisScene<Scene, Output...> any(scene, std::tie(outputs...));
    return state_of(static_cast<AnyScene&>(any));
}

} // namespace spate::io
