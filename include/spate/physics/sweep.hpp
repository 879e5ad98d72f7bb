// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The hot loop: for each block of W targets, the sums of all fused pair terms over the neighbours of each.
/// Lanes hold targets, so each particle's sum runs over its own neighbours in order: bits do not depend on W, on the
/// skin, or on who runs the cell.
#pragma once

#include "spate/cells/neighbours.hpp"
#include "spate/core/term.hpp"
#include "spate/physics/plan.hpp"

#include <tuple>

namespace spate {

/// The records of one species as a source: record i at data + i * stride, which is what lists hold; record n is the
/// sentinel, out of everyone's range; images follow.
template <int Dim, Real T, class S>
struct Packed {
    using L = Layout<Dim, S>;
    static constexpr S fields{};
    static constexpr T far =
        T(sizeof(T) == 4 ? 1e8 : 1e12); ///< where the sentinel is [m]: its cube times a density is finite
    Array<T> data;
};

/// How a sweep treats what terms keep of a pair.
struct Carry {
    double elapsed = 0; ///< from the state that it belongs to, to that of the sweep [s]
    bool keep = false;  ///< it becomes what the terms make of it; else they make it for this sweep only
    double reach = 1;   ///< ... and goes on at that rate, to this many times the elapsed time
};

/// One source of a sweep: its records, what is uniform in it, the lists target <- source, and the terms that read it.
/// \tparam Kept_  what the terms keep of its pairs
template <Mask terms_, class Kept_, class P, class R>
struct Source {
    static constexpr Mask terms = terms_;
    using Kept = Kept_;
    using L = typename R::L;
    P const& particles;
    R const& packed;
    Lists<P::dim> const& lists;
    bool same; ///< the target's own species
    std::vector<Array<typename P::real>>*
        memory; ///< of the pairs, by cell; of W lanes together, component by component
    Carry carry;
};

/// Whether an interaction asks for lists whose targets stay in order: they are short.
template <class I>
inline constexpr bool short_lists = requires
{
    requires I::neighbours.window == 1;
};

namespace detail {
template <Mask terms, std::size_t t>
inline constexpr bool picked = ((terms >> t) & 1) != 0;

/// f(i, j): a pair as the term T may see it; `kept` is the memory of the pair.
template <class T, class Ri, class Ui, class Rj, class Uj, class A, class Pair, class K>
[[gnu::always_inline]] inline void with_views(Ri const& ri, Ui const& ui, Rj const& rj, Uj const& uj, A& sums,
                                              Pair const& ij, K* kept, auto const& f)
{
    using Readable_i = std::remove_cvref_t<decltype(reads_i<T>())>;
    using Readable_j = std::remove_cvref_t<decltype(reads_j<T>())>;
    using Addable = std::remove_cvref_t<decltype(adds<T>())>;
    using H = std::conditional_t<decltype(keeps<T>())::size == 0, void, K>;
    H* memory = nullptr;
    if constexpr (!std::is_void_v<H>) memory = kept;
    const View<Readable_j, Fields<>, Rj, Uj, void> j{rj, uj, nullptr, {}};
    if constexpr (requires { ij.mask; }) {
        using M = std::remove_cvref_t<decltype(ij.mask)>;
        View<Readable_i, Addable, Ri, Ui, A, M, H> i{ri, ui, &sums, ij.mask, memory};
        f(i, j);
    }
    else {
        View<Readable_i, Addable, Ri, Ui, A, Always, H> i{ri, ui, &sums, {}, memory};
        f(i, j);
    }
}
/// One term on one pack of pairs.
template <class Ri, class Ui, class Rj, class Uj, class A, class Pair, class T, class K = void>
[[gnu::always_inline]] inline void apply(T const& term, Ri const& ri, Ui const& ui, Rj const& rj, Uj const& uj, A& sums,
                                         Pair const& ij, K* kept = nullptr)
{
    with_views<T>(
        ri, ui, rj, uj, sums, ij, kept, [&](auto& i, auto const& j) __attribute__((always_inline)) { term(i, j, ij); });
}
template <Mask terms, class Ri, class Ui, class Rj, class Uj, class A, class Pair, class... T, std::size_t... t,
          class K = void>
[[gnu::always_inline]] inline void apply_all(std::tuple<T...> const& all, Ri const& ri, Ui const& ui, Rj const& rj,
                                             Uj const& uj, A& sums, Pair const& ij, std::index_sequence<t...>,
                                             K* kept = nullptr)
{
    auto one = [&]<std::size_t k>(std::integral_constant<std::size_t, k>) __attribute__((always_inline))
    {
        if constexpr (picked<terms, k>) apply(std::get<k>(all), ri, ui, rj, uj, sums, ij, kept);
    };
    (one(std::integral_constant<std::size_t, t>{}), ...);
}
/// The memory of W pairs: loaded before the terms, stored after them; out of contact it is zero.
template <int Dim, class V, class S>
struct Kept;
template <int Dim, class V, class... F>
struct Kept<Dim, V, Fields<F...>> {
    using L = Layout<Dim, Fields<F...>>;
    struct Seen : Record<Dim, V, Fields<F...>> {
        V elapsed; ///< as i[elapsed] [s]
    } record;
    scalar_t<V>* at;

    [[gnu::always_inline]] Kept(scalar_t<V>* place, V const& elapsed) : at(place)
    {
        record.elapsed = elapsed;
        each([&](V& v, int k) { v = load<V>(at + k * width<V>); });
    }
    [[gnu::always_inline]] void put_back(auto const& mask, Carry const& carry)
    {
        each([&](V& v, int k) { store(at + k * width<V>, where(mask, reached(v, k, carry), V(0))); });
    }
    [[gnu::always_inline]] void put_back(Carry const& carry)
    {
        each([&](V& v, int k) { store(at + k * width<V>, reached(v, k, carry)); });
    }
    /// None of the pairs is in contact.
    [[gnu::always_inline]] static void forget(scalar_t<V>* place)
    {
        for (int k = 0; k < L::count; ++k) store(place + k * width<V>, V(0));
    }

private:
    [[gnu::always_inline]] V reached(V const& v, int k, Carry const& carry) const
    {
        if (carry.reach == 1) return v;
        const V old = load<V>(at + k * width<V>);
        return old + carry.reach * (v - old);
    }
    [[gnu::always_inline]] void each(auto const& f)
    {
        auto one = [&]<class G>(G g) {
            if constexpr (G::rank == 0) f(record[g], L::template offset<G>);
            else
                for (int c = 0; c < components<G, Dim>; ++c) f(record[g][c], L::template offset<G> + c);
        };
        (one(F{}), ...);
    }
};
/// A position in two parts: near ones differ exactly by their heads, and then by their tails.
template <class X>
struct Split {
    X const &head, &tail;
    [[gnu::always_inline]] friend X operator-(Split const& a, Split const& b)
    {
        return (a.head - b.head) + (a.tail - b.tail);
    }
};
/// One particle as the interaction sees it, with a position in two parts.
template <class S, class R, class U>
struct SplitView {
    View<S, Fields<>, R, U, void> whole;
    template <Field F>
    [[gnu::always_inline]] decltype(auto) operator[](F f) const
    {
        if constexpr (std::same_as<F, Position>) {
            using X = std::remove_cvref_t<decltype(whole.record[position])>;
            return Split<X>{whole.record[position], whole.record[position_tail]};
        }
        else return whole[f];
    }
};
template <class I, class V, class Ri, class Ui, class Rj, class Uj>
[[gnu::always_inline]] inline auto pair_of(I const& interaction, Ri const& ri, Ui const& ui, Rj const& rj, Uj const& uj)
{
    using S = std::remove_cv_t<decltype(I::reads)>;
    if constexpr (Ri::template has<PositionTail>)
        return interaction.template pair<V>(SplitView<S, Ri, Ui>{{ri, ui, nullptr, {}}},
                                            SplitView<S, Rj, Uj>{{rj, uj, nullptr, {}}});
    else
        return interaction.template pair<V>(View<S, Fields<>, Ri, Ui, void>{ri, ui, nullptr, {}},
                                            View<S, Fields<>, Rj, Uj, void>{rj, uj, nullptr, {}});
}
/// Whether an interaction that tells touching pairs apart, touch(i, j), finds any among W.
template <class I, class Ri, class Ui, class Rj, class Uj>
[[gnu::always_inline]] inline bool may_meet(I const& interaction, Ri const& ri, Ui const& ui, Rj const& rj,
                                            Uj const& uj)
{
    using S = std::remove_cv_t<decltype(I::reads)>;
    const View<S, Fields<>, Ri, Ui, void> i{ri, ui, nullptr, {}};
    const View<S, Fields<>, Rj, Uj, void> j{rj, uj, nullptr, {}};
    if constexpr (requires { interaction.touch(i, j); }) return spate::any(interaction.touch(i, j));
    else return true;
}
/// The neighbours of one block of targets in one source.
template <class V, class I, class Tuple, class Ri, class Ui, class A, class Src>
[[gnu::always_inline]] inline void over(I const& interaction, Tuple const& all, Ri const& ri, Ui const& ui, A& sums,
                                        Src const& source, std::size_t cell, std::size_t block)
{
    using L = typename Src::L;
    const auto uj = source.particles.template uniforms<V>();
    auto const& lists = source.lists.of_cell(cell);
    scalar_t<V> const* base = source.packed.data.data();
    std::int32_t const* const index = lists.index.data();
    const auto end = std::size_t(lists.begin[block + 1]) * std::size_t(width<V>);
    // The next blocks' first sight of a row of bins is a miss. In bins that are fine the lanes share lines, so that one lane
    // asks for all; in others each asks for its own.
    constexpr bool each_lane = short_lists<I>;
    constexpr std::size_t ahead = (each_lane ? 16 : 48) * std::size_t(width<V>);
    const std::size_t last = lists.index.size() - std::size_t(each_lane ? width<V> : 1);
    A mine = sums; // a copy in registers: g++ would store sums to the stack with each pack
    for (auto at = std::size_t(lists.begin[block]) * std::size_t(width<V>); at != end; at += std::size_t(width<V>)) {
        std::int32_t const* const later = index + std::min(at + ahead, last);
        for (int l = 0; l < (each_lane ? width<V> : 1); ++l)
            for (int f = 0; f < (each_lane ? L::stride : 1); f += 64 / int(sizeof(scalar_t<V>)))
                __builtin_prefetch(base + std::uint32_t(later[l]) + f);
        const auto rj = gathered<V>(base, index + at, L{});
        if constexpr (Src::Kept::size == 0)
            if (!may_meet<I>(interaction, ri, ui, rj, uj)) continue;
        const auto ij = pair_of<I, V>(interaction, ri, ui, rj, uj);
        constexpr auto terms = std::make_index_sequence<std::tuple_size_v<Tuple>>{};
        if constexpr (Src::Kept::size > 0) {
            using Memory = Kept<I::dim, V, typename Src::Kept>;
            scalar_t<V>* const place = (*source.memory)[cell].data() + at * std::size_t(Memory::L::count);
            if constexpr (requires { ij.mask; })
                if (!spate::any(ij.mask)) {
                    if (source.carry.keep) Memory::forget(place);
                    continue;
                }
            Memory kept(place, V(source.carry.elapsed));
            apply_all<Src::terms>(all, ri, ui, rj, uj, mine, ij, terms, &kept.record);
            if (!source.carry.keep) continue;
            if constexpr (requires { ij.mask; }) kept.put_back(ij.mask, source.carry);
            else kept.put_back(source.carry);
        }
        else {
            if constexpr (requires { ij.mask; })
                if (!spate::any(ij.mask)) continue; // qualified: xsimd has one too
            apply_all<Src::terms>(all, ri, ui, rj, uj, mine, ij, terms);
        }
    }
    sums = mine;
}
/// Terms that count i with itself, and particle terms that add to the same sums.
template <Mask terms, class V, class I, class Ri, class Ui, class A, class... T, std::size_t... t>
[[gnu::always_inline]] inline void with_itself(I const& interaction, std::tuple<T...> const& all, Ri const& ri,
                                               Ui const& ui, A& sums, std::index_sequence<t...>)
{
    auto one = [&]<std::size_t k>(std::integral_constant<std::size_t, k>) __attribute__((always_inline))
    {
        if constexpr (picked<terms, k>) {
            auto const& term = std::get<k>(all);
            using Tk = std::remove_cvref_t<decltype(term)>;
            if constexpr (!PairTerm<Tk>) {
                using Readable = std::remove_cvref_t<decltype(reads_i<Tk>())>;
                using Addable = std::remove_cvref_t<decltype(adds<Tk>() | writes<Tk>())>;
                View<Readable, Addable, Ri, Ui, A> i{ri, ui, &sums, {}};
                term(i);
            }
            else if constexpr (has_self<Tk>) {
                apply(term, ri, ui, ri, ui, sums, pair_of<I, V>(interaction, ri, ui, ri, ui));
            }
        }
    };
    (one(std::integral_constant<std::size_t, t>{}), ...);
}
} // namespace detail

/// Runs the picked terms on all targets of one cell: the unit of work. Flattened: terms are inlined however large the
/// program; a call in the loop would send its sums through memory.
/// \tparam Sums     the fields that the terms add to
/// \tparam Target   the fields that they read of the target
/// \tparam V        what pairs compute with
template <class V, Mask terms, class Sums, class Target, class I, class Tuple, class P, class... Src>
[[gnu::flatten, gnu::noinline]] void sweep_cell(I const& of_scene, Tuple const& terms_of_scene, P& particles,
                                                Binning<P::dim> const& at, std::size_t cell, Src const&... source)
{
    const I interaction = of_scene; // copies in this frame: parameters become invariants in registers
    const Tuple all = terms_of_scene;
    const auto ui = particles.template uniforms<V>();
    const auto first = at.begin(cell);
    auto const& lists = std::get<0>(std::tie(source...)).lists.of_cell(cell);
    const std::size_t blocks = lists.begin.size() - 1;
    const int targets = at.end(cell) - first;
    auto run = [&]<bool in_order>(std::bool_constant<in_order>) __attribute__((always_inline))
    {
        for (std::size_t block = 0; block < blocks; ++block) {
            std::int32_t const* target = lists.target.data() + block * std::size_t(width<V>);
            const std::int32_t at_first = first + (in_order ? std::int32_t(block) * width<V> : 0);
            const auto ri = [&]() __attribute__((always_inline))
            {
                if constexpr (in_order) return particles.template record_at<V>(Target{}, at_first);
                else return particles.template record_of<V>(Target{}, first, target);
            }
            ();
            Record<P::dim, V, Sums> sums;
            clear(sums);
            (detail::over<V>(interaction, all, ri, ui, sums, source, cell, block), ...);
            detail::with_itself<terms, V>(interaction, all, ri, ui, sums,
                                          std::make_index_sequence<std::tuple_size_v<Tuple>>{});
            const int lanes = std::min(targets - int(block) * width<V>, width<V>);
            for_each(
                Sums{}, [&](auto f) __attribute__((always_inline)) {
                    if constexpr (!in_order) particles.template store_of<V>(f, first, target, sums[f], lanes);
                    else if (lanes == width<V>) particles.template store_at<V>(f, std::size_t(at_first), sums[f]);
                    else particles.template store_at<V>(f, std::size_t(at_first), sums[f], lanes);
                });
        }
    };
    // One loop for each, where lists may be short: then what a block costs beside its pairs counts.
    if constexpr (short_lists<I>) {
        if (lists.in_order) return run(std::true_type{});
    }
    run(std::false_type{});
}

} // namespace spate
