// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Whether a state is whole and of a scene: looked at to the end before a restart changes anything.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "spate/core/box.hpp"
#include "spate/core/fields.hpp"
#include "spate/io/state.hpp"
#include "spate/io/state_of.hpp"

namespace spate::io::detail {

/// Checks that a state is whole and of this scene; the scene stays as it is.
template <class Scene>
class Checked {
    using Engine = typename Scene::Engine;
    using M = typename Engine::M;
    using T = typename Engine::T;
    static constexpr int dim = Scene::dim;
    using Place = std::array<std::int32_t, std::size_t(dim)>;
    static constexpr auto count = std::size_t(Engine::species_count);

public:
    [[gnu::cold]] Checked(Scene const& scene, State const& state) : scene_(scene), state_(state)
    {
        if (scene.physics().open()) state.refuse("asked of a scene without particles: fill it as at its start");
        check_scene();
        if (state.one<std::int64_t>("run/stopped") != 0)
            state.refuse("a state at which a run stopped: it is there to be looked at, not to go on from");
        check_numbers();
        scene.system().each_species([&](auto s) { check_particles<s()>(); });
        for (std::size_t s = 0; s < count; ++s) {
            (void)state.table<std::int32_t>(of_species(int(s), "skin_place"), dim, skin(s).size());
            local_ = local_ || !skin(s).empty();
        }
        if (state.one<std::int64_t>("run/have_lists") != 0)
            scene.system().each_species([&](auto s) { check_skins<s()>(); });
        scene.system().each_kept([&](auto s, auto q, auto const& pairs) {
            check_pairs<s(), q(), std::tuple_size_v<decltype(pairs.front().value)>>();
        });
    }
    [[nodiscard]] Box<dim> grid_box() const
    {
        auto const& corners = state_.table<double>("run/grid_box", dim, 2);
        Box<dim> box{};
        for (int c = 0; c < dim; ++c) box.lo[c] = corners[std::size_t(c)], box.hi[c] = corners[std::size_t(dim + c)];
        return box;
    }
    /// Whether skins differ by place.
    [[nodiscard]] bool local() const { return local_; }
    /// Of a patch, which was checked to be there.
    [[nodiscard]] double skin_of(std::size_t s, Place const& place) const
    {
        std::size_t first = 0, last = skin(s).size();
        while (last - first > 1) {
            const std::size_t middle = (first + last) / 2;
            (place < place_of(s, middle) ? last : first) = middle;
        }
        return skin(s)[first];
    }

private:
    [[nodiscard]] std::vector<double> const& skin(std::size_t s) const
    {
        return state_.table<double>(of_species(int(s), "skin"));
    }
    [[nodiscard]] Place place_of(std::size_t s, std::size_t k) const
    {
        auto const& all = state_.table<std::int32_t>(of_species(int(s), "skin_place"), dim);
        Place place;
        std::copy_n(all.begin() + std::ptrdiff_t(k * std::size_t(dim)), dim, place.begin());
        return place;
    }
    [[gnu::cold]] void check_scene() const
    {
        const State mine = description(scene_);
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
        Scene::numbers_of(scene_, [&]<class N>(std::string const& name, N const&) {
            const auto value = state_.one<Stored<N>>("run/" + name);
            bool fine = true;
            if constexpr (std::same_as<N, bool>) fine = value == 0 || value == 1;
            else if constexpr (std::is_integral_v<N>) fine = value >= 0 && value < (std::int64_t{1} << 60);
            else fine = std::isfinite(value);
            if (!fine) state_.refuse("with " + text(double(value)) + " for " + name);
        });
        if (!(state_.one<double>("run/time") >= 0 && state_.one<double>("run/dt") >= 0))
            state_.refuse("with a time below 0");
        (void)state_.text("run/criterion"), (void)state_.text("run/warnings");
        const auto box = grid_box();
        bool fine = true;
        for (int c = 0; c < dim; ++c)
            fine = fine && std::isfinite(box.lo[c]) && std::isfinite(box.hi[c]) && box.lo[c] <= box.hi[c];
        if (const auto mine = scene_.system().boundary().template box<dim>())
            for (int c = 0; c < dim; ++c) fine = fine && box.lo[c] == mine->lo[c] && box.hi[c] == mine->hi[c];
        if (!fine) state_.refuse("with a box that is none of this scene");
    }
    template <int s>
    [[gnu::cold]] void check_particles() const
    {
        auto const& id = state_.table<std::uint32_t>(of_species(s, "id"));
        for (std::size_t k = 1; k < id.size(); ++k)
            if (id[k - 1] >= id[k]) state_.refuse("with ids out of order");
        const auto next = state_.one<std::int64_t>(of_species(s, "next_id"));
        if (next < (id.empty() ? 0 : std::int64_t(id.back()) + 1) || next > std::numeric_limits<std::uint32_t>::max())
            state_.refuse("with a wrong next id");
        if (id.size() > std::size_t(std::numeric_limits<std::int32_t>::max())) state_.refuse("with too many particles");
        if (s == 1 && id.size() != scene_.system().template species<s>().particles.size())
            state_.refuse("of another scene: its walls have another number of markers");
        for_each(M::template lasting<s>(), [&]<class F>(F) {
            for (const T value : state_.table<T>(of_species(s, F::name), components<F, dim>, id.size()))
                if (!std::isfinite(value))
                    state_.refuse("with a " + std::string(F::name) + " that is not a finite number");
        });
    }
    /// Every patch that holds particles has a skin, and no other; and no particle is beyond the index.
    template <int s>
    [[gnu::cold]] void check_skins() const
    {
        using Fields = decltype(M::template lasting<s>());
        constexpr bool built = Fields::template contains<BuildPosition>;
        auto const& x = state_.table<T>(of_species(s, built ? "build_position" : "position"), dim);
        const auto grid = scene_.make_grid(grid_box());
        std::vector<Place> places;
        for (std::size_t i = 0; i < x.size(); i += std::size_t(dim)) {
            Vec<dim, double> at;
            for (int c = 0; c < dim; ++c) at[c] = double(x[i + std::size_t(c)]);
            places.push_back(Engine::place(at, grid));
            for (int c = 0; c < dim; ++c)
                if (std::abs(double(grid.cell_of(c, grid.bin(c, at[c])))) >= double(1 << 20))
                    state_.refuse("with a particle too far from the origin");
        }
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
        if (!local_) return;
        auto const& mine = skin(s);
        bool fine = mine.size() == places.size();
        for (std::size_t k = 0; fine && k < places.size(); ++k)
            fine = places[k] == place_of(s, k) && mine[k] > 0 && mine[k] <= scene_.system().neighbours().closed_in();
        if (!fine) state_.refuse("with skins that are not those of its particles");
    }
    template <int s, int q, std::size_t values>
    [[gnu::cold]] void check_pairs() const
    {
        auto const& ids = state_.table<std::uint32_t>(of_pair(s, q, "ids"), 2);
        auto const& i = state_.table<std::uint32_t>(of_species(s, "id"));
        auto const& j = state_.table<std::uint32_t>(of_species(q, "id"));
        bool fine = true;
        for (std::size_t k = 0; fine && k < ids.size(); k += 2) {
            fine = std::binary_search(i.begin(), i.end(), ids[k]) && std::binary_search(j.begin(), j.end(), ids[k + 1]);
            if (k > 0) fine = fine && (ids[k - 2] < ids[k] || (ids[k - 2] == ids[k] && ids[k - 1] < ids[k + 1]));
        }
        for (const T value : state_.table<T>(of_pair(s, q, "value"), values, ids.size() / 2))
            fine = fine && std::isfinite(value);
        if (!fine) state_.refuse("with pairs that are not those of its particles");
    }

    Scene const& scene_;
    State const& state_;
    bool local_ = false;
};

} // namespace spate::io::detail
