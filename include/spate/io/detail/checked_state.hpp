// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Whether a state is whole and of a scene: looked at to the end before a restart changes anything.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "spate/core/errors.hpp"
#include "spate/io/any_scene.hpp"
#include "spate/io/state.hpp"
#include "spate/io/state_of.hpp"

namespace spate::io::detail {

[[gnu::cold]] inline AnyScene::Corners grid_box(State const& state, Facts const& facts)
{
    auto const& corners = state.table<double>("run/grid_box", std::size_t(facts.dim), 2);
    AnyScene::Corners box;
    std::copy_n(corners.begin(), facts.dim, box.lo.begin());
    std::copy_n(corners.begin() + facts.dim, facts.dim, box.hi.begin());
    return box;
}

/// Checks that a state is whole and of this scene; the scene stays as it is.
class Checked {
    using Place = std::vector<std::int32_t>;

public:
    /// \param due  description of the scene    \param markers  of its walls, on all ranks
    [[gnu::cold]] Checked(AnyScene& scene, State const& state, Facts const& facts, State const& due,
                          std::size_t markers)
        : scene_(scene), state_(state), facts_(facts), dim_(std::size_t(facts.dim)), markers_(markers)
    {
        if (!scene.filled()) state.refuse("asked of a scene without particles: fill it as at its start");
        check_scene(due);
        if (state.one<std::int64_t>("run/stopped") != 0)
            state.refuse("a state at which a run stopped: it is there to be looked at, not to go on from");
        check_numbers();
        if (facts.single) check_tables<float>();
        else check_tables<double>();
    }
    /// Whether skins differ by place.
    [[nodiscard]] bool local() const { return local_; }
    /// The skin at each particle of a species, which were checked to have one.
    [[gnu::cold]] [[nodiscard]] std::vector<double> skins_of(int s) const
    {
        const auto place = facts_.single ? places_of<float>(s) : places_of<double>(s);
        std::vector<double> skins;
        for (std::size_t k = 0; k < place.size(); k += dim_) skins.push_back(skin_of(std::size_t(s), &place[k]));
        return skins;
    }
    /// Of a patch, which was checked to be there.
    [[nodiscard]] double skin_of(std::size_t s, std::int32_t const* place) const
    {
        std::size_t first = 0, last = skin(s).size();
        while (last - first > 1) {
            const std::size_t middle = (first + last) / 2;
            (before(place, place_of(s, middle)) ? last : first) = middle;
        }
        return skin(s)[first];
    }

    [[gnu::cold]] void each_cost(AnyScene::Costs& told) const
    {
        for (int s = 0; s < facts_.species; ++s) {
            const std::string folder = "balance_" + std::to_string(s);
            auto const* place = state_.table<std::int32_t>(folder + "/place", dim_).data();
            for (const auto c : state_.table<std::int64_t>(folder + "/cost")) told.patch(s, place, c), place += dim_;
        }
    }

private:
    [[nodiscard]] bool before(std::int32_t const* a, std::int32_t const* b) const
    {
        return std::lexicographical_compare(a, a + dim_, b, b + dim_);
    }
    [[nodiscard]] std::vector<double> const& skin(std::size_t s) const
    {
        return state_.table<double>(of_species(int(s), "skin"));
    }
    [[nodiscard]] std::int32_t const* place_of(std::size_t s, std::size_t k) const
    {
        return state_.table<std::int32_t>(of_species(int(s), "skin_place"), dim_).data() + k * dim_;
    }
    template <class T>
    [[gnu::cold]] void check_tables()
    {
        for (int s = 0; s < facts_.species; ++s) check_particles<T>(s);
        for (int s = 0; s < facts_.species; ++s) {
            const std::size_t patches = skin(std::size_t(s)).size();
            (void)state_.table<std::int32_t>(of_species(s, "skin_place"), dim_, patches);
            local_ = local_ || patches > 0;
        }
        if (state_.one<std::int64_t>("run/have_lists") != 0)
            for (int s = 0; s < facts_.species; ++s) check_skins<T>(s);
        check_pairs<T>();
        check_costs();
    }
    /// Costs of patches, if there are any: shares are cut by them.
    [[gnu::cold]] void check_costs() const
    {
        for (int s = 0; s < facts_.species; ++s) {
            const std::string folder = "balance_" + std::to_string(s);
            auto const& cost = state_.table<std::int64_t>(folder + "/cost");
            (void)state_.table<std::int32_t>(folder + "/place", dim_, cost.size());
            for (const auto c : cost)
                if (c < 0 || c > std::int64_t{1} << 39) state_.refuse("with costs that nobody can have measured");
            if (cost.size() > std::size_t{1} << 22) // their sum is an integer
                for (const auto c : cost)
                    if (c > (std::int64_t{1} << 61) / std::int64_t(cost.size())) state_.refuse("with costs too large");
        }
    }
    [[gnu::cold]] void check_scene(State const& mine) const
    {
        auto differs = [&](std::string const& what, std::string const& there, std::string const& here) {
            state_.refuse("of another scene: its " + what.substr(what.find('/') + 1) + " is " + there +
                          ", here it is " + here);
        };
        for (auto const& [name, text] : mine.texts) {
            const auto found = state_.texts.find(name);
            if (found == state_.texts.end()) differs(name, "none", text);
            if (found->second != text) differs(name, found->second, text);
        }
        for (auto const& [name, text] : state_.texts)
            if (name.rfind("scene/", 0) == 0 && mine.texts.count(name) == 0) differs(name, text, "none");
        for (auto const& [name, table] : mine.tables) {
            const double there = state_.one<double>(name), here = mine.one<double>(name);
            if (there != here) differs(name, exact(there), exact(here));
        }
    }
    static std::string exact(double x)
    {
        std::ostringstream s;
        s.precision(17);
        s << x;
        return s.str();
    }
    [[gnu::cold]] void check_numbers() const
    {
        scene_.numbers(Sane(state_));
        if (!(state_.one<double>("run/time") >= 0 && state_.one<double>("run/dt") >= 0))
            state_.refuse("with a time below 0");
        (void)state_.text("run/criterion"), (void)state_.text("run/warnings");
        const auto box = grid_box(state_, facts_);
        bool fine = true;
        for (std::size_t c = 0; c < dim_; ++c) {
            fine = fine && std::isfinite(box.lo[c]) && std::isfinite(box.hi[c]) && box.lo[c] <= box.hi[c];
            if (auto const& mine = facts_.walls) fine = fine && box.lo[c] == mine->lo[c] && box.hi[c] == mine->hi[c];
        }
        if (!fine) state_.refuse("with a box that is none of this scene");
    }
    /// Looks at the numbers of a run, and leaves them as they are.
    class Sane final : public Notes {
    public:
        explicit Sane(State const& state) : state_(state) {}

    private:
        [[gnu::cold]] void note(std::string_view name, Numbers numbers) const override
        {
            auto look = [&]<class N>(N*) {
                if constexpr (std::is_arithmetic_v<N>) {
                    const auto value = state_.one<Stored<N>>("run/" + std::string(name));
                    bool fine = true;
                    if constexpr (std::same_as<N, bool>) fine = value == 0 || value == 1;
                    else if constexpr (std::is_integral_v<N>) fine = value >= 0 && value < (std::int64_t{1} << 60);
                    else fine = std::isfinite(value);
                    if (!fine) state_.refuse("with " + text(double(value)) + " for " + std::string(name));
                }
            };
            std::visit(look, numbers);
        }
        State const& state_;
    };
    template <class T>
    [[gnu::cold]] void check_particles(int s) const
    {
        auto const& id = state_.table<std::uint32_t>(of_species(s, "id"));
        for (std::size_t k = 1; k < id.size(); ++k)
            if (id[k - 1] >= id[k]) state_.refuse("with ids out of order");
        const auto next = state_.one<std::int64_t>(of_species(s, "next_id"));
        if (next < (id.empty() ? 0 : std::int64_t(id.back()) + 1) || next > std::numeric_limits<std::uint32_t>::max())
            state_.refuse("with a wrong next id");
        if (id.size() > std::size_t(std::numeric_limits<std::int32_t>::max())) state_.refuse("with too many particles");
        if (s == 1 && id.size() != markers_)
            state_.refuse("of another scene: its walls have another number of markers");
        struct Look : AnyScene::Columns {
            State const& state;
            int s;
            std::size_t size;
            Look(State const& at, int of, std::size_t n) : state(at), s(of), size(n) {}
            void field(std::string_view name, bool lasting, int components, void* const*) override
            {
                if (!lasting) return;
                for (const T value : state.table<T>(of_species(s, name), std::size_t(components), size))
                    if (!std::isfinite(value))
                        state.refuse("with a " + std::string(name) + " that is not a finite number");
            }
        } look(state_, s, id.size());
        scene_.columns(s, look);
    }
    /// Every patch that holds particles has a skin, and no other; and no particle is beyond the index.
    template <class T>
    [[gnu::cold]] void check_skins(int s) const
    {
        const std::vector<std::int32_t> all = places_of<T>(s);
        if (!local_) return;
        std::vector<std::int32_t const*> places;
        for (std::size_t k = 0; k < all.size(); k += dim_) places.push_back(all.data() + k);
        auto less = [&](auto* a, auto* b) { return before(a, b); };
        auto same = [&](auto* a, auto* b) { return std::equal(a, a + dim_, b); };
        std::sort(places.begin(), places.end(), less);
        places.erase(std::unique(places.begin(), places.end(), same), places.end());
        auto const& mine = skin(std::size_t(s));
        bool fine = mine.size() == places.size();
        for (std::size_t k = 0; fine && k < places.size(); ++k)
            fine = same(places[k], place_of(std::size_t(s), k)) && mine[k] > 0 && mine[k] <= facts_.widest_skin;
        if (!fine) state_.refuse("with skins that are not those of its particles");
    }
    /// The patch in which each particle was when lists were built.
    template <class T>
    [[gnu::cold]] std::vector<std::int32_t> places_of(int s) const
    {
        const std::string built = of_species(s, "build_position");
        const bool is_built = has_lasting(s, "build_position");
        auto const& table = state_.table<T>(is_built ? built : of_species(s, "position"), dim_);
        const std::vector<double> x(table.begin(), table.end());
        std::vector<std::int32_t> all(x.size());
        if (!scene_.places(grid_box(state_, facts_), x.data(), x.size() / dim_, all.data()))
            state_.refuse("with a particle too far from the origin");
        return all;
    }
    [[gnu::cold]] bool has_lasting(int s, std::string_view wanted) const
    {
        struct Find : AnyScene::Columns {
            std::string_view wanted;
            bool found = false;
            void field(std::string_view name, bool lasting, int, void* const*) override
            {
                found = found || (lasting && name == wanted);
            }
        } find;
        find.wanted = wanted;
        scene_.columns(s, find);
        return find.found;
    }
    template <class T>
    [[gnu::cold]] void check_pairs() const
    {
        struct Look : AnyScene::Pairs {
            State const& state;
            explicit Look(State const& at) : state(at) {}
            void kept(int s, int q, std::size_t numbers) override { check_pairs<T>(state, s, q, numbers); }
            void pair(std::uint32_t, std::uint32_t, void const*) override {}
        } look(state_);
        scene_.pairs(look);
    }
    template <class T>
    [[gnu::cold]] static void check_pairs(State const& state, int s, int q, std::size_t numbers)
    {
        auto const& ids = state.table<std::uint32_t>(of_pair(s, q, "ids"), 2);
        auto const& i = state.table<std::uint32_t>(of_species(s, "id"));
        auto const& j = state.table<std::uint32_t>(of_species(q, "id"));
        bool fine = true;
        for (std::size_t k = 0; fine && k < ids.size(); k += 2) {
            fine = std::binary_search(i.begin(), i.end(), ids[k]) && std::binary_search(j.begin(), j.end(), ids[k + 1]);
            if (k > 0) fine = fine && (ids[k - 2] < ids[k] || (ids[k - 2] == ids[k] && ids[k - 1] < ids[k + 1]));
        }
        for (const T value : state.table<T>(of_pair(s, q, "value"), numbers, ids.size() / 2))
            fine = fine && std::isfinite(value);
        if (!fine) state.refuse("with pairs that are not those of its particles");
    }

    AnyScene& scene_;
    State const& state_;
    Facts const& facts_;
    std::size_t dim_, markers_;
    bool local_ = false;
};

} // namespace spate::io::detail
