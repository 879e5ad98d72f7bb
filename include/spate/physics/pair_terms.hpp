// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The fused pair terms on one pack of pairs: what each may see of target, source and pair.
#pragma once

#include "spate/core/term.hpp"
#include "spate/physics/plan.hpp"

#include <tuple>

namespace spate {

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
/// One particle as the interaction sees it.
template <class I, class R, class U>
[[gnu::always_inline]] inline auto seen_by(R const& r, U const& u)
{
    using S = std::remove_cv_t<decltype(I::reads)>;
    using View = spate::View<S, Fields<>, R, U, void>;
    if constexpr (R::template has<PositionTail>) return SplitView<S, R, U>{View{r, u, nullptr, {}}};
    else return View{r, u, nullptr, {}};
}
template <class I, class V, class Ri, class Ui, class Rj, class Uj>
[[gnu::always_inline]] inline auto pair_of(I const& interaction, Ri const& ri, Ui const& ui, Rj const& rj, Uj const& uj)
{
    return interaction.template pair<V>(seen_by<I>(ri, ui), seen_by<I>(rj, uj));
}
} // namespace detail

} // namespace spate
