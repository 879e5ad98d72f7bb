// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A model: a physics within a boundary. From the terms' declarations follow the species, the fields of each,
/// what is packed, what evolves, and the plan of every evaluation: all of it types and constants.
#pragma once

#include "spate/physics/physics.hpp"
#include "spate/physics/plan.hpp"

namespace spate {

namespace detail {
template <class T>
inline constexpr bool reaches_marker = between<T>().source != Role::mobile;
template <class T>
constexpr auto marker_reads()
{
    if constexpr (PairTerm<T> && reaches_marker<T> && between<T>().target != Role::marker) return reads_j<T>();
    else return Fields<>{};
}
template <class T>
constexpr auto mobile_fields()
{
    constexpr Between b = between<T>();
    constexpr auto as_i = reads_i<T>() | writes<T>() | adds<T>();
    if constexpr (b.target == Role::marker && PairTerm<T>) return reads_j<T>();
    else if constexpr (b.target == Role::marker) return Fields<>{};
    else if constexpr (PairTerm<T>) return as_i | reads_j<T>();
    else return as_i;
}
/// The fields that the rates of a set advance.
template <class... F>
constexpr auto advanced_by(Fields<F...>)
{
    auto one = []<class G>(G) {
        if constexpr (std::is_void_v<typename G::rate_of>) return Fields<>{};
        else return Fields<typename G::rate_of>{};
    };
    return (Fields<>{} | ... | one(F{}));
}
template <class... F>
constexpr auto only_given(Fields<F...>)
{
    return (Fields<>{} | ... | kept<!F::derived>(F{}));
}
} // namespace detail

/// \tparam P  the physics    \tparam B  the boundary
/// A boundary without markers says `static constexpr bool markers = false`, and may bring `terms(physics)` that act on the
/// particles; one with markers names their `uniform`
/// fields, the `state` fields that they carry beside those that others read, and `terms(physics)`. It may show the
/// terms of the physics other than they are, `own(terms)`; name `moves`: its markers follow a law; and name `given`
/// fields of the markers that it sets itself, and no term of the physics.
template <class P, class B>
struct Model {
    static constexpr int dim = P::dim;
    static constexpr bool markers = B::markers;
    using Interaction = std::remove_cvref_t<decltype(std::declval<P>().interaction)>;

    static auto terms_of(P const& physics, B const& boundary)
    {
        if constexpr (requires { boundary.own(physics.terms); })
            return std::tuple_cat(boundary.own(physics.terms), boundary.terms(physics));
        else if constexpr (requires { boundary.terms(physics); })
            return std::tuple_cat(physics.terms, boundary.terms(physics));
        else return physics.terms;
    }
    using Terms = decltype(terms_of(std::declval<P>(), std::declval<B>()));
    /// Markers follow a law: their positions and velocities evolve.
    static constexpr bool moves = []() {
        if constexpr (requires { B::moves; }) return bool(B::moves);
        else return false;
    }();
    static constexpr auto given_by_boundary = []() {
        if constexpr (requires { B::given; }) return B::given;
        else return Fields<>{};
    }();
    /// Some markers belong to bodies that move by `forces`, fields of the markers.
    static constexpr bool floats = []() {
        if constexpr (requires { B::floats; }) return bool(B::floats);
        else return false;
    }();
    static constexpr int own_terms = int(std::tuple_size_v<typename P::Terms>);
    static constexpr int terms = int(std::tuple_size_v<Terms>);
    static constexpr int species = markers ? 2 : 1;

    /// Fields to which walls of contact add.
    static constexpr auto wall_adds = []<class... T>(std::tuple<T...> const*) {
        auto one = []<class X>(X const*) {
            if constexpr (requires { X::pushes; }) return adds<X>();
            else return Fields<>{};
        };
        return (Fields<>{} | ... | one(static_cast<T const*>(nullptr)));
    }(static_cast<Terms const*>(nullptr));

private:
    template <class F>
    static constexpr auto over_terms(F f)
    {
        return [&]<class... T>(std::tuple<T...> const*) {
            return (Fields<>{} | ... | f.template operator()<T>());
        }(static_cast<Terms const*>(nullptr));
    }
    static constexpr auto touched = over_terms([]<class T>() { return detail::mobile_fields<T>(); });
    static constexpr auto marker_side() // fields of the markers, uniform ones too
    {
        if constexpr (markers) {
            constexpr auto own = over_terms([]<class T>() {
                if constexpr (between<T>().target == Role::marker) return reads_i<T>() | writes<T>() | adds<T>();
                else return Fields<>{};
            });
            return Fields{position} | Interaction::reads |
                   over_terms([]<class T>() { return detail::marker_reads<T>(); }) | B::state | own;
        }
        else return Fields<>{};
    }
    static constexpr auto marker_uniform()
    {
        if constexpr (markers) return marker_side() & B::uniform;
        else return Fields<>{};
    }

public:
    /// Fields by species: 0 the mobile particles, 1 the markers of the boundary.
    static constexpr auto mobile = (Fields{position, velocity} | Interaction::reads | touched |
                                    detail::advanced_by(touched) | Fields{build_position}) -
                                   P::uniform;
    static constexpr auto marker = marker_side() - marker_uniform();
    template <int s>
    static constexpr auto stored()
    {
        if constexpr (s == 0) return mobile;
        else return marker;
    }
    template <int s>
    static constexpr auto uniform()
    {
        if constexpr (s == 0) return P::uniform;
        else return marker_uniform();
    }
    /// Every field of the scene: bit k of a mask is field k.
    static constexpr auto universe = mobile | P::uniform | marker | marker_uniform();
    static_assert(Set<universe>::size <= 64, "spate: a scene has at most 64 fields");

    template <class... G>
    static constexpr Mask mask(Fields<G...>)
    {
        Mask m = 0, bit = 1;
        for_each(universe, [&](auto f) {
            if (Fields<G...>::template contains<decltype(f)>) m |= bit;
            bit <<= 1;
        });
        return m;
    }
    /// The set that a mask stands for.
    template <Mask m>
    static constexpr auto fields()
    {
        return []<class... F, std::size_t... k>(Fields<F...>, std::index_sequence<k...>) {
            return (Fields<>{} | ... | detail::kept<((m >> k) & 1) != 0>(F{}));
        }(universe, std::make_index_sequence<Set<universe>::size>{});
    }

private:
    static constexpr Mask marker_made() // by the boundary's own terms: the physics' terms leave these fields alone
    {
        return []<class... T>(std::tuple<T...> const*) {
            int k = 0;
            Mask m = mask(given_by_boundary);
            ((m |= k++ < own_terms || between<T>().target == Role::mobile ? Mask(0) : mask(writes<T>() | adds<T>())),
             ...);
            return m;
        }(static_cast<Terms const*>(nullptr));
    }
    template <class T>
    static constexpr TermFacts facts(int k)
    {
        constexpr Between b = between<T>();
        TermFacts f;
        f.pair = PairTerm<T>;
        f.reads_i = mask(reads_i<T>());
        f.reads_j = f.pair ? mask(reads_j<T>()) : 0;
        if (has_self<T>) f.reads_i |= f.reads_j; // the target is its own source
        if (f.pair) f.reads_i |= mask(Interaction::reads), f.reads_j |= mask(Interaction::reads);
        f.writes = mask(writes<T>());
        f.adds = mask(adds<T>());
        f.when = spate::when<T>();
        const Mask changes = f.writes | f.adds;
        if (b.target != Role::marker && (changes & ~mask(mobile)) == 0) f.targets |= 1;
        if (markers && b.target != Role::mobile && (changes & ~mask(marker)) == 0 &&
            (k >= own_terms || (changes & marker_made()) == 0) && (k >= own_terms || reads_on_marker<T>()))
            f.targets |= 2;
        if (b.source != Role::marker) f.sources |= 1;
        if (markers && b.source != Role::mobile) f.sources |= 2;
        return f;
    }
    /// A term of the physics runs on markers only if they carry what it reads of its target.
    template <class T>
    static constexpr bool reads_on_marker()
    {
        return (mask(reads_i<T>()) & ~mask(marker | marker_uniform())) == 0;
    }
    static constexpr auto make_planner()
    {
        Planner<terms, species> p;
        [&]<class... T>(std::tuple<T...> const*) {
            int k = 0;
            ((p.term[std::size_t(k)] = facts<T>(k), ++k), ...);
        }(static_cast<Terms const*>(nullptr));
        p.species[0] = {mask(mobile), mask(P::uniform), mask(detail::only_given(mobile | P::uniform)), false};
        if constexpr (species == 2)
            p.species[1] = {mask(marker), mask(marker_uniform()),
                            mask(detail::only_given(marker | marker_uniform()) | (marker & given_by_boundary)), true};
        p.interaction = mask(Interaction::reads);
        return p;
    }

public:
    static constexpr auto planner = make_planner();
    static_assert(planner.open_term() < 0,
                  "spate: a term reads a field that nothing provides; add the term that writes it to the model (for "
                  "pressure: an equation of state such as Tait)");

    /// Whether any term runs in a phase.
    template <When w>
    static constexpr bool has_phase = [] {
        bool any = false;
        for (auto const& facts : planner.term) any = any || facts.when == w;
        return any;
    }();
    /// Fields of species s that some term makes in an evaluation.
    template <int s>
    static constexpr Mask made = planner.made(s, When::evaluation);
    /// Fields of species s that evolve: their rate is stored here, and made by a term or evolving itself.
    template <int s>
    static constexpr auto evolving()
    {
        if constexpr (s == 1 && !moves) return spate::evolving(stored<s>()) - Fields{position};
        else return spate::evolving(stored<s>());
    }
    /// What a checkpoint holds of species s: all but what each evaluation makes anew before it is read. Rates of kicks and
    /// of positions last: the next step and its lists are chosen by those of the one before, and Leapfrog begins with them.
    template <int s>
    static constexpr auto lasting()
    {
        constexpr auto rates = []<class... F>(Fields<F...>) {
            return (Fields<>{} | ... | rate_in<F>(stored<s>()));
        }(spate::of_kind<Kind::kick>(evolving<s>()) | (evolving<s>() & Fields{position}));
        constexpr Mask anew = made<s> & ~mask(detail::only_given(stored<s>()) | rates | given_by_boundary);
        return fields<mask(stored<s>()) & ~anew>();
    }
    /// State of species s that no rate advances: what a term makes of what it was before, as what is kept at walls.
    template <int s>
    static constexpr auto remembered()
    {
        constexpr Mask changed = [] {
            Mask m = 0;
            for (auto const& term : planner.term)
                if (term.when == When::evaluation && !term.pair) m |= term.reads_i & term.writes;
            return m;
        }();
        return fields<changed & mask(lasting<s>()) & ~mask(evolving<s>())>();
    }
    /// What a record of species s as a source holds.
    template <int s>
    static constexpr auto record()
    {
        return fields<planner.record(s)>();
    }
    /// The plan that produces the rates of the asked fields in every species.
    template <class Asked>
    static constexpr auto rates_plan()
    {
        std::array<Mask, std::size_t(species)> wanted{};
        wanted[0] = rates_of<0>(Asked{});
        if constexpr (species == 2) wanted[1] = rates_of<1>(Asked{});
        if constexpr (floats && Asked::template contains<Velocity>) wanted[1] |= mask(B::forces);
        return planner.plan(wanted);
    }
    /// The plan that brings what terms derive (pressure, ..., sums that are no rate) up to date.
    static constexpr auto refresh_plan()
    {
        std::array<Mask, std::size_t(species)> wanted{};
        wanted[0] = made<0> & ~rates_of<0>(evolving<0>());
        if constexpr (species == 2) wanted[1] = made<1> & ~rates_of<1>(evolving<1>());
        return planner.plan(wanted);
    }
    /// The plan of term k of a phase.
    template <When w, int k>
    static constexpr auto phase_plan()
    {
        return planner.plan_of(k, w);
    }

private:
    template <int s, class... F>
    static constexpr Mask rates_of(Fields<F...>)
    {
        Mask m = 0;
        [[maybe_unused]] auto one = [&]<class G>(G) {
            if constexpr (Set<stored<s>()>::template contains<G>) m |= mask(rate_in<G>(stored<s>()));
        };
        (one(F{}), ...);
        return m & made<s>;
    }
};

} // namespace spate
