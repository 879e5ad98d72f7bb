// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What ranks ask of each other: the whole of what a run on many ranks knows of its transport. All calls but
/// rank() and count() are made by all ranks, in the same order. Models: Alone (here), VirtualRank, MpiRanks.
#pragma once

#include "spate/core/message.hpp"

#include <concepts>
#include <cstdint>

namespace spate {

// clang-format off
template <class R>
concept Ranks = requires(R const r, double x, std::vector<double>& xs, void (*merge)(double&, double const&),
                         std::vector<Parcel> parcels, std::span<Packet const> packets) {
    { R::alone } -> std::convertible_to<bool>;        // constant true: there is one rank, nothing is ever sent
    { r.rank() } -> std::convertible_to<int>;         // 0 to count() - 1
    { r.count() } -> std::convertible_to<int>;
    { r.all(x, merge) } -> std::convertible_to<double>; // the values of all ranks, merged in any order
    r.each(xs, merge);                                // the same for each of several, in place
    { r.scatter(parcels) } -> std::same_as<std::vector<Parcel>>; // to whom they go; returns what came, by rank
    r.exchange(packets, packets, 0);                  // sends the first, receives the second, with a tag: a Flight
};
/// Packets on their way. Both calls name a received packet that was not named yet.
template <class F>
concept Flight = requires(F f) {
    { f.next() } -> std::same_as<int>;                // waits for it; -1: all have come, and all sent ones have left
    { f.poll() } -> std::same_as<int>;                // -1: none at the moment
};
// clang-format on

/// One rank: nothing to say, to nobody. Leaves no instruction.
struct Alone {
    static constexpr bool alone = true;
    [[nodiscard]] static constexpr int rank() { return 0; }
    [[nodiscard]] static constexpr int count() { return 1; }
    template <class T>
    [[nodiscard]] static T const& all(T const& mine, auto const&)
    {
        return mine;
    }
    static void each(auto&, auto const&) {}
    static void leave(int /*code*/) {} // there is nobody to tell
    static std::vector<Parcel> scatter(std::vector<Parcel> parcels) { return parcels; }
    struct Landed {
        static int next() { return -1; }
        static int poll() { return -1; }
    };
    static Landed exchange(std::span<Packet const>, std::span<Packet const>, int) { return {}; }
};

/// What ranks agree on; the merges are the same in any order.
namespace agree {
struct Or {
    void operator()(bool& a, bool b) const { a = a || b; }
};
struct Most {
    template <class T>
    void operator()(T& a, T const& b) const
    {
        if (a < b) a = b;
    }
};
struct Least {
    template <class T>
    void operator()(T& a, T const& b) const
    {
        if (b < a) a = b;
    }
};
struct Sum { // of integers, and of exact sums
    template <class T>
    void operator()(T& a, T const& b) const
    {
        static_assert(!std::floating_point<T>, "spate: a floating-point sum depends on its order; use ExactSum");
        a += b;
    }
};
struct Join { // of Extremes, Spread
    template <class T>
    void operator()(T& a, T const& b) const
    {
        a |= b;
    }
};
} // namespace agree

/// The values of all ranks, one rank after the other, on rank 0; elsewhere none.
template <class R, class T>
[[nodiscard]] std::vector<T> gathered(R const& ranks, std::vector<T> mine)
{
    if constexpr (R::alone) return mine;
    else {
        std::vector<Parcel> parcels(1, Parcel{0, {}});
        parcels.front().message.put(mine);
        parcels = ranks.scatter(std::move(parcels));
        mine.clear();
        for (auto& p : parcels) {
            const auto some = p.message.template take_all<T>();
            mine.insert(mine.end(), some.begin(), some.end());
        }
        return mine;
    }
}
/// The values of all ranks, one rank after the other, on all of them; of few values.
template <class R, class T>
[[nodiscard]] std::vector<T> shared(R const& ranks, std::vector<T> mine)
{
    if constexpr (R::alone) return mine;
    else {
        mine = gathered(ranks, std::move(mine));
        std::vector<Parcel> parcels;
        for (int r = 0; r < ranks.count() && ranks.rank() == 0; ++r) {
            parcels.push_back({r, {}});
            parcels.back().message.put(mine);
        }
        return ranks.scatter(std::move(parcels)).front().message.template take_all<T>();
    }
}
/// The ranks that share a scene.
template <class Scene>
[[nodiscard]] auto party_of([[maybe_unused]] Scene const& scene)
{
    if constexpr (requires { scene.system().ranks(); }) return scene.system().ranks();
    else return Alone{};
}
/// The ranks that a backend works on: its own, or Alone.
template <class Workers>
[[nodiscard]] auto ranks_of([[maybe_unused]] Workers const& workers)
{
    if constexpr (requires { workers.ranks(); }) return workers.ranks();
    else return Alone{};
}

} // namespace spate
