// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The hot loop: for each block of W targets, the sums of all fused pair terms over the neighbours of each.
/// Lanes hold targets, so each particle's sum runs over its own neighbours in order: bits do not depend on W, on the
/// skin, or on who runs the cell.
#pragma once

#include "spate/physics/kept.hpp"

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

/// One source of a sweep: its records, what is uniform in it, the lists target <- source, and the terms that read it.
/// \tparam Kept_  what the terms keep of its pairs    \tparam itself_  it is the target's own species
template <Mask terms_, class Kept_, class P, class R, bool itself_ = false>
struct Source {
    static constexpr bool itself = itself_;
    static constexpr Mask terms = terms_;
    using Kept = Kept_;
    using L = typename R::L;
    P const& particles;
    R const& packed;
    Lists<P::dim> const& lists;
    bool same;                                                          ///< the target's own species
    KeptOfCells<typename P::real, Layout<P::dim, Kept>::count>* memory; ///< of the pairs, by cell
    Carry carry;
};

/// Whether an interaction asks for lists whose targets stay in order: they are short.
template <class I>
inline constexpr bool short_lists = requires
{
    requires I::neighbours.window == 1;
};

namespace detail {
/// Whether an interaction that tells touching pairs apart, touch(i, j), finds any among W.
template <class I, class Ri, class Ui, class Rj, class Uj>
[[gnu::always_inline]] inline bool may_meet(I const& interaction, Ri const& ri, Ui const& ui, Rj const& rj,
                                            Uj const& uj)
{
    const auto i = seen_by<I>(ri, ui);
    const auto j = seen_by<I>(rj, uj);
    if constexpr (requires { interaction.touch(i, j); }) return spate::any(interaction.touch(i, j));
    else return true;
}
/// Asks for the records that lists name some blocks after entry `at`.
template <class I, class V, class L>
[[gnu::always_inline]] inline void ask_for_records(scalar_t<V> const* base, Array<std::int32_t> const& index,
                                                   std::size_t at)
{
    // The next blocks' first sight of a row of bins is a miss. In bins that are fine the lanes share lines, so that one lane
    // asks for all; in others each asks for its own.
    constexpr bool each_lane = short_lists<I> && I::dim > 2;
    constexpr std::size_t ahead = (short_lists<I> ? 16 : 48) * std::size_t(width<V>);
    if constexpr (short_lists<I>) __builtin_prefetch(index.data() + at + 4 * ahead); // one cell's are soon at their end
    const std::size_t last = index.size() - std::size_t(each_lane ? width<V> : 1);
    std::int32_t const* const later = index.data() + std::min(at + ahead, last);
    for (int l = 0; l < (each_lane ? width<V> : 1); ++l)
        for (int f = 0; f < (each_lane ? L::stride : 1); f += 64 / int(sizeof(scalar_t<V>)))
            __builtin_prefetch(base + std::uint32_t(later[l]) + f);
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
    using Memory = std::conditional_t<Src::Kept::size == 0, NoMemory, BlockMemory<I::dim, V, typename Src::Kept>>;
    auto memory = [&]() __attribute__((always_inline))
    {
        if constexpr (Src::Kept::size == 0) return Memory{};
        else
            return Memory((*source.memory)[cell], block, std::size_t(lists.begin[block]),
                          std::size_t(lists.begin[block + 1]), source.carry);
    }
    ();
    A mine = sums; // a copy in registers: g++ would store sums to the stack with each pack
    for (auto at = std::size_t(lists.begin[block]) * std::size_t(width<V>); at != end; at += std::size_t(width<V>)) {
        ask_for_records<I, V, L>(base, lists.index, at);
        const auto rj = gathered<V>(base, index + at, L{});
        constexpr auto terms = std::make_index_sequence<std::tuple_size_v<Tuple>>{};
        if (!may_meet<I>(interaction, ri, ui, rj, uj)) {
            memory.skip();
            continue;
        }
        const auto ij = pair_of<I, V>(interaction, ri, ui, rj, uj);
        if constexpr (requires { ij.mask; })
            if (!spate::any(ij.mask)) { // qualified: xsimd has one too
                memory.skip();
                continue;
            }
        if constexpr (Src::Kept::size == 0) apply_all<Src::terms>(all, ri, ui, rj, uj, mine, ij, terms);
        else {
            auto kept = memory.load();
            apply_all<Src::terms>(all, ri, ui, rj, uj, mine, ij, terms, &kept.record);
            if constexpr (requires { ij.mask; }) memory.store(kept, bits(ij.mask));
            else memory.store(kept, (1u << width<V>)-1);
        }
    }
    memory.finish();
    sums = mine;
}
/// What pairs read of both sides, and the records of a species hold.
template <class I, class Src, class... T, std::size_t... t>
constexpr auto read_of_records(std::tuple<T...> const*, std::index_sequence<t...>)
{
    auto one = []<std::size_t k, class X>(std::integral_constant<std::size_t, k>, X const*) {
        if constexpr (picked<Src::terms, k>) return reads_j<X>();
        else return Fields<>{};
    };
    return (I::reads | ... | one(std::integral_constant<std::size_t, t>{}, static_cast<T const*>(nullptr))) &
           Src::L::fields;
}
/// Targets that lie one after the other. What their records hold of them is taken from there, where the species meets
/// itself: neighbours bring these into the cache.
template <class V, class I, class Tuple, class Target, class P, class Src, class... More>
[[gnu::always_inline]] inline auto targets_at(P const& particles, std::int32_t first, Src const& source, More const&...)
{
    using Recorded = Set<read_of_records<I, Src>(static_cast<Tuple const*>(nullptr),
                                                 std::make_index_sequence<std::tuple_size_v<Tuple>>{}) &
                         Target{}>;
    if constexpr (!Src::itself || !std::same_as<scalar_t<V>, typename P::real> || Recorded::size < 2)
        return particles.template record_at<V>(Target{}, first);
    else {
        using L = typename Src::L;
        const auto last = std::int32_t(particles.size() - 1);
        std::int32_t at[std::size_t(width<V>)]; // lanes beyond the last are not stored
        for (int l = 0; l < width<V>; ++l) at[l] = std::min(first + l, last) * L::stride;
        const auto record = gathered<V>(source.packed.data.data(), at, L{});
        Record<P::dim, V, Target> r;
        for_each(
            Target{}, [&]<class F>(F f) __attribute__((always_inline)) {
                if constexpr (Recorded::template contains<F>) r[f] = record[f];
                else r[f] = particles.template load_at<V>(f, std::size_t(first));
            });
        return r;
    }
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
/// Whether any of the picked terms is such.
template <Mask terms, class... T, std::size_t... t>
constexpr bool acts_without_pairs(std::tuple<T...> const*, std::index_sequence<t...>)
{
    return (false || ... || (picked<terms, t> && (!PairTerm<T> || has_self<T>)));
}
/// Whether a sweep first looks who touches: most rows of short lists have no pair that does, and which have one is what a
/// processor cannot foresee.
template <class I, class... Src>
inline constexpr bool looks_first = false;
template <class I, class Src>
requires(Src::itself&& Src::Kept::size == 0) inline constexpr bool looks_first<I, Src> =
    short_lists<I> && requires(I const& interaction, Record<I::dim, double, Set<I::reads>> const& i)
{
    interaction.touch(i, i);
};
/// All pairs of the first blocks of a cell, which lie in order: first which rows touch, without a branch, then those.
template <class V, Mask terms, class Sums, class Target, class I, class Tuple, class Ui, class P, class Src>
[[gnu::always_inline]] inline void over_touching(I const& interaction, Tuple const& all, Ui const& ui, P& particles,
                                                 std::int32_t first, std::size_t cell, std::size_t blocks,
                                                 bool passes_follow, Src const& source)
{
    using L = typename Src::L;
    struct Row {
        std::int32_t target, at; ///< first target of its block, place in the lists
    };
    static thread_local std::vector<Row> rows;
    constexpr auto each = std::make_index_sequence<std::tuple_size_v<Tuple>>{};
    constexpr std::int32_t W = width<V>, later = 16 * W;
    auto const& lists = source.lists.of_cell(cell);
    scalar_t<V> const* const base = source.packed.data.data();
    std::int32_t const* const index = lists.index.data();
    const auto uj = source.particles.template uniforms<V>();
    if (rows.size() <= std::size_t(lists.begin[blocks])) rows.resize(std::size_t(lists.begin[blocks]) + 1);
    Row* touching = rows.data(); // beyond the last
    auto targets = [&](std::int32_t i) __attribute__((always_inline))
    {
        return targets_at<V, I, Tuple, Target>(particles, i, source);
    };
    for (std::size_t block = 0; block < blocks; ++block) {
        const std::int32_t i = first + std::int32_t(block) * W;
        if (passes_follow) particles.ask_for(std::size_t(std::min(i + later, std::int32_t(particles.size()) - 1)));
        Record<P::dim, V, Sums> sums;
        clear(sums);
        for_each(
            Sums{}, [&](auto f)
                        __attribute__((always_inline)) { particles.template store_at<V>(f, std::size_t(i), sums[f]); });
        const auto ri = targets(i);
        for (std::int32_t at = lists.begin[block] * W; at != lists.begin[block + 1] * W; at += W) {
            ask_for_records<I, V, L>(base, lists.index, std::size_t(at));
            const auto rj = gathered<V>(base, index + at, L{});
            *touching = {i, at};
            touching += may_meet<I>(interaction, ri, ui, rj, uj);
        }
    }
    // Sums go through memory: two rows of a block may follow each other, or not.
    auto with_sums = [&](std::int32_t i, auto const& add) __attribute__((always_inline))
    {
        Record<P::dim, V, Sums> sums;
        for_each(
            Sums{}, [&](auto f)
                        __attribute__((always_inline)) { sums[f] = particles.template load_at<V>(f, std::size_t(i)); });
        add(targets(i), sums);
        for_each(
            Sums{}, [&](auto f)
                        __attribute__((always_inline)) { particles.template store_at<V>(f, std::size_t(i), sums[f]); });
    };
    for (Row const* row = rows.data(); row != touching; ++row)
        with_sums(
            row->target, [&](auto const& ri, auto& sums) __attribute__((always_inline)) {
                const auto rj = gathered<V>(base, index + row->at, L{});
                apply_all<Src::terms>(all, ri, ui, rj, uj, sums, pair_of<I, V>(interaction, ri, ui, rj, uj), each);
            });
    if constexpr (acts_without_pairs<terms>(static_cast<Tuple const*>(nullptr), each))
        for (std::size_t block = 0; block < blocks; ++block)
            with_sums(
                first + std::int32_t(block) * W, [&](auto const& ri, auto& sums) __attribute__((always_inline)) {
                    with_itself<terms, V>(interaction, all, ri, ui, sums, each);
                });
}
} // namespace detail

/// Runs the picked terms on all targets of one cell: the unit of work. Flattened: terms are inlined however large the
/// program; a call in the loop would send its sums through memory.
/// \tparam Sums     the fields that the terms add to
/// \tparam Target   the fields that they read of the target
/// \tparam V        what pairs compute with
/// \param passes_follow  over the same particles: their columns are asked for in time
template <class V, Mask terms, class Sums, class Target, class I, class Tuple, class P, class... Src>
[[gnu::flatten, gnu::noinline]] void sweep_cell(I const& of_scene, Tuple const& terms_of_scene, P& particles,
                                                Binning<P::dim> const& at, std::size_t cell, bool passes_follow,
                                                Src const&... source)
{
    const I interaction = of_scene; // copies in this frame: parameters become invariants in registers
    const Tuple all = terms_of_scene;
    const auto ui = particles.template uniforms<V>();
    const auto first = at.begin(cell);
    auto const& lists = std::get<0>(std::tie(source...)).lists.of_cell(cell);
    const std::size_t blocks = lists.begin.size() - 1;
    const int targets = at.end(cell) - first;
    constexpr std::int32_t later = 16 * width<V>; // targets, by when their columns are there
    auto run = [&]<bool in_order>(std::bool_constant<in_order>, std::size_t block, std::size_t end)
        __attribute__((always_inline))
    {
        for (; block < end; ++block) {
            std::int32_t const* target = nullptr;
            std::int32_t numbers[std::size_t(width<V>)];
            if constexpr (!in_order) {
                if (lists.in_order) { // a scene may ask for it
                    for (int l = 0; l < width<V>; ++l)
                        numbers[l] = lists.target_of(block * std::size_t(width<V>) + std::size_t(l));
                    target = numbers;
                }
                else target = lists.target.data() + block * std::size_t(width<V>);
            }
            const std::int32_t at_first = first + (in_order ? std::int32_t(block) * width<V> : 0);
            if constexpr (in_order)
                if (passes_follow)
                    particles.ask_for(std::size_t(std::min(at_first + later, std::int32_t(particles.size()) - 1)));
            const auto ri = [&]() __attribute__((always_inline))
            {
                if constexpr (in_order) return detail::targets_at<V, I, Tuple, Target>(particles, at_first, source...);
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
                    if constexpr (in_order) particles.template store_at<V>(f, std::size_t(at_first), sums[f]);
                    else particles.template store_of<V>(f, first, target, sums[f], lanes);
                });
        }
    };
    // A loop for whole blocks in order, where lists may be short: then what a block costs beside its pairs counts. Beside the
    // last targets are those of another task.
    std::size_t whole = 0;
    if constexpr (short_lists<I>)
        if (lists.in_order) {
            whole = std::size_t(targets / width<V>);
            if constexpr (detail::looks_first<I, Src...>)
                detail::over_touching<V, terms, Sums, Target>(interaction, all, ui, particles, first, cell, whole,
                                                              passes_follow, source...);
            else run(std::true_type{}, 0, whole);
        }
    run(std::false_type{}, whole, blocks);
}

} // namespace spate
