// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief All ranks go on, or all stop: what one rank throws is thrown by all, so that nobody waits for one that is gone.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/ranks.hpp"

#include <algorithm>
#include <exception>
#include <optional>
#include <string_view>

namespace spate {

/// Thrown where another rank has thrown what is neither bad input nor a stop.
struct OtherRankFailed : std::runtime_error {
    OtherRankFailed(int rank, std::string const& what)
        : std::runtime_error("spate: rank " + std::to_string(rank) + " has failed: " + what)
    {}
};

namespace detail {
/// What a rank has thrown, as bytes.
struct Failure {
    enum class Kind { none, stop, bad_input, other };
    Kind kind = Kind::none;
    int rank = 0;
    std::int64_t step = 0, particle = -1, other = -1;
    int species = -1;
    double time = 0, position[3] = {}, velocity[3] = {}, value = 0, limit = 0;
    char name[32] = {}, quantity[160] = {}, what[640] = {};

    [[gnu::cold]] static void put(std::span<char> to, std::string_view from)
    {
        const std::size_t n = std::min(to.size() - 1, from.size());
        std::copy_n(from.begin(), n, to.begin());
        to[n] = '\0';
    }
    [[gnu::cold]] static Failure of(Stop const& stop)
    {
        StopFacts const& f = stop.facts();
        Failure mine;
        mine.kind = Kind::stop, mine.step = f.step, mine.particle = f.particle, mine.species = f.species;
        mine.other = f.other;
        mine.time = f.time, mine.value = f.value, mine.limit = f.limit;
        std::copy_n(f.position, 3, mine.position), std::copy_n(f.velocity, 3, mine.velocity);
        put(mine.name, stop.name()), put(mine.quantity, f.quantity);
        return mine;
    }
    [[gnu::cold]] static Failure of(Kind kind, std::string_view what)
    {
        Failure mine;
        mine.kind = kind;
        put(mine.what, what);
        return mine;
    }
    /// A stop counts more than other errors, that of the least particle more than others: as on one rank.
    [[nodiscard]] bool counts_more_than(Failure const& b) const
    {
        if (kind != b.kind) return kind != Kind::none && (b.kind == Kind::none || kind < b.kind);
        if (kind == Kind::stop && particle != b.particle) return particle < b.particle;
        return rank < b.rank;
    }
    [[noreturn, gnu::cold]] void raise() const
    {
        if (kind == Kind::bad_input) throw BadInput(std::string(what));
        if (kind == Kind::other) throw OtherRankFailed(rank, what);
        StopFacts f;
        f.step = step, f.time = time, f.particle = particle, f.species = species;
        std::copy_n(position, 3, f.position), std::copy_n(velocity, 3, f.velocity);
        f.quantity = quantity, f.value = value, f.limit = limit, f.other = other;
        throw_stop(name, f);
    }
};
struct First {
    void operator()(Failure& a, Failure const& b) const
    {
        if (b.counts_more_than(a)) a = b;
    }
};
} // namespace detail

/// Calls f, which must not wait for other ranks; if it throws on one rank or more, all throw the same.
template <Ranks R>
void together(R const& ranks, auto const& f)
{
    if constexpr (R::alone) f();
    else {
        using detail::Failure;
        Failure mine;
        std::exception_ptr thrown;
        try {
            f();
        }
        catch (Stop const& e) {
            mine = Failure::of(e), thrown = std::current_exception();
        }
        catch (BadInput const& e) {
            mine = Failure::of(Failure::Kind::bad_input, e.what()), thrown = std::current_exception();
        }
        catch (std::exception const& e) {
            mine = Failure::of(Failure::Kind::other, e.what()), thrown = std::current_exception();
        }
        mine.rank = ranks.rank();
        if (!ranks.all(mine.kind != Failure::Kind::none, agree::Or{})) return;
        const Failure first = ranks.all(mine, detail::First{});
        if (first.rank == ranks.rank() && thrown) std::rethrow_exception(thrown);
        first.raise();
    }
}

/// Rank 0 alone calls f, for all: a file is written once. What it throws all throw.
template <Ranks R>
void by_one(R const& ranks, auto const& f)
{
    together(ranks, [&] {
        if (ranks.rank() == 0) f();
    });
}

} // namespace spate
