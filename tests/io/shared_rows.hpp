// SPDX-License-Identifier: BSD-3-Clause
// Laws of files that ranks write together, whatever the transport: their rows are scattered over the ranks, and the file is that
// of one.
#pragma once

#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>

#include "io/small_tank.hpp"
#include "spate/io/checkpoint_file.hpp"
#include "spate/io/vtkhdf.hpp"

#include <gmock/gmock.h>

namespace shared_rows {

using namespace spate;

/// Of number k: no two alike in a row, the same on all ranks.
inline double number(std::uint64_t k) { return double(k * 2654435761u % 1000003u) / 7; }

/// A state of n particles of which ids are missing, with all kinds of tables.
inline io::State state(std::size_t n)
{
    io::State s;
    s.texts["run/criterion"] = "sound";
    s.put_one("run/time", 0.25);
    std::vector<std::uint32_t> id, pairs;
    std::vector<std::int32_t> place;
    std::vector<std::int64_t> cost;
    std::vector<double> position, skin, value;
    std::vector<float> density;
    for (std::size_t k = 0; k < n; ++k) {
        id.push_back(std::uint32_t(3'000'000'000u + k * k % 3 + 3 * k)); // few of all that there were
        for (std::size_t c = 0; c < 3; ++c) position.push_back(number(3 * k + c));
        density.push_back(float(number(5 * k)));
        if (k % 4 != 0) continue;
        place.insert(place.end(), {std::int32_t(k / 40) - 7, std::int32_t(k % 40) - 20}); // sorted, also below 0
        skin.push_back(number(7 * k)), cost.push_back(std::int64_t(11 * k));
        for (std::uint32_t j : {1u, 9u}) pairs.insert(pairs.end(), {id[k], id[k] + j}), value.push_back(number(k + j));
    }
    s.put("species_0/id", id), s.put_one("species_0/next_id", std::int64_t(id.empty() ? 0 : id.back() + 1));
    s.put("species_0/position", position, 3), s.put("species_0/density", density);
    s.put("species_0/skin_place", place, 2), s.put("species_0/skin", skin);
    s.put("balance_0/place", place, 2), s.put("balance_0/cost", cost);
    s.put("pairs_0_0/ids", pairs, 2), s.put("pairs_0_0/value", value);
    return s;
}
enum class Whose { even, one_has_none };
/// Who of so many has row k.
inline int owner(std::size_t k, int count, Whose whose)
{
    const auto r = int(k * 2654435761u % 65521u % std::uint64_t(count));
    return whose == Whose::one_has_none && count > 2 && r == 1 ? 0 : r;
}
/// One rank has all in order; of several each has some, in no order that a file has.
template <class T>
std::vector<T> mine(std::vector<T> const& rows, std::size_t columns, int rank, int count,
                    Whose whose = Whose::one_has_none)
{
    if (count == 1) return rows;
    std::vector<T> some;
    for (std::size_t k = rows.size() / columns; k-- > 0;)
        if (owner(k, count, whose) == rank)
            for (std::size_t c = 0; c < columns; ++c) some.push_back(rows[k * columns + c]);
    return some;
}
inline io::State part(io::State all, int rank, int count, Whose whose = Whose::one_has_none)
{
    for (auto& [name, table] : all.tables)
        if (!io::detail::key_of(name).empty())
            std::visit([&, n = table.columns](auto& rows) { rows = mine(rows, n, rank, count, whose); }, table.values);
    return all;
}
inline io::Cloud cloud(std::size_t n)
{
    io::Cloud c{.time = 0.5, .step = 3, .points = {}, .columns = {{"velocity", 3, {}}, {"radius", 1, {}}}};
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t d = 0; d < 3; ++d) c.points.push_back(float(number(k + d)));
        for (std::size_t d = 0; d < 3; ++d) c.columns[0].values.push_back(float(number(2 * k + d)));
        c.columns[1].values.push_back(float(number(3 * k)));
        c.species.push_back(k > n / 2);
        c.id.push_back(std::int64_t(2 * k));
    }
    return c;
}
inline io::Cloud part(io::Cloud c, int rank, int count)
{
    c.points = mine(c.points, 3, rank, count);
    for (auto& column : c.columns) column.values = mine(column.values, std::size_t(column.components), rank, count);
    c.id = mine(c.id, 1, rank, count), c.species = mine(c.species, 1, rank, count);
    return c;
}
inline std::string content(std::filesystem::path const& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The file of all is, byte by byte, that of one. \param folder  that all ranks see
inline void expect_files_of_one(auto const& ranks, std::filesystem::path const& folder)
{
    const int rank = ranks.rank(), count = ranks.count();
    const io::TheseRanks these(ranks);
    for (const std::size_t n : {std::size_t{0}, std::size_t{2}, std::size_t{70'001}}) { // more than one chunk and block
        const io::State all = state(n);
        const io::Cloud points = cloud(n);
        io::write_checkpoint(these, folder / "ranks.h5", part(all, rank, count));
        io::write_vtkhdf(these, folder / "ranks.hdf", part(points, rank, count));
        these.together([&] {
            if (rank != 0) return;
            io::write_checkpoint(folder / "one.h5", all);
            io::write_vtkhdf(folder / "one.hdf", points);
            EXPECT_EQ(io::read_checkpoint(folder / "ranks.h5").tables, all.tables);
            EXPECT_TRUE(content(folder / "ranks.h5") == content(folder / "one.h5")) << n;
            EXPECT_TRUE(content(folder / "ranks.hdf") == content(folder / "one.hdf")) << n;
            EXPECT_GT(content(folder / "ranks.hdf").size(), 37 * n); // bytes of what is not compressed
        });
    }
}
/// What cannot be written ends all with an error and leaves the old file; then they go on.
inline void expect_errors_of_all(auto const& ranks, std::filesystem::path const& folder)
{
    const int rank = ranks.rank(), count = ranks.count();
    const io::TheseRanks these(ranks);
    const auto file = folder / "kept.h5";
    const io::State all = state(20'000), few = state(7);
    auto write = [&](std::filesystem::path const& to, io::State const& s) {
        io::write_checkpoint(these, to, part(s, rank, count));
    };
    auto all_throw = [&](auto const& f) {
        if (rank == 0) EXPECT_THROW(f(), OutputError);
        else EXPECT_THROW(f(), OtherRankFailed);
    };
    write(file, few);
    all_throw([&] { write(folder / "not_there" / "c.h5", few); });
    const bool in_one_process = count > 1 && !these.communicator();
    { // a full disk
        std::optional<small_tank::SmallDisk> disk;
        if (rank == 0 || !in_one_process) disk.emplace(4096);
        all_throw([&] { write(file, all); });
        (void)these.any(false);
    }
    (void)these.any(false); // in one process nobody sets a limit before this one is gone
    try {                   // a disk that is full for the last rank alone, whose rows others may write by now
        std::optional<small_tank::SmallDisk> disk;
        if (rank == count - 1 && rank > 0) disk.emplace(4096);
        write(file, few), write(file, all);
        these.together([&] { EXPECT_TRUE(io::read_checkpoint(file).tables == all.tables); });
        write(file, few);
    }
    catch (std::runtime_error const&) {
    }
    (void)these.any(false);
    these.together([&] {
        EXPECT_TRUE(io::read_checkpoint(file).tables == few.tables);
        EXPECT_FALSE(std::filesystem::exists(file.string() + ".tmp"));
    });
    write(file, all);
    these.together([&] { EXPECT_TRUE(io::read_checkpoint(file).tables == all.tables); });
}

} // namespace shared_rows
