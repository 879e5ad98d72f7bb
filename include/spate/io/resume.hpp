// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief From a scene to the state that a run needs to go on, and back: the same bits on any backend. Global arrays by id
///        or by place; not the file (io/checkpoint_file.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cxxabi.h>
#include <limits>
#include <memory>
#include <numeric>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <typeinfo>
#include <vector>

#include "spate/core/box.hpp"
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
    auto term = [&]<class X>(X const&) { d.texts["scene/term " + std::to_string(k++)] = name_of_type<X>(); };
    std::apply([&](auto const&... t) { (term(t), ...); }, scene.physics().terms);
    scene.each_parameter([&](std::string const& name, auto value) { d.put_one("scene/" + name, double(value)); });
    scene.system().each_species([&](auto s) {
        using P = std::remove_cvref_t<decltype(scene.system().template species<s()>().particles)>;
        d.texts["scene/fields of species " + std::to_string(s())] = to_string(P::fields);
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
    [[nodiscard]] bool local() const
    {
        bool any = false;
        for (std::size_t s = 0; s < count; ++s) any = any || !skin(s).empty();
        return any;
    }
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
            else if constexpr (std::is_integral_v<N>) fine = value >= 0;
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
            state_.refuse("of another scene: its walls have " + std::to_string(id.size()) + " markers");
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
        if (!local()) return;
        auto const& mine = skin(s);
        (void)state_.table<std::int32_t>(of_species(s, "skin_place"), dim, mine.size());
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
};

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
        const std::string folder = "output_" + std::to_string(k++) + "/";
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
