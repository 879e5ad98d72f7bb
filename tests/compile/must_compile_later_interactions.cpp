// SPDX-License-Identifier: BSD-3-Clause
// Interactions of the kinds that come with bodies, as far as an Interaction holds them today: pairs that a mask picks out
// of a range. What they still need of the engine is a list of their own (Links: a fixed one, without a search; Members: all
// markers of a body, in exact sums) and memory of a pair (the rest length of a link).
#include <spate/spate.hpp>

using namespace spate;

namespace {

inline constexpr struct Label : ScalarField {
    static constexpr std::string_view name = "label", unit = "-";
} label{};
inline constexpr struct Partner : ScalarField {
    static constexpr std::string_view name = "partner", unit = "-";
} partner{};
inline constexpr struct Body : ScalarField {
    static constexpr std::string_view name = "body", unit = "-";
} body{};

template <int Dim, class V, class M>
struct Link {
    Vec<Dim, V> x; ///< x_i - x_j [m]
    V r;           ///< |x| [m]
    M mask;
};
/// Each particle is tied to the one whose label its partner names; no tie is longer than .
template <int Dim>
struct Links {
    static constexpr int dim = Dim;
    static constexpr Fields reads{position, label, partner};
    double longest; // [m]

    double range() const { return longest; }
    double length() const { return longest; }
    void check() const { require_positive("Links.longest", longest, "m"); }
    template <class V>
    auto pair(auto const& i, auto const& j) const
    {
        auto tied = i[partner] == j[label];
        Link<Dim, V, decltype(tied)> ij{i[position] - j[position], V(0), tied};
        ij.r = sqrt(ij.x.squaredNorm());
        return ij;
    }
};
/// Particles of one body, wherever in its extent they are.
template <int Dim>
struct Members {
    static constexpr int dim = Dim;
    static constexpr Fields reads{position, body};
    double extent; // [m]

    double range() const { return extent; }
    double length() const { return extent; }
    void check() const { require_positive("Members.extent", extent, "m"); }
    template <class V>
    auto pair(auto const& i, auto const& j) const
    {
        auto same = i[body] == j[body];
        Link<Dim, V, decltype(same)> ij{i[position] - j[position], V(0), same};
        ij.r = sqrt(ij.x.squaredNorm());
        return ij;
    }
};
static_assert(Interaction<Links<2>> && Interaction<Members<3>>);

struct Tie {
    static constexpr Fields adds{acceleration};
    double rate, rest; // [1/s^2], [m]
    void operator()(auto& i, auto const&, auto const& ij) const
    {
        i[acceleration] -= (rate * (1 - rest / ij.r)) * ij.x;
    }
};

} // namespace

void must_compile_later_interactions()
{
    Simulation chain(physics(Links<2>{.longest = 0.02}, Tie{.rate = 1, .rest = 0.01}), Leapfrog{}, Open{});
    chain.fill(Box<2>{{0, 0}, {0.1, 0.1}}, 0.01);
    chain.run({.steps = 1, .dt = 1e-3});
    Simulation bodies(physics(Members<3>{.extent = 0.02}, Tie{.rate = 1, .rest = 0.01}), Leapfrog{}, Open{});
    bodies.fill(Box<3>{{0, 0, 0}, {0.1, 0.1, 0.1}}, 0.01);
    bodies.run({.steps = 1, .dt = 1e-3});
}
