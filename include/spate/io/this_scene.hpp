// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A scene and its outputs as an io::AnyScene: all that a checkpoint asks of their types.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include "spate/core/box.hpp"
#include "spate/core/fields.hpp"
#include "spate/core/ranks.hpp"
#include "spate/io/any_scene.hpp"

namespace spate::io {

/// What an output has to remember: notes(f) calls f(name, number) or f(name, numbers).
template <class O>
concept Remembers = requires(O& o, Notes const& notes)
{
    o.notes(notes);
};

template <class Scene>
using ScenesRanks = TheseRanks<decltype(party_of(std::declval<Scene const&>())), AnyScene>;

template <class Scene, class... Output>
class ThisScene final : public ScenesRanks<Scene> {
    using Corners = AnyScene::Corners;
    using Parts = AnyScene::Parts;
    using Columns = AnyScene::Columns;
    using Patches = AnyScene::Patches;
    using Pairs = AnyScene::Pairs;
    using Costs = AnyScene::Costs;
    using Past = AnyScene::Past;
    using Engine = typename Scene::Engine;
    using M = typename Engine::M;
    static constexpr int dim = Scene::dim;
    using Place = std::array<std::int32_t, std::size_t(dim)>;

public:
    ThisScene(Scene& scene, std::tuple<Output&...> outputs)
        : ScenesRanks<Scene>(party_of(scene)), scene_(scene), outputs_(outputs)
    {}

    [[gnu::cold]] bool filled() const override { return !scene_.physics().open(); }
    [[gnu::cold]] bool interrupted() const override { return scene_.interrupted(); }
    [[gnu::cold]] void prepare() override
    {
        if (!scene_.prepared()) scene_.prepare();
        scene_.system().count_on_one();
    }
    [[gnu::cold]] Facts facts() const override
    {
        auto const& system = scene_.system();
        Facts f{dim,
                int(Engine::species_count),
                std::same_as<typename Engine::T, float>,
                scene_.stopped(),
                scene_.steps(),
                system.neighbours().closed_in(),
                scene_.criterion(),
                &scene_.report().warnings,
                corners(system.grid().box()),
                {}};
        if (const auto box = system.boundary().template box<dim>()) f.walls = corners(*box);
        return f;
    }
    [[gnu::cold]] void parts(Parts& told) const override
    {
        auto const& physics = scene_.physics();
        told.type("real", typeid(typename Engine::T));
        told.type("interaction", typeid(physics.interaction));
        told.type("integrator", typeid(scene_.integrator()));
        told.type("boundary", typeid(scene_.system().boundary()));
        std::apply([&](auto const&... term) { (told.type("term ", typeid(term)), ...); }, physics.terms);
        scene_.each_parameter([&](std::string_view name, double value) { told.parameter(name, value); });
        each([&](auto const& p, auto) { told.fields(to_string(p.fields)); });
    }
    [[gnu::cold]] void numbers(Notes const& notes) override { Scene::numbers_of(scene_, notes); }
    [[gnu::cold]] void notes([[maybe_unused]] Notes& notes) override
    {
        [[maybe_unused]] auto one = [&]<class O>(O& output) {
            notes.next();
            if constexpr (Remembers<O>) output.notes(std::as_const(notes));
        };
        std::apply([&](auto&... output) { (one(output), ...); }, outputs_);
    }
    [[gnu::cold]] std::size_t particles(int s) const override
    {
        std::size_t n = 0;
        scene_.system().each_species([&](auto k) {
            if (k() == s) n = scene_.system().template total_of<k()>();
        });
        return n;
    }
    [[gnu::cold]] std::vector<std::uint32_t> const& ids(int s) const override
    {
        std::vector<std::uint32_t> const* ids = nullptr;
        each([&](auto const& p, auto k) {
            if (k() == s) ids = &p.id();
        });
        return *ids;
    }
    [[gnu::cold]] std::uint32_t next_id(int s) const override
    {
        std::uint32_t next = 0;
        each([&](auto const& p, auto k) {
            if (k() == s) next = p.next_id();
        });
        return next;
    }
    [[gnu::cold]] void set_ids(int s, std::vector<std::uint32_t> const& ids, std::uint32_t next) override
    {
        scene_.system().each_species([&](auto k) {
            if (k() != s) return;
            scene_.system().template put_ids<k()>(ids, next);
        });
    }
    [[gnu::cold]] void columns(int s, Columns& told) override
    {
        scene_.system().each_species([&](auto k) {
            if (k() != s) return;
            auto& p = scene_.system().template species<k()>().particles;
            for_each(p.fields, [&]<class F>(F field) {
                constexpr bool lasting = decltype(M::template lasting<k()>())::template contains<F>;
                void* at[std::size_t(components<F, dim>)];
                for (std::size_t c = 0; c < std::size(at); ++c) at[c] = p.column(field)[c].data();
                told.field(F::name, lasting, int(std::size(at)), at);
            });
        });
    }
    [[gnu::cold]] void skins(Patches& told) const override
    {
        scene_.system().each_skin([&](int s, Place const& place, double skin) { told.patch(s, place.data(), skin); });
    }
    [[gnu::cold]] void costs([[maybe_unused]] Costs& told) const override
    {
        if constexpr (!Engine::alone)
            scene_.system().each_cost(
                [&](int s, Place const& place, std::int64_t cost) { told.patch(s, place.data(), cost); });
    }
    [[gnu::cold]] void pairs(Pairs& told) const override
    {
        scene_.system().each_kept([&](int s, int q, auto const& pairs) {
            told.kept(s, q, std::tuple_size_v<decltype(pairs.front().value)>);
            for (auto const& pair : pairs) told.pair(pair.i, pair.j, pair.value.data());
        });
    }
    [[gnu::cold]] bool places(Corners const& corners, double const* x, std::size_t n,
                              std::int32_t* place) const override
    {
        const auto grid = scene_.make_grid(box(corners));
        for (std::size_t i = 0; i < n; ++i) {
            Vec<dim, double> at;
            for (int c = 0; c < dim; ++c) at[c] = *x++;
            for (const std::int32_t k : Engine::place(at, grid)) *place++ = k;
            for (int c = 0; c < dim; ++c)
                if (std::abs(double(grid.cell_of(c, grid.bin(c, at[c])))) >= double(1 << 20)) return false;
        }
        return true;
    }
    [[gnu::cold]] void resume(Corners const& grid, std::string const& criterion, std::vector<std::string> warnings,
                              bool local, Past& past) override
    {
        auto lists = [&](Engine& system) {
            auto kept = [&]<class Pair>(int s, int q, std::type_identity<Pair>) { return pairs_of<Pair>(past, s, q); };
            if constexpr (Engine::alone)
                system.restore_lists(
                    local, [&](int s, Place const& place) { return past.skin_of(s, place.data()); }, kept);
            else {
                typename Engine::OfParticles skin;
                for (std::size_t s = 0; local && s < skin.size(); ++s) skin[s] = past.skins_of(int(s));
                system.restore_lists(local, std::move(skin), costs_of(past), kept);
            }
        };
        scene_.resume(
            box(grid), criterion, std::move(warnings), [&] { past.fill(); }, lists);
    }

private:
    [[gnu::cold]] static std::vector<std::pair<Place, std::int64_t>> costs_of(Past const& past)
    {
        struct : Costs {
            std::vector<std::pair<Place, std::int64_t>> all;
            void patch(int, std::int32_t const* place, std::int64_t cost) override
            {
                Place at;
                std::copy_n(place, dim, at.begin());
                all.emplace_back(at, cost);
            }
        } costs;
        past.each_cost(costs);
        return std::move(costs.all);
    }
    void each(auto const& f) const
    {
        scene_.system().each_species([&](auto k) { f(scene_.system().template species<k()>().particles, k); });
    }
    static Corners corners(Box<dim> const& box)
    {
        Corners c;
        for (int k = 0; k < dim; ++k) c.lo[std::size_t(k)] = box.lo[k], c.hi[std::size_t(k)] = box.hi[k];
        return c;
    }
    static Box<dim> box(Corners const& corners)
    {
        Box<dim> b{};
        for (int k = 0; k < dim; ++k) b.lo[k] = corners.lo[std::size_t(k)], b.hi[k] = corners.hi[std::size_t(k)];
        return b;
    }
    /// Pairs of ids and values, as terms keep them.
    template <class Pair>
    [[gnu::cold]] static std::vector<Pair> pairs_of(Past const& past, int s, int q)
    {
        constexpr std::size_t count = std::tuple_size_v<decltype(Pair::value)>;
        auto const& [ids, values] = past.kept(s, q, count);
        auto const* value = static_cast<typename Engine::T const*>(values);
        std::vector<Pair> pairs(ids.size() / 2);
        for (std::size_t k = 0; k < pairs.size(); ++k, value += count) {
            pairs[k].i = ids[2 * k], pairs[k].j = ids[2 * k + 1];
            std::copy_n(value, count, pairs[k].value.begin());
        }
        return pairs;
    }

    Scene& scene_;
    std::tuple<Output&...> outputs_;
};

} // namespace spate::io
