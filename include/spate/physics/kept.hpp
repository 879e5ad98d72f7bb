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
/// The memory of a block's pairs, row by row: what has been read of a row makes room for what is kept of it.
template <int Dim, class V, class S>
class BlockMemory {
    using T = scalar_t<V>;
    static constexpr auto values = std::size_t(Layout<Dim, S>::count);
    using Pairs = KeptPairs<T, int(values)>;
    static_assert(std::size_t(width<V>) <= 8 * sizeof(typename Pairs::Set), "spate: a set has a bit for each lane");

public:
    /// \param first  row of the lists
    [[gnu::always_inline]] BlockMemory(Pairs& pairs, std::size_t block, std::size_t first, Carry const& carry)
        : pairs_(pairs), block_(block), set_(pairs.set.data() + first), from_(pairs.of(block)), to_(pairs.of(block)),
          carry_(carry)
    {}
    /// The next row has no pair that touches.
    [[gnu::always_inline]] void skip() { next(0); }
    /// What is kept of the pairs of the next row.
    [[gnu::always_inline]] auto load() const
    {
        Kept<Dim, V, S> kept;
        kept.record.elapsed = V(carry_.elapsed);
        const SomeLanes<V> lanes(*set_);
        const std::size_t each = Pairs::count(*set_);
        __builtin_prefetch(from_ + 1024 / sizeof(T)); // the next block's
        kept.each([&](V & v, int k) __attribute__((always_inline)) { v = lanes.load(from_ + std::size_t(k) * each); });
        return kept;
    }
    /// ... and what will be, of the lanes that touch now.
    [[gnu::always_inline]] void store(Kept<Dim, V, S>& kept, unsigned touching)
    {
        if (carry_.keep) {
            if (carry_.reach != 1) go_on(kept);
            const auto now = std::size_t(std::popcount(touching)), room = read_ + Pairs::count(*set_);
            if (written_ + now > (moved_ ? pairs_.room(block_) : room)) make_way(now);
            const SomeLanes<V> lanes(touching);
            kept.each([&](V const& v, int k) __attribute__((always_inline)) {
                lanes.store(to_ + written_ * values + std::size_t(k) * now, v);
            });
            written_ += now;
        }
        next(touching);
    }

private:
    [[gnu::always_inline]] void next(unsigned touching)
    {
        const std::size_t was = Pairs::count(*set_);
        read_ += was, from_ += was * values;
        if (carry_.keep) *set_ = typename Pairs::Set(touching);
        ++set_;
    }
    [[gnu::always_inline]] void go_on(Kept<Dim, V, S>& kept)
    {
        const SomeLanes<V> lanes(*set_);
        const std::size_t each = Pairs::count(*set_);
        kept.each([&](V & v, int k) __attribute__((always_inline)) {
            const V was = lanes.load(from_ + std::size_t(k) * each);
            v = was + carry_.reach * (v - was);
        });
    }
    /// More pairs touch than did: what is still to be read is put aside.
    [[gnu::noinline]] void make_way(std::size_t now)
    {
        static thread_local Array<T> aside;
        if (!moved_) {
            aside.reserve(1); // so that it is somewhere
            aside.assign(from_, static_cast<T const*>(to_) + pairs_.room(block_) * values);
            from_ = aside.data(), moved_ = true;
        }
        if (written_ + now <= pairs_.room(block_)) return;
        pairs_.grow(block_, written_ + now);
        to_ = pairs_.of(block_);
    }
    Pairs& pairs_;
    std::size_t block_;
    typename Pairs::Set* set_;
    T const* from_;
    T* to_;
    std::size_t read_ = 0, written_ = 0;
    bool moved_ = false;
    Carry carry_;
};
/// Nothing is kept.
struct NoMemory {
    static void skip() {}
};
} // namespace detail

} // namespace spate
