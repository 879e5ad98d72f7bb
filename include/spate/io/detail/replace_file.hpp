// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Replaces a file as a whole: a reader finds the old content or the new one, never a part, also after a crash.
///        Not for files that grow.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "spate/io/output_error.hpp"

namespace spate::io::detail {

/// FILE.tmp while it is written; removed unless it was renamed.
class Temporary {
public:
    explicit Temporary(std::filesystem::path const& file)
        : file_(file), tmp_(name_of(file)),
          descriptor_(::open(tmp_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666))
    {
        if (descriptor_ < 0) throw OutputError(file_, errno);
    }
    Temporary(Temporary const&) = delete;
    Temporary& operator=(Temporary const&) = delete;
    ~Temporary()
    {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!renamed_) ::unlink(tmp_.c_str());
    }

    static std::filesystem::path name_of(std::filesystem::path const& file) { return file.string() + ".tmp"; }

    /// Keeps room on the disk for so many bytes, which are zeros if they are not written.
    void reserve(std::uint64_t bytes)
    {
        int error = EINTR;
        while (error == EINTR) error = ::posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes));
        if (error != 0) throw OutputError(file_, error);
    }
    [[nodiscard]] std::uint64_t size() const
    {
        const off_t end = ::lseek(descriptor_, 0, SEEK_END);
        if (end < 0) throw OutputError(file_, errno);
        return static_cast<std::uint64_t>(end);
    }
    /// From the begin of the file on.
    void rewind() const
    {
        if (::lseek(descriptor_, 0, SEEK_SET) < 0) throw OutputError(file_, errno);
    }
    void write(std::span<std::byte const> bytes)
    {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) throw OutputError(file_, errno);
            if (written == 0) throw OutputError(file_, ENOSPC);
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        }
    }

    void rename()
    {
        if (::fsync(descriptor_) != 0) throw OutputError(file_, errno);
        if (::close(std::exchange(descriptor_, -1)) != 0) throw OutputError(file_, errno);
        if (::rename(tmp_.c_str(), file_.c_str()) != 0) throw OutputError(file_, errno);
        renamed_ = true;
    }

private:
    std::filesystem::path file_;
    std::filesystem::path tmp_;
    int descriptor_;
    bool renamed_ = false;
};

/// Best effort: the file is complete and in place already, and some file systems refuse to sync a directory.
inline void sync_directory(std::filesystem::path const& file)
{
    const std::filesystem::path directory = file.has_parent_path() ? file.parent_path() : ".";
    const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

inline void replace_file(std::filesystem::path const& file, std::span<std::byte const> bytes)
{
    Temporary temporary(file);
    temporary.write(bytes);
    temporary.rename();
    sync_directory(file);
}

inline void replace_file(std::filesystem::path const& file, std::string_view text)
{
    replace_file(file, std::as_bytes(std::span(text)));
}

} // namespace spate::io::detail
