// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The fused pair terms of a scene with all their data in the first-level cache: on packs that lie ready, and on
/// records that lists point at, folded into a small set. What the arithmetic alone costs.
#pragma once

#include <random>

#include "least.hpp"
#include "stages.hpp"

namespace bench {

/// Terms of target s <- source q of a physics within a boundary. Every pair is within range.
template <class P, class B, class Precision, int s = 0, int q = 0>
class FromL1 {
public:
    static constexpr int targets = 64, neighbours = 40, records = 256;
    static constexpr double pairs = targets * neighbours;

    /// \param m  mass of a particle where the physics leaves it open [kg]
    FromL1(P const& physics, B const& boundary, double m)
        : interaction_(physics.interaction), terms_(M::terms_of(physics, boundary))
    {
        give_uniforms(physics, m, mine_);
        give_uniforms(physics, m, theirs_);
        for (auto& place : list_.index) place = std::int32_t(random_() % records) * L::stride;
        for (std::size_t b = 0; b < list_.begin.size(); ++b) list_.begin[b] = std::int32_t(b) * neighbours;
        for_each(Target{}, [&](auto f) {
            for (auto& column : target_.column(f))
                for (auto& y : column) y = value_of(f, 0.1);
        });
        fill(record_.data, records, 1);
        fill(pack_, neighbours * width<V>, width<V>);
    }
    /// On packs that lie side by side, one a field: no list, no transposition.
    [[gnu::noinline, gnu::flatten]] void on_packs()
    {
        sweep([&](auto const& interaction, auto const& all, auto const& ri, auto const& ui, auto& sums, std::size_t)
                  __attribute__((always_inline)) {
                      const auto uj = theirs_.template uniforms<V>();
                      T const* base = pack_.data();
                      for (int k = 0; k < neighbours; ++k, base += L::stride * width<V>) {
                          const auto rj = lying(base, Records{});
                          const auto ij = detail::pair_of<I, V>(interaction, ri, ui, rj, uj);
                          detail::apply_all<terms>(all, ri, ui, rj, uj, sums, ij,
                                                   std::make_index_sequence<std::size_t(M::terms)>{});
                      }
                  });
    }
    /// On records that lists point at: the engine's own loop.
    [[gnu::noinline, gnu::flatten]] void on_records()
    {
        const Folded source{theirs_, {list_}, record_};
        sweep([&](auto const& interaction, auto const& all, auto const& ri, auto const& ui, auto& sums, std::size_t b)
                  __attribute__((always_inline)) { detail::over<V>(interaction, all, ri, ui, sums, source, 0, b); });
    }

private:
    using M = Model<P, B>;
    using V = typename Precision::value;
    using T = typename Precision::real;
    using I = typename M::Interaction;
    using Records = Set<M::template record<q>()>;
    using L = Layout<M::dim, Records>;
    static constexpr Mask terms = Sweeps<M>::terms(s, q);
    using Sums = decltype(M::template fields<Sweeps<M>::added(terms)>());
    using Target = decltype(M::template fields<Sweeps<M>::read_of_target(terms, s)>());
    template <int k>
    using Uniforms = Particles<M::dim, T, Fields<>, Set<M::template uniform<k>()>>;

    struct Folded {
        using Kept = Fields<>; // for terms that keep nothing of a pair
        using L = FromL1::L;
        static constexpr Mask terms = FromL1::terms;
        struct One {
            CellLists const& list;
            [[nodiscard]] CellLists const& of_cell(std::size_t) const { return list; }
        };
        Uniforms<q> const& particles;
        One lists;
        Packed<M::dim, T, Records> const& packed;
    };

    template <class U>
    static void give_uniforms(P const& physics, double m, U& to)
    {
        for_each(U::uniform, [&](auto f) {
            if constexpr (std::same_as<decltype(f), Mass>) to.value(f) = m;
            else if constexpr (Set<P::uniform>::template contains<decltype(f)>) to.value(f) = physics.uniforms[f];
        });
    }
    [[gnu::always_inline]] void sweep(auto const& neighbours_of)
    {
        const I interaction = interaction_; // copies in this frame, as in the engine's sweep
        const typename M::Terms all = terms_;
        const auto ui = mine_.template uniforms<V>();
        for (int block = 0; block < targets / width<V>; ++block) {
            const auto ri = target_.template record_at<V>(Target{}, block * width<V>);
            Record<M::dim, V, Sums> sums;
            clear(sums);
            neighbours_of(interaction, all, ri, ui, sums, std::size_t(block));
            for_each(
                Sums{}, [&](auto f) __attribute__((always_inline)) {
                    out_.template store_at<V>(f, std::size_t(block * width<V>), sums[f]);
                });
        }
        benchmark::ClobberMemory();
    }
    template <class... F>
    [[gnu::always_inline]] static auto lying(T const* base, Fields<F...>)
    {
        Record<M::dim, V, Fields<F...>> r;
        auto one = [&]<class G>(G g) __attribute__((always_inline))
        {
            if constexpr (G::rank == 0) r[g] = load<V>(base + L::template offset<G> * width<V>);
            else
                for (int c = 0; c < M::dim; ++c) r[g][c] = load<V>(base + (L::template offset<G> + c) * width<V>);
        };
        (one(F{}), ...);
        return r;
    }
    /// `count` records, `lanes` of them transposed together.
    void fill(Array<T>& data, int count, int lanes)
    {
        data.assign(std::size_t(count * L::stride), T(0));
        for (std::size_t at = 0; at < data.size(); at += std::size_t(L::stride * lanes))
            for_each(Records{}, [&]<class F>(F f) {
                for (int c = 0; c < components<F, M::dim> * lanes; ++c)
                    data[at + std::size_t(L::template offset<F> * lanes + c)] = value_of(f, 0.4);
            });
    }
    /// Targets within 0.1, sources within 0.4 of the range from the origin along each axis: nearer than 0.87 of it.
    template <class F>
    T value_of(F, double spread)
    {
        const double any = std::uniform_real_distribution<double>(-1, 1)(random_);
        if constexpr (std::same_as<F, Position>) return T(any * spread * interaction_.range());
        else if constexpr (std::same_as<F, Density>) return T(1000 * (1 + 0.01 * any));
        else if constexpr (std::same_as<F, Pressure>) return T(1000 * any);
        else return T(any);
    }
    template <class F>
    static auto room(F)
    {
        Particles<M::dim, T, F, Fields<>> p;
        p.resize(targets);
        return p;
    }

    I interaction_;
    typename M::Terms terms_;
    std::mt19937_64 random_{1};
    Uniforms<s> mine_;
    Uniforms<q> theirs_;
    Particles<M::dim, T, Target, Fields<>> target_ = room(Target{});
    Particles<M::dim, T, Sums, Fields<>> out_ = room(Sums{});
    CellLists list_ = [] {
        CellLists l;
        l.begin.resize(std::size_t(targets / width<V> + 1));
        l.index.resize(std::size_t(targets * neighbours));
        return l;
    }();
    Packed<M::dim, T, Records> record_;
    Array<T> pack_;
};

} // namespace bench
