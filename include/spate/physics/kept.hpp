// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What terms keep of the pairs of one pack: out of where it is stored before they run, and back after.
#pragma once

#include "spate/cells/kept_pairs.hpp"
#include "spate/physics/pair_terms.hpp"

namespace spate {

/// How a sweep treats what terms keep of a pair.
struct Carry {
    double elapsed = 0; ///< from the state that it belongs to, to that of the sweep [s]
    bool keep = false;  ///< it becomes what the terms make of it; else they make it for this sweep only
    double reach = 1;   ///< ... and goes on at that rate, to this many times the elapsed time
};

namespace detail {
/// The memory of the pairs of W lanes; zero of those that did not touch.
template <int Dim, class V, class S>
struct Kept;
template <int Dim, class V, class... F>
struct Kept<Dim, V, Fields<F...>> {
    using L = Layout<Dim, Fields<F...>>;
    struct Seen : Record<Dim, V, Fields<F...>> {
        V elapsed; ///< as i[elapsed] [s]
    } record;

    /// f(value, k) for component k of all that is kept.
    [[gnu::always_inline]] void each(auto const& f)
    {
        auto one = [&]<class G>(G g) __attribute__((always_inline))
        {
            if constexpr (G::rank == 0) f(record[g], L::template offset<G>);
            else
                for (int c = 0; c < components<G, Dim>; ++c) f(record[g][c], L::template offset<G> + c);
        };
        (one(F{}), ...);
    }
};
/// The memory of a block's pairs, row by row. What will be kept is put aside until the block is done: written where it was
/// read, it would make the next row wait for this one, as a processor does not look through the lanes of a store.
template <int Dim, class V, class S>
class BlockMemory {
    using T = scalar_t<V>;
    static constexpr auto values = std::size_t(Layout<Dim, S>::count);
    using Pairs = KeptPairs<T, int(values)>;
    static_assert(std::size_t(width<V>) <= 8 * sizeof(typename Pairs::Set), "spate: a set has a bit for each lane");

public:
    /// \param first, last  rows of the lists
    [[gnu::always_inline]] BlockMemory(Pairs& pairs, std::size_t block, std::size_t first, std::size_t last,
                                       Carry const& carry)
        : pairs_(pairs), block_(block), set_(pairs.set.data() + first), from_(pairs.of(block)), carry_(carry)
    {
        static thread_local Array<T> aside;
        const std::size_t most = ((last - first) * values + 1) * std::size_t(width<V>);
        if (aside.size() < most) aside.resize(most);
        begin_ = to_ = aside.data();
    }
    /// The next row has no pair that touches.
    [[gnu::always_inline]] void skip() { next(0); }
    /// What is kept of the pairs of the next row.
    [[gnu::always_inline]] auto load() const
    {
        Kept<Dim, V, S> kept;
        kept.record.elapsed = V(carry_.elapsed);
        const SomeLanes<V> lanes(*set_);
        const std::size_t each = Pairs::count(*set_);
        for (const std::size_t ahead : {1024u, 1088u})
            __builtin_prefetch(from_ + ahead / sizeof(T)); // [bytes]: the next block's
        kept.each([&](V & v, int k) __attribute__((always_inline)) { v = lanes.load(from_ + std::size_t(k) * each); });
        return kept;
    }
    /// ... and what will be, of the lanes that touch now.
    [[gnu::always_inline]] void store(Kept<Dim, V, S>& kept, unsigned touching)
    {
        if (carry_.keep) {
            if (carry_.reach != 1) go_on(kept);
            const auto now = std::size_t(std::popcount(touching));
            const SomeLanes<V> lanes(touching);
            kept.each([&](V const& v, int k)
                          __attribute__((always_inline)) { lanes.store(to_ + std::size_t(k) * now, v); });
            to_ += now * values;
        }
        next(touching);
    }
    /// All rows are done.
    [[gnu::always_inline]] void finish()
    {
        if (!carry_.keep) return;
        const auto n = std::size_t(to_ - begin_);
        if (n > pairs_.room(block_) * values) pairs_.grow(block_, n / values);
        std::copy_n(static_cast<T const*>(begin_), n, pairs_.of(block_));
    }

private:
    [[gnu::always_inline]] void next(unsigned touching)
    {
        from_ += Pairs::count(*set_) * values;
        if (carry_.keep) *set_ = typename Pairs::Set(touching);
        ++set_;
    }
    [[gnu::noinline]] void go_on(Kept<Dim, V, S>& kept)
    {
        const SomeLanes<V> lanes(*set_);
        const std::size_t each = Pairs::count(*set_);
        kept.each([&](V & v, int k) __attribute__((always_inline)) {
            const V was = lanes.load(from_ + std::size_t(k) * each);
            v = was + carry_.reach * (v - was);
        });
    }
    Pairs& pairs_;
    std::size_t block_;
    typename Pairs::Set* set_;
    T const* from_;
    T *begin_, *to_; ///< aside
    Carry carry_;
};
/// Nothing is kept.
struct NoMemory {
    static void skip() {}
    static void finish() {}
};
} // namespace detail

} // namespace spate
