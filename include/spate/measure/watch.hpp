// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The watch: a run that has gone wrong ends in a typed stop that names the first offender. NoWatch is no code.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/measure/energy.hpp"
#include "spate/measure/listed_pairs.hpp"
#include "spate/measure/origin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace spate {

/// Looks at every step for values that are not finite, densities that the equation of state does not know and grains that
/// outrun their contacts, at each rebuild for particles that left the domain, now and then at the total energy, and once, at
/// the start, for pairs that are too near.
struct Watch {
    static constexpr bool on = true;
    int energy_every = 10; ///< steps between two looks at the energy, where it has risen by half of `warn`
    double warn = 0.01;    ///< rise of total energy over its reference that is told [-]
    double stop = 0.05;    ///< ... that ends the run [-]
    double overlap = 0.2;  ///< of two grains at the start, over the smaller radius, that is let pass [-]
    int calm = 32; ///< while it has not, one in so many looks is taken, before the first of these the times between two
                   ///< double; a look costs grains two or three steps: 1 % in 320

    [[gnu::cold]] void check() const
    {
        require(energy_every >= 1, "Watch.energy_every", energy_every, "1 or above [steps]");
        require(calm >= 1, "Watch.calm", calm, "1 or above [looks]");
        require(warn > 0, "Watch.warn", warn, "a number above 0 [-]");
        require(stop > 0, "Watch.stop", stop, "a number above 0 [-]");
        require(overlap >= 0, "Watch.overlap", overlap, "a number, 0 or above [-]");
    }
};
/// A Watch that can name the term behind a value that is not finite: it runs the steps since the last rebuild again, term by
/// term. This compiles every sweep once more for each of its terms, so that it is for those who ask.
struct TracingWatch : Watch {
    static constexpr bool traces = true;
};
struct NoWatch {
    static constexpr bool on = false;
    void check() const {}
};

/// Whether the mobile particles of a system are grains.
template <class S>
inline constexpr bool has_radius = [] {
    using Q = std::remove_cvref_t<decltype(std::declval<S const&>().mobile())>;
    return (Q::fields | Q::uniform).template contains<Radius>;
}();

namespace detail {
/// Facts of one particle of the mobile species.
template <class P>
[[gnu::cold]] StopFacts facts_of(P const& p, std::size_t i)
{
    StopFacts f;
    f.species = 0;
    f.particle = p.id()[i];
    const auto x = p.at(position, i), v = p.at(velocity, i);
    for (int c = 0; c < P::dim; ++c) f.position[c] = x[c], f.velocity[c] = v[c];
    return f;
}
/// The particle of least id for which `is` names a fact: the same one whoever looks.
template <class P>
std::size_t first_by_id(P const& p, auto const& is)
{
    std::size_t first = p.size();
    for (std::size_t i = 0; i < p.size(); ++i)
        if (is(i) && (first == p.size() || p.id()[i] < p.id()[first])) first = i;
    return first;
}
/// The first field of particle i that is not finite, or whose square is not: its name and value.
template <class P>
[[gnu::cold]] std::pair<std::string_view, double> not_finite(P const& p, std::size_t i)
{
    std::pair<std::string_view, double> found{"", 0};
    for_each(P::fields, [&]<class F>(F f) {
        for (int c = 0; c < components<F, P::dim> && found.first.empty(); ++c) {
            const auto value = p.column(f)[std::size_t(c)][i];
            if (!std::isfinite(value * value)) found = {F::name, value};
        }
    });
    return found;
}
template <class P>
[[noreturn, gnu::cold]] void stop_outside(P const& p, std::size_t i, double beyond, double thick, std::int64_t step,
                                          double time)
{
    StopFacts f = facts_of(p, i);
    f.step = step, f.time = time;
    f.quantity = "the distance beyond a wall face [m]";
    f.value = beyond;
    f.limit = thick;
    throw OutOfDomain(f);
}
} // namespace detail

/// Throws NonFinite (CoincidentParticles where that is why) for the particle of least id with a value that is not finite, or
/// for the one of which a term made it, as it was then; nothing if all is finite.
/// \param origin  asked for the Origin of the value
template <class P>
[[gnu::cold]] void stop_if_not_finite(P const& p, std::int64_t step, double time, auto const& origin)
{
    const std::size_t i =
        detail::first_by_id(p, [&](std::size_t k) { return !detail::not_finite(p, k).first.empty(); });
    if (i == p.size()) return;
    StopFacts f = detail::facts_of(p, i);
    f.step = step, f.time = time;
    const auto [quantity, value] = detail::not_finite(p, i);
    f.quantity = quantity, f.value = value;
    f.limit = std::sqrt(double(std::numeric_limits<typename P::real>::max())); // squares must be finite too
    const Origin from = origin();
    if (!from.term.empty()) { // neighbours may have ids that are less
        f.species = from.species, f.particle = from.particle;
        std::copy(std::begin(from.position), std::end(from.position), f.position);
        std::copy(std::begin(from.velocity), std::end(from.velocity), f.velocity);
        f.term = from.term, f.other = from.other;
    }
    if (from.at_one_place) throw CoincidentParticles(f);
    throw NonFinite(f);
}
/// Throws EosDomain for the first particle whose density is not above 0 or is above `most` [kg/m^3]; nothing where it is
/// another rank's.
template <class P>
[[gnu::cold]] void stop_of_density(P const& p, double most, std::int64_t step, double time)
{
    const std::size_t i =
        detail::first_by_id(p, [&](std::size_t k) { return !(p.at(density, k) > 0) || p.at(density, k) > most; });
    if (i == p.size()) return;
    StopFacts f = detail::facts_of(p, i);
    f.step = step, f.time = time;
    f.quantity = "density [kg/m^3]", f.value = p.at(density, i);
    f.limit = f.value > most ? most : 0;
    throw EosDomain(f);
}
/// Two particles that are in each other, by their ids; of images of one particle these are equal.
struct DeepPair {
    double depth; ///< over the smaller radius [-]
    std::uint32_t particle = std::numeric_limits<std::uint32_t>::max(), other = particle; ///< the lower id first
    int rank = -1; ///< that has the first; -1: there is none

    [[nodiscard]] bool counts_more_than(DeepPair const& b) const
    {
        if (depth != b.depth) return depth > b.depth;
        return particle != b.particle ? particle < b.particle : other < b.other;
    }
};
struct Deepest {
    void operator()(DeepPair& a, DeepPair const& b) const
    {
        if (b.counts_more_than(a)) a = b;
    }
};
/// The deepest pair of all ranks, which all call it; infinitely deep are two at one place.
/// \param overlap  the deepest that is let pass, over the smaller radius
template <class S>
[[gnu::cold]] DeepPair deepest_pair(S const& system, double overlap)
{
    auto const& p = system.mobile();
    std::vector<typename S::Near> others;
    if constexpr (!S::alone) others = system.others();
    DeepPair worst{overlap};
    each_listed_pair(system, others, [&](std::size_t i, auto const& who, auto const& x) {
        const double r2 = x.squaredNorm();
        DeepPair pair{r2 == 0 ? std::numeric_limits<double>::infinity() : 0, p.id()[i], who.id, system.ranks().rank()};
        if constexpr (has_radius<S>)
            if (r2 > 0) {
                const double a = p.at(radius, i), b = who.radius;
                pair.depth = (a + b - std::sqrt(r2)) / std::min(a, b);
            }
        if (pair.particle <= pair.other && pair.depth > overlap) Deepest{}(worst, pair);
    });
    return system.ranks().all(worst, Deepest{});
}
/// The pairs of a start: two grains at one place or deep in each other are a stop, two smoothed particles at one place
/// a warning, since nothing will part them. Throws on the rank that has the particle.
/// \param worst  of all pairs    \param overlap  as above
template <class S>
[[gnu::cold]] void look_at_pairs(S const& system, DeepPair const& worst, double overlap, std::int64_t step, double time,
                                 std::vector<std::string>& warnings)
{
    if (worst.rank < 0) return;
    if constexpr (!has_radius<S>)
        warnings.push_back("particles " + std::to_string(worst.particle) + " and " + std::to_string(worst.other) +
                           " are at one place, where no force parts them");
    else if (worst.rank == system.ranks().rank()) {
        auto const& p = system.mobile();
        StopFacts f =
            detail::facts_of(p, detail::first_by_id(p, [&](std::size_t i) { return p.id()[i] == worst.particle; }));
        f.step = step, f.time = time, f.other = worst.other;
        f.quantity = "the distance of two grains [m]";
        if (std::isinf(worst.depth)) throw CoincidentParticles(f);
        f.quantity = "the overlap of two grains at the start, over the smaller radius";
        f.value = worst.depth, f.limit = overlap;
        throw OverlapTooDeep(f, "move them apart, or let it pass with Watch{.overlap = ...}: the energy that is stored "
                                "there sets them free like a shot");
    }
}
/// Throws OutOfDomain for the first particle that is further beyond a wall face than the wall is thick.
template <class P, class B>
void stop_if_outside(P const& p, B const& boundary, double range, std::int64_t step, double time)
{
    const double thick = boundary.thickness(range);
    if (thick <= 0) return;
    const std::size_t i = detail::first_by_id(
        p, [&](std::size_t k) { return boundary.template beyond<P::dim>(p.at(position, k)) > thick; });
    if (i < p.size())
        detail::stop_outside(p, i, boundary.template beyond<P::dim>(p.at(position, i)), thick, step, time);
}

} // namespace spate
