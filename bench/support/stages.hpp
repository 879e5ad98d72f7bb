// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The stages of an evaluation, each by itself: the engine's own functions, called for one scene.
#pragma once

#include <spate/physics/system.hpp>

namespace bench {

using namespace spate;

/// What a sweep of a model over target s <- source q is: its terms, and the fields that they touch.
template <class M>
struct Sweeps {
    static constexpr Mask terms(int s, int q) ///< pair terms on s that read q
    {
        Mask m = 0;
        for (int t = 0; t < M::terms; ++t)
            if (M::planner.on(t, s) && M::planner.from(t, s, q)) m |= Mask(1) << t;
        return m;
    }
    static constexpr Mask added(Mask of)
    {
        Mask m = 0;
        for (int t = 0; t < M::terms; ++t)
            if (((of >> t) & 1) != 0) m |= M::planner.term[std::size_t(t)].adds;
        return m;
    }
    static constexpr Mask read_of_target(Mask of, int s)
    {
        Mask m = M::planner.interaction;
        for (int t = 0; t < M::terms; ++t)
            if (((of >> t) & 1) != 0) m |= M::planner.term[std::size_t(t)].reads_i;
        return m & ~M::planner.species[std::size_t(s)].uniform;
    }
};

/// The sweeps of one evaluation of all rates, without the passes and the packing between them: records, lists and what
/// terms read are those of the last evaluation. For terms that keep nothing of a pair.
template <class System>
class SweepsOf {
public:
    explicit SweepsOf(System& s) : s_(s) {}
    void run()
    {
        [&]<std::size_t... k>(std::index_sequence<k...>) { (stage<plan.stage[k]>(), ...); }
        (std::make_index_sequence<std::size_t(plan.count)>{});
    }

private:
    using M = typename System::M;
    using V = typename System::PairV;
    static constexpr auto plan = M::template rates_plan<std::remove_cvref_t<decltype(System::all)>>();

    template <Stage st>
    void stage()
    {
        if constexpr (st.action == Action::sweep) {
            constexpr int s = st.species;
            constexpr Mask from_0 = st.terms & Sweeps<M>::terms(s, 0);
            constexpr Mask from_1 = System::species_count == 2 ? st.terms & Sweeps<M>::terms(s, 1) : 0;
            if constexpr (from_0 != 0 && from_1 != 0)
                cells<s, st.terms>(source<s, 0, from_0>(), source<s, 1, from_1>());
            else if constexpr (from_0 != 0) cells<s, st.terms>(source<s, 0, from_0>());
            else cells<s, st.terms>(source<s, 1, from_1>());
        }
    }
    template <int s, int q, Mask terms>
    auto source()
    {
        auto const& x = s_.template species<q>();
        using P = std::remove_cvref_t<decltype(x.particles)>;
        using R = std::remove_cvref_t<decltype(x.packed)>;
        return Source<terms, Fields<>, P, R>{x.particles, x.packed, s_.template lists<s, q>(), s == q, nullptr, {}};
    }
    template <int s, Mask terms>
    void cells(auto const&... source)
    {
        auto& x = s_.template species<s>();
        using Sums = decltype(M::template fields<Sweeps<M>::added(terms)>());
        using Target = Set<System::in_pairs(M::template fields<Sweeps<M>::read_of_target(terms, s)>())>;
        for (std::size_t cell = 0; cell < x.bins.cells(); ++cell)
            sweep_cell<V, terms, Sums, Target>(s_.physics().interaction, s_.terms(), x.particles, x.bins, cell, false,
                                               source...);
    }

    System& s_;
};

/// Builds the lists of the mobile particles among themselves anew, from their present bins.
template <class System>
void build_lists(System const& s, Lists<System::dim>& lists)
{
    auto const& x = s.template species<0>();
    using Of = Lists<System::dim>;
    using T = typename System::T;
    constexpr int record = std::remove_cvref_t<decltype(x.packed)>::L::stride;
    const auto places = Places<System::dim, T>::of(x.particles);
    const std::array from{typename Of::template From<T>{lists, places, x.bins, record, true}};
    Of::template build<T>({0, places, x.bins, x.particles.id()}, s.grid(), width<typename System::PairV>,
                          s.neighbours(), s.physics().interaction.range(), s.template skins<0>(), s.backend(), from);
}

/// Entries of all lists, sentinels too.
template <class System>
double slots(System const& s)
{
    double n = double(s.template lists<0, 0>().slots());
    if constexpr (System::species_count == 2)
        n += double(s.template lists<0, 1>().slots()) + double(s.template lists<1, 0>().slots());
    return n;
}

} // namespace bench
