// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief From the parts of a state that ranks hold to the whole on one of them, and back. Rows know by a key where they
///        belong, so that nothing tells how many ranks there were.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "spate/core/ranks.hpp"
#include "spate/io/any_scene.hpp"
#include "spate/io/state.hpp"

namespace spate::io::detail {

/// The table whose rows say where those of another belong; empty: all ranks have the same numbers.
inline std::string key_of(std::string const& name)
{
    const std::size_t slash = name.find('/');
    const std::string folder = name.substr(0, slash), what = name.substr(slash + 1);
    if (folder.rfind("pairs_", 0) == 0) return folder + "/ids";
    if (folder.rfind("balance_", 0) == 0) return folder + "/place";
    if (folder.rfind("species_", 0) != 0 || what == "next_id") return "";
    return folder + (what == "skin" || what == "skin_place" ? "/skin_place" : "/id");
}

/// By species: the skin at each particle, of which a file has one a patch.
inline std::string skins_of_particles(int s) { return "species_" + std::to_string(s) + "/skin at particle"; }

/// The order of rows by their numbers, from the first column on.
template <class T>
[[gnu::cold]] std::vector<std::size_t> order_of(std::vector<T> const& rows, std::size_t columns)
{
    std::vector<std::size_t> order(rows.size() / columns);
    std::iota(order.begin(), order.end(), std::size_t{0});
    auto row = [&](std::size_t k) { return rows.begin() + std::ptrdiff_t(k * columns); };
    const auto n = std::ptrdiff_t(columns);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::lexicographical_compare(row(a), row(a) + n, row(b), row(b) + n);
    });
    return order;
}
template <class T>
[[gnu::cold]] void put_in_order(std::vector<T>& rows, std::size_t columns, std::vector<std::size_t> const& order)
{
    const std::vector<T> old = std::move(rows);
    rows.clear();
    rows.reserve(old.size());
    for (const std::size_t k : order)
        rows.insert(rows.end(), old.begin() + std::ptrdiff_t(k * columns),
                    old.begin() + std::ptrdiff_t((k + 1) * columns));
}

/// On rank 0 the state of all, as one rank would have it; elsewhere nothing of use.
[[gnu::cold]] inline State whole(AnyScene const& scene, State part)
{
    if (scene.count() == 1) return part;
    for (auto& [name, table] : part.tables)
        if (!key_of(name).empty())
            std::visit([&](auto& rows) { rows = gathered(scene, std::move(rows)); }, table.values);
    if (scene.rank() != 0) return part;
    std::map<std::string, std::vector<std::size_t>> order;
    for (auto const& [name, table] : part.tables)
        if (key_of(name) == name)
            order[name] = std::visit([n = table.columns](auto const& rows) { return order_of(rows, n); }, table.values);
    for (auto& [name, table] : part.tables)
        if (const auto key = order.find(key_of(name)); key != order.end())
            std::visit([&, n = table.columns](auto& rows) { put_in_order(rows, n, key->second); }, table.values);
    return part;
}

/// Where the rows of each rank begin, and where the last end: like numbers of particles, and the pairs of these targets.
class Deal {
public:
    Deal(State const& state, int ranks) : state_(state), ranks_(std::size_t(ranks)) {}
    [[gnu::cold]] [[nodiscard]] std::vector<std::size_t> operator()(std::string const& name, std::size_t rows) const
    {
        const std::string key = key_of(name);
        std::vector<std::size_t> begin(ranks_ + 1, 0);
        if (key.rfind("pairs_", 0) == 0) {
            auto const& ids = state_.table<std::uint32_t>(key, 2);
            auto const& target = state_.table<std::uint32_t>("species_" + key.substr(6, 1) + "/id");
            for (std::size_t r = 1, k = 0; r <= ranks_; ++r) {
                const std::size_t end = target.size() * r / ranks_;
                while (k < rows && (end == target.size() || ids[2 * k] < target[end])) ++k;
                begin[r] = k;
            }
        }
        else if (key.rfind("/id") != std::string::npos)
            for (std::size_t r = 1; r <= ranks_; ++r) begin[r] = rows * r / ranks_;
        return begin; // skins and costs stay where they are
    }

private:
    State const& state_;
    std::size_t ranks_;
};

struct Shape {
    std::string name;
    std::size_t kind, columns;
};
/// The names and types of the tables of rank 0, and its texts, on all ranks.
[[gnu::cold]] inline std::vector<Shape> shapes_of(AnyScene const& scene, State const& state, State& mine)
{
    std::vector<Parcel> parcels;
    auto put = [](Message& m, std::string const& text) { m.put(std::vector<char>(text.begin(), text.end())); };
    for (int r = 0; r < scene.count() && scene.rank() == 0; ++r) {
        Message m;
        m.put(std::uint64_t(state.tables.size()));
        for (auto const& [name, table] : state.tables)
            put(m, name), m.put(std::uint64_t(table.values.index())), m.put(std::uint64_t(table.columns));
        for (auto const& [name, text] : state.texts) put(m, name), put(m, text);
        parcels.push_back({r, std::move(m)});
    }
    Message m = std::move(scene.scatter(std::move(parcels)).front().message);
    auto take = [&] {
        const auto text = m.take_all<char>();
        return std::string(text.begin(), text.end());
    };
    std::vector<Shape> shapes(std::size_t(m.take<std::uint64_t>()));
    for (auto& shape : shapes) {
        shape.name = take();
        shape.kind = std::size_t(m.take<std::uint64_t>()), shape.columns = std::size_t(m.take<std::uint64_t>());
    }
    while (!m.empty()) {
        const std::string name = take();
        mine.texts[name] = take();
    }
    return shapes;
}

/// The part of the state of rank 0 with which a rank begins: like numbers of particles of each species in the order of
/// ids, and what is kept of their pairs; whatever is not of particles all have. Nothing if the state has no such table.
[[gnu::cold]] inline State dealt(AnyScene const& scene, State const& state)
{
    State mine;
    mine.origin = state.origin;
    const Deal deal(state, scene.count());
    auto one = [&]<class T>(Shape const& shape, std::type_identity<T>) {
        std::vector<Parcel> parcels;
        if (scene.rank() == 0) {
            auto const& all = state.table<T>(shape.name, shape.columns);
            const bool shared_by_all = key_of(shape.name).empty();
            const auto begin = deal(shape.name, all.size() / shape.columns);
            for (int r = 0; r < scene.count(); ++r) {
                const auto first = shared_by_all ? 0 : begin[std::size_t(r)] * shape.columns;
                const auto last = shared_by_all ? all.size() : begin[std::size_t(r) + 1] * shape.columns;
                Message m;
                m.put(std::uint64_t(last - first));
                m.put(std::span<T const>(all).subspan(first, last - first));
                parcels.push_back({r, std::move(m)});
            }
        }
        parcels = scene.scatter(std::move(parcels));
        mine.put(shape.name, parcels.front().message.template take_all<T>(), shape.columns);
    };
    for (auto const& shape : shapes_of(scene, state, mine)) {
        [&]<class... T>(std::variant<std::vector<T>...> const*) {
            std::size_t kind = 0;
            ((kind++ == shape.kind ? one(shape, std::type_identity<T>{}) : void()), ...);
        }(static_cast<decltype(Table::values) const*>(nullptr));
    }
    return mine;
}

} // namespace spate::io::detail
