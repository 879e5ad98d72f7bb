// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A scene goes on from a state, on any backend with the same bits: from a file (io/checkpoint_file.hpp) or from
///        state_of(scene).
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "spate/io/any_scene.hpp"
#include "spate/io/detail/checked_state.hpp"
#include "spate/io/detail/rows_of_ranks.hpp"
#include "spate/io/state.hpp"
#include "spate/io/state_of.hpp"
#include "spate/io/this_scene.hpp"

namespace spate::io {

namespace detail {

/// From a state; of outputs only what is there.
class Read final : public Foldered {
public:
    enum class How { look, take }; ///< whether types are right, and nothing changes; or for good
    Read(State const& state, How how, std::string folder = "")
        : Foldered(std::move(folder)), state_(state), how_(how), outputs_(path("").empty())
    {}

private:
    [[gnu::cold]] void note(std::string_view name, Numbers numbers) const override
    {
        const std::string from = path(name);
        if (outputs_ && !state_.has(from)) return;
        auto take = [&]<class N>(N* value) {
            if constexpr (std::is_arithmetic_v<N>) {
                const auto there = state_.one<Stored<N>>(from);
                if (how_ == How::take) *value = N(there);
            }
            else {
                auto const& there = state_.table<typename N::value_type>(from);
                if (how_ == How::take) *value = there;
            }
        };
        std::visit(take, numbers);
    }
    State const& state_;
    How how_;
    bool outputs_;
};

template <class T>
[[gnu::cold]] void take_particles(State const& state, int s, AnyScene& scene)
{
    auto const& id = state.table<std::uint32_t>(of_species(s, "id"));
    scene.set_ids(s, id, std::uint32_t(state.one<std::int64_t>(of_species(s, "next_id"))));
    struct Take : AnyScene::Columns {
        State const& state;
        int s;
        std::size_t size;
        Take(State const& from, int of, std::size_t n) : state(from), s(of), size(n) {}
        void field(std::string_view name, bool lasting, int components, void* const* columns) override
        {
            const auto n = std::size_t(components);
            auto const* values = lasting ? state.table<T>(of_species(s, name), n).data() : nullptr;
            for (std::size_t c = 0; c < n; ++c) {
                T* const column = static_cast<T*>(columns[c]);
                for (std::size_t i = 0; i < size; ++i) column[i] = lasting ? values[i * n + c] : T(0);
            }
        }
    } take(state, s, id.size());
    scene.columns(s, take);
}

inline std::vector<std::string> lines(std::string const& text)
{
    std::vector<std::string> all;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
}

/// A state that was found whole, or a part of it.
class PastOf final : public AnyScene::Past {
public:
    /// \param skins  of the particles of a part    \param checked  the whole, null where it is elsewhere
    PastOf(AnyScene& scene, State const& state, Facts const& facts, State const& skins, Checked const* checked)
        : scene_(scene), state_(state), facts_(facts), skins_(skins), checked_(checked)
    {}
    [[gnu::cold]] void fill() override
    {
        for (int s = 0; s < facts_.species; ++s)
            facts_.single ? take_particles<float>(state_, s, scene_) : take_particles<double>(state_, s, scene_);
        scene_.numbers(Read(state_, Read::How::take, "run/"));
    }
    [[nodiscard]] double skin_of(int s, std::int32_t const* place) const override
    {
        return checked_->skin_of(std::size_t(s), place);
    }
    [[gnu::cold]] [[nodiscard]] std::vector<double> skins_of(int s) const override
    {
        return scene_.count() > 1 ? skins_.table<double>(skins_of_particles(s)) : checked_->skins_of(s);
    }
    [[gnu::cold]] void each_cost(AnyScene::Costs& told) const override
    {
        if (checked_) checked_->each_cost(told);
    }
    [[nodiscard]] Kept kept(int s, int q, std::size_t numbers) const override
    {
        auto const& ids = state_.table<std::uint32_t>(of_pair(s, q, "ids"), 2);
        const std::string name = of_pair(s, q, "value");
        if (facts_.single) return {ids, state_.table<float>(name, numbers).data()};
        return {ids, state_.table<double>(name, numbers).data()};
    }

private:
    AnyScene& scene_;
    State const& state_;
    Facts const& facts_;
    State const& skins_;
    Checked const* checked_;
};

/// Read and checked on rank 0, then each rank takes up its part. \param read  gives the state; rank 0 calls it
[[gnu::cold]] inline void resume_from(AnyScene& scene, std::function<State const&()> const& read)
{
    const Facts facts = scene.facts();
    const State due = description(scene);
    const std::size_t markers = facts.species == 2 ? scene.particles(1) : 0;
    static const State nothing;
    State const* state = &nothing;
    State skins;
    std::optional<Checked> checked;
    scene.together([&] {
        if (scene.rank() != 0) return;
        state = &read();
        checked.emplace(scene, *state, facts, due, markers);
        Read look(*state, Read::How::look);
        scene.notes(look);
        for (int s = 0; s < facts.species && checked->local() && scene.count() > 1; ++s)
            skins.put(skins_of_particles(s), checked->skins_of(s));
    });
    State part;
    if (scene.count() > 1) part = dealt(scene, *state), skins = dealt(scene, skins);
    State const& mine = scene.count() > 1 ? part : *state;
    PastOf past(scene, mine, facts, skins, checked ? &*checked : nullptr);
    const bool local = scene.count() > 1 ? !skins.tables.empty() : checked->local();
    scene.resume(grid_box(mine, facts), mine.text("run/criterion"), lines(mine.text("run/warnings")), local, past);
    Read take(mine, Read::How::take);
    scene.notes(take);
}

} // namespace detail

[[gnu::cold]] inline void resume(AnyScene& scene, State const& state)
{
    detail::resume_from(scene, [&]() -> State const& { return state; });
}
/// The scene goes on from a state, and so do the outputs that it remembers; of many ranks, which all call it, from that of
/// rank 0. The scene has to be put together and filled as it was at its start. Throws BadInput before anything changes if
/// the state is not whole, or of another scene.
template <class Scene, class... Output>
void resume(Scene& scene, State const& state, Output&... outputs)
{
    ThisScene<Scene, Output...> any(scene, std::tie(outputs...));
    resume(static_cast<AnyScene&>(any), state);
}

} // namespace spate::io
