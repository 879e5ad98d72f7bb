// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The watch: a run that has gone wrong ends in a typed stop that names the first offender. NoWatch is no code.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/measure/energy.hpp"

#include <algorithm>
#include <limits>

namespace spate {

/// Looks at every step for values that are not finite, at each rebuild for particles that left the domain, and now and
/// then at the total energy.
struct Watch {
    static constexpr bool on = true;
    int energy_every = 10; ///< steps between two looks at the energy
    double warn = 0.01;    ///< rise of total energy over its reference that is told [-]
    double stop = 0.05;    ///< ... that ends the run [-]

    [[gnu::cold]] void check() const
    {
        require(energy_every >= 1, "Watch.energy_every", energy_every, "1 or above [steps]");
        require(warn > 0, "Watch.warn", warn, "a number above 0 [-]");
        require(stop > 0, "Watch.stop", stop, "a number above 0 [-]");
    }
};
struct NoWatch {
    static constexpr bool on = false;
    void check() const {}
};

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
/// The first field of particle i that is not finite: its name and value.
template <class P>
[[gnu::cold]] std::pair<std::string, double> not_finite(P const& p, std::size_t i)
{
    std::pair<std::string, double> found{"", 0};
    for_each(P::fields, [&]<class F>(F f) {
        for (int c = 0; c < components<F, P::dim> && found.first.empty(); ++c) {
            const double value = double(p.column(f)[std::size_t(c)][i]);
            if (!std::isfinite(value)) found = {std::string(F::name), value};
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

/// Throws NonFinite for the first particle with a value that is not finite; nothing if there is none.
template <class P>
[[gnu::cold]] void stop_if_not_finite(P const& p, std::int64_t step, double time)
{
    const std::size_t i =
        detail::first_by_id(p, [&](std::size_t k) { return !detail::not_finite(p, k).first.empty(); });
    if (i == p.size()) return;
    StopFacts f = detail::facts_of(p, i);
    f.step = step, f.time = time;
    std::tie(f.quantity, f.value) = detail::not_finite(p, i);
    f.limit = std::numeric_limits<double>::max();
    throw NonFinite(f);
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
