// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What is thrown when a result cannot be written: the path, the reason and the cure, in one sentence.
///        Not for a wrong argument, which is std::invalid_argument.
#pragma once

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace spate {

struct OutputError : std::runtime_error {
    [[gnu::cold]] OutputError(std::filesystem::path const& path, std::string const& reason, std::string const& cure)
        : std::runtime_error("spate: cannot write " + path.string() + " (" + reason + "); " + cure)
    {}

    /// From an errno of the operating system.
    [[gnu::cold]] OutputError(std::filesystem::path const& path, int error)
        : OutputError(path, std::generic_category().message(error), cure(error))
    {}

    static std::string cure(int error)
    {
        switch (error) {
        case ENOSPC:
        case EDQUOT:
        case EFBIG: return "free some space there, or choose an output directory on another disk";
        case EACCES:
        case EPERM:
        case EROFS: return "choose an output directory in which you may write";
        case ENOENT:
        case ENOTDIR: return "create that directory first, or choose one that exists";
        case EISDIR:
        case EEXIST: return "move what is in the way, or choose another name";
        default: return "choose another output directory";
        }
    }
};

} // namespace spate
