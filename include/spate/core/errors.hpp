// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What can end a run: bad input before step 0, and typed stops with the facts of the first offender.
#pragma once

#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace spate {

/// One parameter is out of range: name, value, and what is allowed.
struct BadInput : std::invalid_argument {
    [[gnu::cold]] BadInput(std::string_view parameter, std::string_view value, std::string_view allowed)
        : std::invalid_argument(sentence(parameter, value, allowed))
    {}
    /// As another rank has said it.
    explicit BadInput(std::string const& sentence) : std::invalid_argument(sentence) {}

private:
    [[gnu::cold]] static std::string sentence(std::string_view parameter, std::string_view value,
                                              std::string_view allowed)
    {
        std::string s = "spate: ";
        for (std::string_view part :
             {parameter, std::string_view(" is "), value, std::string_view("; allowed is "), allowed})
            s += part;
        return s;
    }
};

/// A number as a message shows it: the shortest of up to 10 digits.
[[gnu::cold]] inline std::string text(double x)
{
    std::ostringstream s;
    s.precision(10);
    s << x;
    return s.str();
}
namespace detail {
[[noreturn, gnu::cold, gnu::noinline]] inline void refuse(std::string_view parameter, double value,
                                                          std::string_view allowed, std::string_view unit = {})
{
    std::string all(allowed);
    if (!unit.empty()) (((all += " [") += unit) += "]");
    throw BadInput(parameter, text(value), all);
}
[[noreturn, gnu::cold, gnu::noinline]] inline void refuse_particle(std::string_view field, std::int64_t id,
                                                                   double value, std::string_view allowed)
{
    refuse(std::string(field) + " of particle " + std::to_string(id), value, allowed);
}
} // namespace detail
inline void require(bool holds, std::string_view parameter, double value, std::string_view allowed)
{
    if (!holds) detail::refuse(parameter, value, allowed);
}
inline void require_positive(std::string_view parameter, double value, std::string_view unit)
{
    if (!(value > 0 && std::isfinite(value))) detail::refuse(parameter, value, "a finite number above 0", unit);
}
inline void require_finite(std::string_view parameter, double value, std::string_view unit)
{
    if (!std::isfinite(value)) detail::refuse(parameter, value, "a finite number", unit);
}
inline void require_non_negative(std::string_view parameter, double value, std::string_view unit)
{
    if (!(value >= 0 && std::isfinite(value))) detail::refuse(parameter, value, "a finite number, 0 or above", unit);
}

/// Where a run stopped, and on what.
struct StopFacts {
    std::int64_t step = 0;
    double time = 0;                ///< [s]
    std::int64_t particle = -1;     ///< id, -1 where the whole scene is meant
    int species = -1;               ///< its species
    double position[3] = {0, 0, 0}; ///< [m]
    double velocity[3] = {0, 0, 0}; ///< [m/s]
    std::string quantity;           ///< the field or measure that broke its limit
    double value = 0;
    double limit = 0;
    std::string term;        ///< that made the value, where it was one
    std::int64_t other = -1; ///< id of the neighbour of whom it made it
};

/// A run that can't go on. `name()` is what summary.json and the exit message carry.
class Stop : public std::runtime_error {
public:
    [[gnu::cold]] Stop(std::string name, StopFacts facts, std::string const& advice)
        : std::runtime_error(name), message_(sentence(name, facts, advice)), name_(std::move(name)),
          facts_(std::move(facts))
    {}
    [[nodiscard]] std::string const& name() const { return name_; }
    [[nodiscard]] StopFacts const& facts() const { return facts_; }
    [[nodiscard]] char const* what() const noexcept override { return message_.c_str(); }
    /// Ends the message with where the states were saved.
    void add(std::string const& more)
    {
        if (!more.empty()) message_ += "; " + more;
    }

private:
    [[gnu::cold]] static std::string sentence(std::string const& name, StopFacts const& f, std::string const& advice)
    {
        std::ostringstream s;
        s.precision(10);
        s << "spate: stopped, " << name << " at step " << f.step << ", t = " << f.time << " s: ";
        if (f.particle >= 0)
            s << "particle " << f.particle << " of species " << f.species << " at (" << f.position[0] << ", "
              << f.position[1] << ", " << f.position[2] << ") m with velocity (" << f.velocity[0] << ", "
              << f.velocity[1] << ", " << f.velocity[2] << ") m/s: ";
        s << f.quantity << " is " << f.value << ", limit " << f.limit;
        if (!f.term.empty()) s << ", made by " << f.term;
        if (f.other >= 0) s << (f.term.empty() ? ", of it and particle " : " with particle ") << f.other;
        s << "; " << advice;
        return s.str();
    }
    std::string message_, name_;
    StopFacts facts_;
};
struct NonFinite : Stop {
    [[gnu::cold]] explicit NonFinite(StopFacts f)
        : Stop("NonFinite", std::move(f),
               "take a smaller dt or cfl, or look at the start of the run near this particle")
    {}
};
struct OutOfDomain : Stop {
    [[gnu::cold]] explicit OutOfDomain(StopFacts f)
        : Stop("OutOfDomain", std::move(f),
               "the particle went through a wall: take a smaller dt or cfl, or a finer wall")
    {}
};
struct EnergyRunaway : Stop {
    [[gnu::cold]] explicit EnergyRunaway(StopFacts f)
        : Stop("EnergyRunaway", std::move(f),
               "the scheme creates energy: take a smaller dt, another integrator, or more dissipation")
    {}
};
struct DtCollapse : Stop {
    [[gnu::cold]] explicit DtCollapse(StopFacts f)
        : Stop("DtCollapse", std::move(f),
               "speeds or accelerations have grown a thousandfold: look at the last snapshot")
    {}
};
struct SkinOutrun : Stop {
    [[gnu::cold]] explicit SkinOutrun(StopFacts f)
        : Stop("SkinOutrun", std::move(f), "take a smaller dt, or a larger skin and bins of the Neighbours")
    {}
};
struct IndexOverflow : Stop {
    [[gnu::cold]] explicit IndexOverflow(StopFacts f)
        : Stop("IndexOverflow", std::move(f),
               "a particle is too far from the origin for the cell index: bound the domain")
    {}
};
struct NeighbourOverflow : Stop {
    [[gnu::cold]] explicit NeighbourOverflow(StopFacts f)
        : Stop(
              "NeighbourOverflow", std::move(f),
              "particles have clumped or the range is too long for them: look at the last snapshot, take a shorter range, "
              "or a larger `most` of the Neighbours")
    {}
};
struct EosDomain : Stop {
    [[gnu::cold]] explicit EosDomain(StopFacts f)
        : Stop("EosDomain", std::move(f),
               "the equation of state has no meaning there: take a smaller dt or cfl, a larger c0, or more dissipation")
    {}
};
struct CoincidentParticles : Stop {
    [[gnu::cold]] explicit CoincidentParticles(StopFacts f)
        : Stop("CoincidentParticles", std::move(f), "a contact of two at one place has no normal: move one of them")
    {}
};
struct OverlapTooDeep : Stop {
    [[gnu::cold]] explicit OverlapTooDeep(StopFacts f, std::string const& advice)
        : Stop("OverlapTooDeep", std::move(f), advice)
    {}
};

/// Throws the stop of a name.
[[noreturn, gnu::cold]] inline void throw_stop(std::string const& name, StopFacts const& f)
{
    if (name == "NonFinite") throw NonFinite(f);
    if (name == "OutOfDomain") throw OutOfDomain(f);
    if (name == "EnergyRunaway") throw EnergyRunaway(f);
    if (name == "DtCollapse") throw DtCollapse(f);
    if (name == "SkinOutrun") throw SkinOutrun(f);
    if (name == "IndexOverflow") throw IndexOverflow(f);
    if (name == "NeighbourOverflow") throw NeighbourOverflow(f);
    if (name == "EosDomain") throw EosDomain(f);
    if (name == "CoincidentParticles") throw CoincidentParticles(f);
    if (name == "OverlapTooDeep") throw OverlapTooDeep(f, "move them apart, or take a smaller dt");
    throw Stop(name, f, "another rank has stopped");
}

} // namespace spate
