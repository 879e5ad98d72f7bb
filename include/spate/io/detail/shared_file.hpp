// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief An HDF5 file that ranks write together, each its stretch of the rows, and that replaces another as a whole. The
///        transport says how: at once if it is MPI's and HDF5 knows MPI, else one after the other. No rank holds it all.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "spate/io/any_ranks.hpp"
#include "spate/io/detail/hdf5_outline.hpp"
#include "spate/io/detail/hdf5_rows.hpp"
#include "spate/io/detail/replace_file.hpp"

namespace spate::io::detail {

/// A full disk is seen when the room is reserved, before HDF5 has the file: HDF5 can neither flush nor close one that it
/// cannot write, and others would wait for it. What goes wrong is thrown by all ranks. All calls are made by all of them.
class SharedFile {
public:
    struct Room {
        std::size_t head;    ///< before the HDF5 file, which looks for its start at 0, 512, 1024, ... [bytes]
        std::uint64_t rows;  ///< of all ranks [bytes]
        std::size_t objects; ///< groups, datasets, attributes: about a kilobyte each
    };
    /// \param outline  what of the file is not rows, and the room for these; rank 0 calls it
    SharedFile(AnyRanks const& ranks, std::filesystem::path const& file, Room const& room,
               std::function<void(Hdf5Outline const&)> const& outline)
        : ranks_(ranks), file_(file), head_(room.head)
    {
        ranks.together([&] {
            if (ranks.rank() != 0) return;
            temporary_.emplace(file);
            temporary_->write(std::vector<std::byte>(room.head));
            temporary_->write(empty_hdf5(file));
            temporary_->reserve(room.head + room.rows + 1024 * (16 + room.objects));
            const Hdf5Outline hdf5(Temporary::name_of(file), file);
            outline(hdf5);
            hdf5.flush();
        });
    }
    /// \param write  puts the stretches of this rank into the file; it throws nothing
    void fill(std::function<void(Hdf5Rows&)> const& write)
    {
        const auto communicator = hdf5_knows_mpi ? ranks_.communicator() : std::nullopt;
        std::string failed;
        auto open_and_write = [&] {
            Hdf5Rows rows(Temporary::name_of(file_), communicator);
            if (!communicator || !ranks_.any(!rows.failed().empty())) write(rows), rows.flush();
            failed = rows.failed();
        };
        if (communicator) {
            ranks_.together([&] { (void)Opened(file_, O_RDWR); }); // who cannot does not let others wait in HDF5
            open_and_write();
        }
        for (int r = 0; r < ranks_.count() && !communicator; ++r)
            ranks_.together([&] {
                if (r == ranks_.rank()) open_and_write();
            });
        ranks_.together([&] {
            if (!failed.empty()) (void)hdf5_check(-1, file_, failed);
        });
    }
    /// The size of the file, and f(number, bytes) of each block of it, behind the head, added up.
    struct Sum {
        std::uint64_t size, blocks;
    };
    [[nodiscard]] Sum sum(std::size_t block,
                          std::function<std::uint64_t(std::uint64_t, std::span<std::byte const>)> const& f)
    {
        std::vector<std::uint64_t> all{temporary_ ? temporary_->size() : 0};
        ranks_.sum(all);
        const std::uint64_t size = all[0], blocks = (size - head_ + block - 1) / block;
        all[0] = 0;
        ranks_.together([&] {
            const Opened in(file_, O_RDONLY);
            std::vector<std::byte> bytes;
            for (auto k = std::uint64_t(ranks_.rank()); k < blocks; k += std::uint64_t(ranks_.count())) {
                bytes.resize(std::min<std::uint64_t>(block, size - head_ - k * block));
                in.read(head_ + k * block, bytes);
                all[0] += f(k, bytes);
            }
        });
        ranks_.sum(all);
        return {size, all[0]};
    }
    /// The file has its name from now on, and these bytes at its begin.
    void finish(std::span<std::byte const> head)
    {
        ranks_.together([&] {
            if (!temporary_) return;
            temporary_->rewind();
            temporary_->write(head);
            temporary_->rename();
            sync_directory(file_);
        });
    }

private:
    /// The temporary file, as any rank sees it.
    class Opened {
    public:
        Opened(std::filesystem::path const& file, int how)
            : file_(file), descriptor_(::open(Temporary::name_of(file).c_str(), how | O_CLOEXEC))
        {
            if (descriptor_ < 0) throw OutputError(file, errno);
        }
        Opened(Opened const&) = delete;
        Opened& operator=(Opened const&) = delete;
        ~Opened() { ::close(descriptor_); }
        void read(std::uint64_t at, std::span<std::byte> bytes) const
        {
            while (!bytes.empty()) {
                const ssize_t n = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
                if (n < 0 && errno == EINTR) continue;
                if (n <= 0) throw OutputError(file_, n < 0 ? errno : EIO);
                bytes = bytes.subspan(static_cast<std::size_t>(n)), at += static_cast<std::uint64_t>(n);
            }
        }

    private:
        std::filesystem::path const& file_;
        int descriptor_;
    };

    AnyRanks const& ranks_;
    std::filesystem::path file_;
    std::size_t head_;
    std::optional<Temporary> temporary_; ///< on rank 0
};

} // namespace spate::io::detail
