// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief From the parts of a state that ranks hold to stretches of the whole, or to the whole on one of them, and back. Rows
///        know by a key where they belong, so that nothing tells how many ranks there were.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "spate/core/ranks.hpp"
#include "spate/io/any_ranks.hpp"
#include "spate/io/detail/stretches.hpp"
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

/// Of the tables whose rows go with a key, by the key's name: where the stretch of this rank is.
using StretchesOf = std::map<std::string, Where>;

/// Instead of the part of the state that is here a stretch of each of its tables, in the order that one rank would have; what
/// has no key stays.
[[gnu::cold]] inline StretchesOf stretch(AnyRanks const& ranks, State& part)
{
    std::map<std::string, std::vector<std::string>> keyed;
    for (auto const& [name, table] : part.tables)
        if (const std::string key = key_of(name); !key.empty()) keyed[key].push_back(name);
    StretchesOf all;
    for (auto const& [key, names] : keyed) {
        auto const& table = part.tables.at(key);
        auto keys = [n = table.columns]<class T>(std::vector<T> const& rows) -> std::vector<Key> {
            if constexpr (std::is_same_v<T, std::uint32_t> || std::is_same_v<T, std::int32_t>) return keys_of(rows, n);
            else throw std::logic_error("spate: keys of rows are whole numbers");
        };
        const Stretches stretches(ranks, std::visit(keys, table.values), table.columns);
        all[key] = stretches.where();
        for (auto const& name : names) {
            auto& of = part.tables.at(name);
            std::visit([&](auto& rows) { rows = stretches(rows, of.columns); }, of.values);
        }
    }
    return all;
}
/// On rank 0 the state of all, as one rank would have it; elsewhere nothing of use.
[[gnu::cold]] inline State whole(AnyRanks const& ranks, State part)
{
    if (ranks.count() == 1) return part;
    for (auto const& [key, where] : stretch(ranks, part))
        for (auto& [name, table] : part.tables)
            if (key_of(name) == key)
                std::visit([&](auto& rows) { rows = gathered(ranks, std::move(rows)); }, table.values);
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
[[gnu::cold]] inline std::vector<Shape> shapes_of(AnyRanks const& ranks, State const& state, State& mine)
{
    std::vector<Parcel> parcels;
    auto put = [](Message& m, std::string const& text) { m.put(std::vector<char>(text.begin(), text.end())); };
    for (int r = 0; r < ranks.count() && ranks.rank() == 0; ++r) {
        Message m;
        m.put(std::uint64_t(state.tables.size()));
        for (auto const& [name, table] : state.tables)
            put(m, name), m.put(std::uint64_t(table.values.index())), m.put(std::uint64_t(table.columns));
        for (auto const& [name, text] : state.texts) put(m, name), put(m, text);
        parcels.push_back({r, std::move(m)});
    }
    Message m = std::move(ranks.scatter(std::move(parcels)).front().message);
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
[[gnu::cold]] inline State dealt(AnyRanks const& ranks, State const& state)
{
    State mine;
    mine.origin = state.origin;
    const Deal deal(state, ranks.count());
    auto one = [&]<class T>(Shape const& shape, std::type_identity<T>) {
        std::vector<Parcel> parcels;
        if (ranks.rank() == 0) {
            auto const& all = state.table<T>(shape.name, shape.columns);
            const bool shared_by_all = key_of(shape.name).empty();
            const auto begin = deal(shape.name, all.size() / shape.columns);
            for (int r = 0; r < ranks.count(); ++r) {
                const auto first = shared_by_all ? 0 : begin[std::size_t(r)] * shape.columns;
                const auto last = shared_by_all ? all.size() : begin[std::size_t(r) + 1] * shape.columns;
                Message m;
                m.put(std::uint64_t(last - first));
                m.put(std::span<T const>(all).subspan(first, last - first));
                parcels.push_back({r, std::move(m)});
            }
        }
        parcels = ranks.scatter(std::move(parcels));
        mine.put(shape.name, parcels.front().message.template take_all<T>(), shape.columns);
    };
    for (auto const& shape : shapes_of(ranks, state, mine)) {
        [&]<class... T>(std::variant<std::vector<T>...> const*) {
            std::size_t kind = 0;
            ((kind++ == shape.kind ? one(shape, std::type_identity<T>{}) : void()), ...);
        }(static_cast<decltype(Table::values) const*>(nullptr));
    }
    return mine;
}

} // namespace spate::io::detail
