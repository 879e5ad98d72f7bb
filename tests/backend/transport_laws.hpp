// SPDX-License-Identifier: BSD-3-Clause
// What every transport must do; called on all ranks.
#pragma once

#include "spate/core/reduction.hpp"
#include "spate/core/together.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace transport {

using namespace spate;

/// All ranks learn what all together have.
inline void expect_agreement(Ranks auto const& ranks)
{
    const int n = ranks.count(), me = ranks.rank();
    EXPECT_EQ(ranks.all(me + 1, agree::Sum{}), n * (n + 1) / 2);
    EXPECT_EQ(ranks.all(me, agree::Most{}), n - 1);
    EXPECT_EQ(ranks.all(double(me) + 0.5, agree::Least{}), 0.5);
    EXPECT_EQ(ranks.all(me == n - 1, agree::Or{}), true);
    EXPECT_EQ(ranks.all(false, agree::Or{}), false);
    std::vector<std::int64_t> each(std::size_t(n), 0);
    each[std::size_t(me)] = me * me;
    ranks.each(each, agree::Sum{});
    for (int r = 0; r < n; ++r) EXPECT_EQ(each[std::size_t(r)], r * r);
    ExactSum sum; // 1e300 - 1e300 and small numbers: floating point would lose them in most orders
    sum.add(me % 2 == 0 ? 1e300 : -1e300), sum.add(1e-300 * (me + 1));
    if (n % 2 == 1 && me == n - 1) sum.add(-1e300);
    EXPECT_DOUBLE_EQ(ranks.all(sum, agree::Sum{}).value(), 1e-300 * (n * (n + 1) / 2));
}
/// Each message comes to whom it was sent, in the order of the senders; round after round.
inline void expect_scatter(Ranks auto const& ranks)
{
    const int n = ranks.count(), me = ranks.rank();
    for (int round = 0; round < 5; ++round) {
        std::vector<Parcel> out;
        for (int to = n - 1; to >= 0; --to) {
            if ((me + to + round) % 3 == 0) continue;
            out.push_back({to, {}});
            out.back().message.put(100 * me + to);
            out.back().message.put(std::vector<double>(std::size_t(round * 10), me));
        }
        auto in = ranks.scatter(std::move(out));
        std::size_t k = 0;
        for (int from = 0; from < n; ++from) {
            if ((me + from + round) % 3 == 0) continue;
            ASSERT_LT(k, in.size());
            EXPECT_EQ(in[k].rank, from);
            EXPECT_EQ(in[k].message.template take<int>(), 100 * from + me);
            EXPECT_EQ(in[k].message.template take_all<double>(), std::vector<double>(std::size_t(round * 10), from));
            EXPECT_TRUE(in[k].message.empty());
            ++k;
        }
        EXPECT_EQ(k, in.size());
    }
}
/// Packets of two tags in the air at once do not mix; each is named once.
inline void expect_exchange(Ranks auto const& ranks)
{
    const int n = ranks.count(), me = ranks.rank(), next = (me + 1) % n, last = (me + n - 1) % n;
    for (int round = 0; round < 3; ++round) {
        std::array<std::array<double, 4>, 2> out, in{};
        for (int tag = 0; tag < 2; ++tag) out[std::size_t(tag)].fill(me + 0.25 * tag + 1000 * round);
        auto fly = [&](int tag, int to, int from) {
            const Packet sent{to, std::as_writable_bytes(std::span(out[std::size_t(tag)]))};
            const Packet received{from, std::as_writable_bytes(std::span(in[std::size_t(tag)]))};
            return ranks.exchange(std::span(&sent, 1), std::span(&received, 1), tag);
        };
        auto up = fly(0, next, last);
        auto down = fly(1, last, next);
        static_assert(Flight<decltype(up)>);
        EXPECT_EQ(down.next(), 0);
        EXPECT_EQ(down.next(), -1);
        EXPECT_EQ(up.next(), 0);
        EXPECT_EQ(up.poll(), -1);
        EXPECT_EQ(up.next(), -1);
        EXPECT_EQ(in[0][3], last + 1000 * round);
        EXPECT_EQ(in[1][0], next + 0.25 + 1000 * round);
    }
}
/// What one rank throws all throw; of several stops that of the least particle.
inline void expect_togetherness(Ranks auto const& ranks)
{
    const int n = ranks.count(), me = ranks.rank();
    auto stop = [&](int particle) {
        StopFacts f;
        f.particle = particle, f.species = 0, f.step = 12, f.quantity = "density", f.value = me;
        throw NonFinite(f);
    };
    try {
        together(ranks, [&] { stop(n - me); });
        ADD_FAILURE() << "nobody has stopped";
    }
    catch (NonFinite const& e) {
        EXPECT_EQ(e.facts().particle, 1);
        EXPECT_EQ(e.facts().value, n - 1);
        EXPECT_EQ(e.facts().quantity, "density");
        EXPECT_EQ(e.facts().step, 12);
    }
    EXPECT_THROW(together(ranks, [&] { require(me != n - 1, "dt", -1, "above 0"); }), BadInput);
    EXPECT_THROW(together(ranks,
                          [&] {
                              if (me == 0) throw std::runtime_error("the disk is full");
                          }),
                 std::runtime_error);
    EXPECT_NO_THROW(together(ranks, [] {}));
}

} // namespace transport
