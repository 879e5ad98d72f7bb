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
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "spate/io/detail/hdf5_in.hpp"
#include "spate/io/detail/replace_file.hpp"
#include "spate/io/state.hpp"

namespace spate::io {

namespace detail {

constexpr int checkpoint_version = 2;
constexpr std::size_t checkpoint_header = 512; ///< what HDF5 calls a user block: it looks for its own start at 512

/// Of blocks of 1 MiB, each with its number, added up: ranks can share the work. A step of a block is a permutation of 2^64
/// (splitmix64, Steele, Lea & Flood 2014), so that no change within one word goes unseen.
inline std::uint64_t checksum(std::span<std::byte const> bytes)
{
    constexpr std::size_t block = std::size_t{1} << 20;
    auto mix = [](std::uint64_t z) {
        z += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    };
    std::uint64_t sum = bytes.size();
    for (std::size_t begin = 0; begin < bytes.size(); begin += block) {
        const auto part = bytes.subspan(begin, std::min(block, bytes.size() - begin));
        std::uint64_t h = mix(begin / block);
        for (std::size_t k = 0; k < part.size(); k += sizeof(std::uint64_t)) {
            std::uint64_t word = 0;
            std::memcpy(&word, part.data() + k, std::min(sizeof word, part.size() - k));
            h = mix(h ^ word);
        }
        sum += h;
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

inline std::vector<std::byte> bytes_of(std::filesystem::path const& file, State const& state)
{
    std::size_t size = 0;
    for (auto const& [name, table] : state.tables) size += table.size() * sizeof(double);
    const Hdf5Image image(file, size);
    auto in_folder = [&](std::string const& name, auto const& write) {
        const std::size_t slash = name.find('/');
        const std::string folder = name.substr(0, slash);
        if (H5Lexists(image.root(), folder.c_str(), H5P_DEFAULT) <= 0) (void)image.group(image.root(), folder);
        write(Hdf5Group(H5Gopen2(image.root(), folder.c_str(), H5P_DEFAULT)), name.substr(slash + 1));
    };
    for (auto const& [name, text] : state.texts)
        in_folder(name, [&, t = text](hid_t folder, std::string const& rest) { image.text(folder, rest, t); });
    for (auto const& [name, table] : state.tables)
        in_folder(name,
                  [&, columns = table.columns, v = std::cref(table.values)](hid_t folder, std::string const& rest) {
                      std::visit(
                          [&]<class T>(std::vector<T> const& values) {
                              image.dataset(folder, rest, std::span<T const>(values), columns);
                          },
                          v.get());
                  });
    return image.bytes();
}

} // namespace detail

/// Throws OutputError, and the file is then what it was before.
inline void write_checkpoint(std::filesystem::path const& file, State const& state)
{
    const std::vector<std::byte> content = detail::bytes_of(file, state);
    const auto header = detail::header_of(detail::checkpoint_version, detail::checkpoint_header + content.size(),
                                          detail::checksum(content));
    detail::Temporary temporary(file);
    temporary.write(std::as_bytes(std::span(header)));
    temporary.write(content);
    temporary.rename();
    detail::sync_directory(file);
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
