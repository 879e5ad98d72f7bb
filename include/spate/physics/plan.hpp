// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief From what terms say they read and change to the order in which they run: passes over particles, packing of
/// records, sweeps over neighbours. Pure arithmetic on sets as bit masks, done by the compiler.
#pragma once

#include "spate/core/term.hpp"

#include <array>
#include <cstdint>

namespace spate {

/// A set of fields of one scene, or of its terms: one bit each.
using Mask = std::uint64_t;

/// What the plan knows of a term.
struct TermFacts {
    bool pair = false;
    Mask reads_i = 0, reads_j = 0, writes = 0, adds = 0;
    Mask targets = 0; ///< species on which it runs
    Mask sources = 0; ///< species that it reads as j
    When when = When::evaluation;
};
/// What the plan knows of a species.
struct SpeciesFacts {
    Mask stored = 0, uniform = 0;
    Mask given = 0; ///< stored or uniform, and there without any term
    bool marker = false;
};

enum class Action { pass, pack, sweep };
struct Stage {
    Action action = Action::pass;
    int species = 0;
    Mask terms = 0;  ///< pass, sweep: the terms that run
    Mask fields = 0; ///< pack: the fields to copy; pass: the fields to clear first
};

template <int Terms, int Species>
struct Plan {
    static constexpr int capacity = 4 * (Terms + 1) * (Species + 1);
    std::array<Stage, std::size_t(capacity)> stage{};
    int count = 0;
    bool complete = true; ///< every needed term runs; false: terms wait for each other's fields
    constexpr void add(Stage s) { stage[std::size_t(count++)] = s; }
    [[nodiscard]] constexpr int sweeps() const
    {
        int n = 0;
        for (int k = 0; k < count; ++k) n += stage[std::size_t(k)].action == Action::sweep;
        return n;
    }
};

template <int Terms, int Species>
struct Planner {
    std::array<TermFacts, std::size_t(Terms)> term;
    std::array<SpeciesFacts, std::size_t(Species)> species;
    Mask interaction = 0; ///< fields that the interaction reads of both sides

    static constexpr Mask bit(int k) { return Mask(1) << k; }
    [[nodiscard]] constexpr bool on(int t, int s) const { return (term[std::size_t(t)].targets & bit(s)) != 0; }
    [[nodiscard]] constexpr bool from(int t, int s, int q) const
    {
        return term[std::size_t(t)].pair && (term[std::size_t(t)].sources & bit(q)) != 0 &&
               !(species[std::size_t(s)].marker && species[std::size_t(q)].marker);
    }
    [[nodiscard]] constexpr Mask made(int s, When w) const
    {
        Mask m = 0;
        for (int t = 0; t < Terms; ++t)
            if (on(t, s) && term[std::size_t(t)].when == w)
                m |= term[std::size_t(t)].writes | term[std::size_t(t)].adds;
        return m;
    }

    /// The first term that reads a field that nothing provides, -1: the model is closed.
    [[nodiscard]] constexpr int open_term() const
    {
        for (int t = 0; t < Terms; ++t)
            for (int s = 0; s < Species; ++s) {
                if (!on(t, s)) continue;
                const auto& f = term[std::size_t(t)];
                Mask there = species[std::size_t(s)].given | made(s, When::evaluation) | made(s, f.when);
                if ((f.reads_i & ~there) != 0) return t;
                for (int q = 0; q < Species; ++q)
                    if (from(t, s, q) && (f.reads_j & ~(species[std::size_t(q)].given | made(q, When::evaluation) |
                                                        made(q, f.when))) != 0)
                        return t;
            }
        return -1;
    }

    /// Terms of evaluations and of phase w, for each species, that are needed to produce the wanted fields of each.
    [[nodiscard]] constexpr std::array<Mask, std::size_t(Species)> needed(std::array<Mask, std::size_t(Species)> wanted,
                                                                          When w) const
    {
        std::array<Mask, std::size_t(Species)> terms{};
        for (bool more = true; more;) {
            more = false;
            for (int t = 0; t < Terms; ++t)
                for (int s = 0; s < Species; ++s) {
                    const auto& f = term[std::size_t(t)];
                    auto& mine = terms[std::size_t(s)];
                    if (!on(t, s) || (f.when != w && f.when != When::evaluation) || (mine & bit(t)) != 0) continue;
                    if ((makes(t, s) & wanted[std::size_t(s)]) == 0) continue;
                    mine |= bit(t);
                    more = true;
                    wanted[std::size_t(s)] |= f.reads_i;
                    for (int q = 0; q < Species; ++q)
                        if (from(t, s, q)) wanted[std::size_t(q)] |= f.reads_j;
                }
        }
        return terms;
    }

    /// The stages that produce the wanted fields of each species.
    [[nodiscard]] constexpr Plan<Terms, Species> plan(std::array<Mask, std::size_t(Species)> const& wanted,
                                                      When w = When::evaluation) const
    {
        return ordered(needed(wanted, w));
    }
    /// What a term makes for others on species s: a term of a phase changes the state in its own turn, and only its own.
    [[nodiscard]] constexpr Mask makes(int t, int s) const
    {
        const auto& f = term[std::size_t(t)];
        return (f.writes | f.adds) & (f.when == When::evaluation ? ~Mask(0) : ~species[std::size_t(s)].given);
    }
    /// The stages that bring a term of a phase what it reads of the state before it, and run it.
    [[nodiscard]] constexpr Plan<Terms, Species> plan_of(int t, When w) const
    {
        std::array<Mask, std::size_t(Species)> read{};
        for (int s = 0; s < Species; ++s) {
            if (!on(t, s)) continue;
            read[std::size_t(s)] |= term[std::size_t(t)].reads_i & ~term[std::size_t(t)].writes;
            for (int q = 0; q < Species; ++q)
                if (from(t, s, q)) read[std::size_t(q)] |= term[std::size_t(t)].reads_j;
        }
        auto terms = needed(read, w);
        for (int s = 0; s < Species; ++s)
            if (on(t, s)) terms[std::size_t(s)] |= bit(t);
        return ordered(terms);
    }

private:
    using Masks = std::array<Mask, std::size_t(Species)>;

    [[nodiscard]] constexpr Plan<Terms, Species> ordered(Masks pending) const
    {
        Plan<Terms, Species> p;
        Masks there{}, fresh{};
        for (int s = 0; s < Species; ++s) {
            there[std::size_t(s)] = species[std::size_t(s)].given;
            for (int t = 0; t < Terms; ++t) // a field is there when the last term that makes it has run
                if ((pending[std::size_t(s)] & bit(t)) != 0) there[std::size_t(s)] &= ~makes(t, s);
        }
        for (bool more = true; more;) more = passes(p, pending, there, fresh) || sweeps(p, pending, there, fresh);
        for (Mask left : pending) p.complete = p.complete && left == 0;
        return p;
    }

    [[nodiscard]] constexpr bool ready(int t, int s, Masks const& there) const
    {
        const auto& f = term[std::size_t(t)];
        const Mask own = f.pair ? 0 : f.writes & species[std::size_t(s)].given; // it may change what it reads
        if ((f.reads_i & ~(there[std::size_t(s)] | own)) != 0) return false;
        for (int q = 0; q < Species; ++q)
            if (from(t, s, q) && (f.reads_j & ~there[std::size_t(q)]) != 0) return false;
        return true;
    }
    /// All pending terms on s that add to a field that t adds to, t too.
    [[nodiscard]] constexpr Mask companions(int t, int s, Masks const& pending) const
    {
        Mask fields = term[std::size_t(t)].adds, terms = bit(t);
        for (bool more = true; more;) {
            more = false;
            for (int u = 0; u < Terms; ++u)
                if ((pending[std::size_t(s)] & bit(u) & ~terms) != 0 && (term[std::size_t(u)].adds & fields) != 0)
                    terms |= bit(u), fields |= term[std::size_t(u)].adds, more = true;
        }
        return terms;
    }
    [[nodiscard]] constexpr bool any_pair(Mask terms) const
    {
        for (int t = 0; t < Terms; ++t)
            if ((terms & bit(t)) != 0 && term[std::size_t(t)].pair) return true;
        return false;
    }
    [[nodiscard]] constexpr bool all_ready(Mask terms, int s, Masks const& there) const
    {
        for (int t = 0; t < Terms; ++t)
            if ((terms & bit(t)) != 0 && !ready(t, s, there)) return false;
        return true;
    }
    constexpr void finish(Mask terms, int s, Masks& pending, Masks& there, Masks& fresh) const
    {
        Mask done = 0, left = 0;
        pending[std::size_t(s)] &= ~terms;
        for (int t = 0; t < Terms; ++t) {
            if ((terms & bit(t)) != 0) done |= term[std::size_t(t)].writes | term[std::size_t(t)].adds;
            if ((pending[std::size_t(s)] & bit(t)) != 0) left |= makes(t, s);
        }
        there[std::size_t(s)] |= done & ~left;
        fresh[std::size_t(s)] &= ~done;
    }
    /// Particle terms that can run now and whose fields no sweep adds to.
    constexpr bool passes(Plan<Terms, Species>& p, Masks& pending, Masks& there, Masks& fresh) const
    {
        for (int s = 0; s < Species; ++s)
            for (int t = 0; t < Terms; ++t) {
                if ((pending[std::size_t(s)] & bit(t)) == 0 || term[std::size_t(t)].pair) continue;
                const Mask together = companions(t, s, pending);
                if (any_pair(together) || !all_ready(together, s, there)) continue;
                Mask cleared = 0;
                for (int u = 0; u < Terms; ++u)
                    if ((together & bit(u)) != 0) cleared |= term[std::size_t(u)].adds;
                p.add({Action::pass, s, together, cleared});
                finish(together, s, pending, there, fresh);
                return true;
            }
        return false;
    }
    /// One sweep: on a species all of whose pending terms are ready, else what can run on the first.
    constexpr bool sweeps(Plan<Terms, Species>& p, Masks& pending, Masks& there, Masks& fresh) const
    {
        for (bool whole : {true, false})
            for (int s = Species - 1; s >= 0; --s) {
                Mask terms = 0;
                bool all = true;
                for (int t = 0; t < Terms; ++t) {
                    if ((pending[std::size_t(s)] & bit(t)) == 0) continue;
                    const Mask together = companions(t, s, pending);
                    if (!any_pair(together)) continue;
                    if (all_ready(together, s, there)) terms |= together;
                    else all = false;
                }
                if (terms == 0 || (whole && !all)) continue;
                pack(p, terms, s, there, fresh);
                p.add({Action::sweep, s, terms, 0});
                finish(terms, s, pending, there, fresh);
                return true;
            }
        return false;
    }
    constexpr void pack(Plan<Terms, Species>& p, Mask terms, int s, Masks const& there, Masks& fresh) const
    {
        for (int q = 0; q < Species; ++q) {
            Mask need = 0;
            for (int t = 0; t < Terms; ++t)
                if ((terms & bit(t)) != 0 && from(t, s, q)) need |= term[std::size_t(t)].reads_j | interaction;
            need &= ~species[std::size_t(q)].uniform;
            if ((need & ~fresh[std::size_t(q)]) == 0) continue;
            const Mask fields = there[std::size_t(q)] & record(q);
            p.add({Action::pack, q, 0, fields});
            fresh[std::size_t(q)] |= fields;
        }
    }

public:
    /// What is packed of a species as a source: all that any term reads of it as j.
    [[nodiscard]] constexpr Mask record(int q) const
    {
        Mask m = 0;
        for (int t = 0; t < Terms; ++t)
            for (int s = 0; s < Species; ++s)
                if (on(t, s) && from(t, s, q)) m |= term[std::size_t(t)].reads_j | interaction;
        return m & ~species[std::size_t(q)].uniform;
    }
    /// Whether any term on s reads q as a source: only then are lists kept for the pair of species.
    [[nodiscard]] constexpr bool meet(int s, int q) const
    {
        for (int t = 0; t < Terms; ++t)
            if (on(t, s) && from(t, s, q)) return true;
        return false;
    }
};

} // namespace spate
