// SPDX-License-Identifier: BSD-3-Clause
// One term of several of a kind, chosen when a test runs: scenes that differ in it alone are one type, compiled once.
#pragma once

#include "spate/core/term.hpp"

#include <tuple>

template <class... Term>
struct OneOf {
    static constexpr auto reads_i = (spate::reads_i<Term>() | ...);
    static constexpr auto reads_j = (spate::reads_j<Term>() | ...);
    static constexpr auto adds = (spate::adds<Term>() | ...);

    std::tuple<Term...> terms;
    int which;

    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        std::apply(
            [&](auto const&... term) {
                int k = 0;
                ((k++ == which ? term(i, j, ij) : void()), ...);
            },
            terms);
    }
};
