// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The file of a checkpoint: a header of 512 bytes with version, size and checksum, then an HDF5 file that any
///        HDF5 reader opens as it is. What it holds is io/state.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "spate/io/any_ranks.hpp"
#include "spate/io/detail/hdf5_in.hpp"
#include "spate/io/detail/rows_of_ranks.hpp"
#include "spate/io/detail/shared_file.hpp"
#include "spate/io/state.hpp"

namespace spate::io {

namespace detail {

constexpr int checkpoint_version = 2;
constexpr std::size_t checkpoint_header = 512; ///< what HDF5 calls a user block: it looks for its own start at 512

constexpr std::size_t checkpoint_block = std::size_t{1} << 20;

/// Of a block with its number. A step is a permutation of 2^64 (splitmix64, Steele, Lea & Flood 2014), so that no change
/// within one word goes unseen.
inline std::uint64_t checksum_of_block(std::uint64_t number, std::span<std::byte const> bytes)
{
    auto mix = [](std::uint64_t z) {
        z += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    };
    std::uint64_t h = mix(number);
    for (std::size_t k = 0; k < bytes.size(); k += sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + k, std::min(sizeof word, bytes.size() - k));
        h = mix(h ^ word);
    }
    return h;
}
/// The size and those of all blocks added up: ranks share the work.
inline std::uint64_t checksum(std::span<std::byte const> bytes)
{
    std::uint64_t sum = bytes.size();
    for (std::size_t k = 0; k * checkpoint_block < bytes.size(); ++k) {
        const auto rest = bytes.subspan(k * checkpoint_block);
        sum += checksum_of_block(k, rest.first(std::min(rest.size(), checkpoint_block)));
    }
    return sum;
}

/// The whole header: one that differs in a byte is none.
inline std::array<char, checkpoint_header> header_of(int version, std::uint64_t size, std::uint64_t sum)
{
    std::array<char, checkpoint_header> header{};
    const int n = std::snprintf(header.data(), header.size(),
                                "spate checkpoint\nversion %d\nbytes %llu\nchecksum %016llx\n"
                                "This is an HDF5 file: h5dump, h5py and others open it as it is.\n",
                                version, static_cast<unsigned long long>(size), static_cast<unsigned long long>(sum));
    std::fill(header.begin() + n, header.end(), '\n');
    return header;
}

/// Refuses bytes that are not those which were written.
inline void check_header(State const& state, std::span<std::byte const> file)
{
    std::string head;
    for (const std::byte b : file.first(std::min(file.size(), checkpoint_header))) head += static_cast<char>(b);
    int version = -1;
    unsigned long long size = 0, sum = 0;
    const int read = std::sscanf(head.c_str(), "spate checkpoint\nversion %9d\nbytes %19llu\nchecksum %16llx", &version,
                                 &size, &sum);
    if (read < 1) state.refuse("no checkpoint: it does not begin like one");
    if (version != checkpoint_version)
        state.refuse("of version " + text(version) + ", and this program reads version " + text(checkpoint_version));
    if (file.size() < checkpoint_header || (read >= 2 && file.size() < size))
        state.refuse("cut off after " + text(double(file.size())) + " bytes");
    const auto due = header_of(version, size, sum);
    if (read != 3 || file.size() != size || std::memcmp(due.data(), head.data(), due.size()) != 0 ||
        checksum(file.subspan(checkpoint_header)) != sum)
        state.refuse("damaged: its checksum is not that of its content");
}

/// Folder by folder: texts, what all ranks have alike, and room for the rows of all.
inline void outline_checkpoint(Hdf5Outline const& file, State const& state, StretchesOf const& stretches)
{
    auto in_folder = [&](std::string const& name, auto const& write) {
        const std::size_t slash = name.find('/');
        const std::string folder = name.substr(0, slash);
        if (H5Lexists(file.root(), folder.c_str(), H5P_DEFAULT) <= 0) (void)file.group(file.root(), folder);
        write(Hdf5Group(H5Gopen2(file.root(), folder.c_str(), H5P_DEFAULT)), name.substr(slash + 1));
    };
    for (auto const& [name, text] : state.texts)
        in_folder(name, [&, t = text](hid_t folder, std::string const& rest) { file.text(folder, rest, t); });
    for (auto const& [name, table] : state.tables) {
        const auto keyed = stretches.find(key_of(name));
        const std::optional<std::uint64_t> rows =
            keyed == stretches.end() ? std::nullopt : std::optional(keyed->second.total);
        auto put = [&, t = std::cref(table)](hid_t folder, std::string const& rest) {
            std::visit(
                [&]<class T>(std::vector<T> const& values) {
                    if (rows) (void)file.room<T>(folder, rest, *rows, t.get().columns);
                    else file.dataset(folder, rest, std::span<T const>(values), t.get().columns);
                },
                t.get().values);
        };
        in_folder(name, put);
    }
}

} // namespace detail

/// Of the parts of a state that ranks hold; all of them call it. Throws OutputError, OtherRankFailed where another rank does,
/// and the file is then what it was before.
inline void write_checkpoint(AnyRanks const& ranks, std::filesystem::path const& file, State part)
{
    detail::StretchesOf stretches; // one rank has the whole, and writes it as it is
    if (ranks.count() > 1) stretches = detail::stretch(ranks, part);
    detail::SharedFile::Room room{detail::checkpoint_header, 0, 10 + part.tables.size() + part.texts.size()};
    for (auto const& [name, text] : part.texts) room.rows += text.size();
    for (auto const& [name, table] : part.tables) {
        const auto of = stretches.find(detail::key_of(name));
        const std::uint64_t values = of == stretches.end() ? table.size() : of->second.total * table.columns;
        room.rows += values * std::visit([]<class T>(std::vector<T> const&) { return sizeof(T); }, table.values);
    }
    detail::SharedFile shared(ranks, file, room,
                              [&](auto& outline) { detail::outline_checkpoint(outline, part, stretches); });
    if (!stretches.empty())
        shared.fill([&](detail::Hdf5Rows& rows) {
            for (auto const& [name, table] : part.tables) {
                const auto of = stretches.find(detail::key_of(name));
                if (of == stretches.end() || of->second.total == 0) continue;
                auto write = [&, n = table.columns, &path = name]<class T>(std::vector<T> const& values) {
                    rows.write(path, std::span<T const>(values), n, of->second.first);
                };
                std::visit(write, table.values);
            }
        });
    const auto [size, blocks] = shared.sum(detail::checkpoint_block, detail::checksum_of_block);
    const auto header = detail::header_of(detail::checkpoint_version, size, size - detail::checkpoint_header + blocks);
    shared.finish(std::as_bytes(std::span(header)));
}
/// Of a whole state, which this process has.
inline void write_checkpoint(std::filesystem::path const& file, State state)
{
    write_checkpoint(TheseRanks(Alone{}), file, std::move(state));
}

/// The state in the bytes of a file; throws BadInput with its name if they are not those that were written.
inline State checkpoint_in(std::span<std::byte const> bytes, std::string const& name)
{
    State state;
    state.origin = "the checkpoint " + name;
    detail::check_header(state, bytes);
    detail::Hdf5Contents(bytes.subspan(detail::checkpoint_header), state);
    return state;
}

inline State read_checkpoint(std::filesystem::path const& file)
{
    State state;
    state.origin = "the checkpoint " + file.string();
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    if (error) state.refuse("not to be read (" + error.message() + ")");
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    in.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size()));
    if (!in) state.refuse("not to be read (" + std::generic_category().message(errno) + ")");
    return checkpoint_in(bytes, file.string());
}

} // namespace spate::io
