// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Ranks that were given different options would wait for each other for ever: found before anything begins.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <spate/core/errors.hpp>
#include <spate/core/together.hpp>

namespace example {

/// Throws BadInput on all ranks if the command line of one is not that of rank 0.
template <spate::Ranks R>
void require_same_words(R const& ranks, int argc, char** argv)
{
    std::vector<char> mine;
    for (int k = 1; k < argc; ++k)
        for (char const* c = argv[k]; mine.push_back(*c), *c != '\0'; ++c) {}
    const std::vector<char> first = shared(ranks, ranks.rank() == 0 ? mine : std::vector<char>());
    spate::together(ranks, [&] {
        if (mine == first) return;
        std::size_t at = 0, word = 1, begin = 0;
        for (; at < mine.size() && at < first.size() && mine[at] == first[at]; ++at)
            if (mine[at] == '\0') ++word, begin = at + 1;
        auto said = [&](std::vector<char> const& words) {
            return begin < words.size() ? "'" + std::string(&words[begin]) + "'" : std::string("absent");
        };
        throw spate::BadInput("word " + std::to_string(word) + " of the command line of rank " +
                                  std::to_string(ranks.rank()),
                              said(mine), said(first) + ", as on rank 0: all ranks are given the same options");
    });
}

} // namespace example
