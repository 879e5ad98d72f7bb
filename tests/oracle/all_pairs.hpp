// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Every pair by brute force, and what neighbour lists hold, in one form: ids and the shift of the source.
#pragma once

#include <spate/cells/neighbours.hpp>

#include <algorithm>
#include <compare>
#include <vector>

namespace spate::oracle {

/// A directed pair: the source is moved by `shift` periods an axis.
struct Pair {
    std::uint32_t target, source; ///< ids
    std::array<int, 3> shift;     ///< -1, 0, 1
    auto operator<=>(Pair const&) const = default;
};

/// Distance squared of target i from source j, moved by the shift; positions as stored, arithmetic in double.
template <int Dim>
double distance2(auto const& target, std::size_t i, auto const& source, std::size_t j, std::array<int, 3> const& shift,
                 Vec<Dim, double> const& period)
{
    double d2 = 0;
    for (int c = 0; c < Dim; ++c) {
        const double d = target.at(position, i)[c] - (source.at(position, j)[c] + shift[std::size_t(c)] * period[c]);
        d2 += d * d;
    }
    return d2;
}

/// All directed pairs nearer than a distance, sorted; `period` is 0 along open axes.
template <int Dim>
std::vector<Pair> all_pairs(auto const& target, auto const& source, bool same, Vec<Dim, double> const& period,
                            double reach)
{
    std::vector<Pair> pairs;
    auto one = [&](std::size_t i, std::size_t j, std::array<int, 3> const& s) {
        if (same && i == j && s == std::array<int, 3>{}) return;
        if (distance2<Dim>(target, i, source, j, s, period) < reach * reach)
            pairs.push_back({target.id()[i], source.id()[j], s});
    };
    const int sx = period[0] > 0, sy = Dim > 1 && period[Dim > 1 ? 1 : 0] > 0, sz = Dim > 2 && period[Dim - 1] > 0;
    for (std::size_t i = 0; i < target.size(); ++i)
        for (std::size_t j = 0; j < source.size(); ++j)
            for (int z = -sz; z <= sz; ++z)
                for (int y = -sy; y <= sy; ++y)
                    for (int x = -sx; x <= sx; ++x) one(i, j, {x, y, z});
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

/// One entry of a list: target and source by index, and the shift.
struct Entry {
    std::size_t i, j;
    std::array<int, 3> shift;
};

inline std::array<int, 3> shift_of_code(int code)
{
    std::array<int, 3> s{};
    for (auto& digit : s) digit = code % 3 == 2 ? -1 : code % 3, code /= 3;
    return s;
}

/// f(entry) for each entry of all lists, target by target in list order. Returns false if a list is malformed: an entry
/// after its sentinel, or an entry of a lane without a target.
template <int Dim>
bool each_entry(Lists<Dim> const& lists, Binning<Dim> const& at, Binning<Dim> const& of, std::size_t sources, int W,
                auto const& f)
{
    bool good = true;
    const auto w = std::size_t(W);
    for (std::size_t k = 0; k < at.cells(); ++k) {
        auto const& cell = lists.of_cell(k);
        for (std::size_t b = 0; b + 1 < cell.begin.size(); ++b)
            for (std::size_t lane = 0; lane < w; ++lane) {
                const std::size_t slot = b * w + lane;
                const auto targets = std::size_t(at.end(k) - at.begin(k));
                bool ended = slot >= targets;
                const std::size_t i = std::size_t(at.begin(k)) + (ended ? 0 : std::size_t(cell.target_of(slot)));
                for (auto row = std::size_t(cell.begin[b]); row < std::size_t(cell.begin[b + 1]); ++row) {
                    const std::size_t v = lists.number(cell.index[row * w + lane]);
                    if (v == sources) {
                        ended = true;
                        continue;
                    }
                    good = good && !ended && v <= sources + of.images().of.size();
                    if (!good) return false;
                    if (v < sources) f(Entry{i, v, {}});
                    else {
                        const std::size_t g = v - sources - 1;
                        f(Entry{i, std::size_t(of.images().of[g]), shift_of_code(of.images().code[g])});
                    }
                }
            }
    }
    return good;
}

} // namespace spate::oracle
