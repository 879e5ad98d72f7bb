// SPDX-License-Identifier: BSD-3-Clause
// From what terms declare, the compiler makes the order in which they run: the plans of whole scenes, read as text.
#include "spate/spate.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace spate;

/// One line a stage: "sweep mobile: Continuity PressureForce", "pack mobile: position density".
template <class M, class P>
std::vector<std::string> lines(P const& plan, std::vector<std::string> const& terms)
{
    std::vector<std::string> all;
    EXPECT_EQ(terms.size(), std::size_t(M::terms));
    auto fields = [](Mask m) {
        std::string text;
        Mask bit = 1;
        for (auto name : names(M::universe)) {
            if ((m & bit) != 0) (text += ' ') += name;
            bit <<= 1;
        }
        return text;
    };
    for (int k = 0; k < plan.count; ++k) {
        const Stage s = plan.stage[std::size_t(k)];
        std::string line = s.action == Action::pass ? "pass" : s.action == Action::pack ? "pack" : "sweep";
        line += s.species == 0 ? " mobile:" : " marker:";
        for (std::size_t t = 0; t < terms.size(); ++t)
            if (((s.terms >> t) & 1) != 0) (line += ' ') += terms[t];
        if (s.action == Action::pack) line += fields(s.fields);
        if (s.action == Action::pass && s.fields != 0) (line += ", from 0:") += fields(s.fields);
        all.push_back(line);
    }
    return all;
}
using Lines = std::vector<std::string>;

/// The reference scene: Tait, continuity, pressure, viscosity, gravity.
using Water = decltype(wcsph(CubicSpline<2>{1}, Tait{1000, 10}, Continuity<2>{}, PressureForce<2>{},
                             ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -9.81}}));
const Lines water_terms{"Tait", "Continuity", "PressureForce", "ArtificialViscosity", "Gravity"};
using All = Fields<Position, Density, Velocity>;

TEST(Plan, OfAnOpenFluidIsOneFusedSweep)
{
    using M = Model<Water, Open>;
    static constexpr auto plan = M::rates_plan<All>();
    EXPECT_EQ(lines<M>(plan, water_terms),
              (Lines{"pass mobile: Tait", "pack mobile: position velocity density pressure",
                     "sweep mobile: Continuity PressureForce ArtificialViscosity Gravity"}));
    EXPECT_EQ(plan.sweeps(), 1);
}
TEST(Plan, OfDensityAloneLeavesTheRestOut)
{
    using M = Model<Water, Open>;
    static constexpr auto density_alone = M::rates_plan<Fields<Density>>();
    EXPECT_EQ(lines<M>(density_alone, water_terms),
              (Lines{"pack mobile: position velocity density", "sweep mobile: Continuity"}));
    static constexpr auto velocity_alone = M::rates_plan<Fields<Velocity>>();
    EXPECT_EQ(lines<M>(velocity_alone, water_terms),
              (Lines{"pass mobile: Tait", "pack mobile: position velocity density pressure",
                     "sweep mobile: PressureForce ArtificialViscosity Gravity"}));
    static constexpr auto position_alone = M::rates_plan<Fields<Position>>(); // its rate is at hand
    EXPECT_EQ(position_alone.count, 0);
    static constexpr auto refresh = M::refresh_plan();
    EXPECT_EQ(lines<M>(refresh, water_terms), (Lines{"pass mobile: Tait"}));
}
// Markers by extrapolation must be known before the fluid reads them, and the pressure of the fluid before that.
TEST(Plan, OfAdamiWallsSweepsMarkersFirst)
{
    using M = Model<Water, Bce<2, Adami>>;
    Lines terms = water_terms;
    terms.insert(terms.end(), {"AdamiSums", "AdamiState"});
    static constexpr auto plan = M::rates_plan<All>();
    EXPECT_EQ(lines<M>(plan, terms),
              (Lines{"pass mobile: Tait", "pack mobile: position velocity density pressure", "sweep marker: AdamiSums",
                     "pass marker: AdamiState", "pack marker: position density pressure",
                     "sweep mobile: Continuity PressureForce ArtificialViscosity Gravity"}));
    // Density asks nothing of a marker but where it is (its velocity is uniform, its mass too).
    static constexpr auto density_alone = M::rates_plan<Fields<Density>>();
    EXPECT_EQ(density_alone.sweeps(), 1);
}
// Markers by continuity run the fluid's own terms: none that would move them, none of marker on marker.
TEST(Plan, OfWallsByContinuityRunsTheFluidsTermsOnMarkers)
{
    using M = Model<Water, Bce<2, ByContinuity>>;
    static constexpr auto plan = M::rates_plan<All>();
    EXPECT_EQ(lines<M>(plan, water_terms),
              (Lines{"pass mobile: Tait", "pass marker: Tait", "pack mobile: position velocity density pressure",
                     "sweep marker: Continuity", "pack marker: position density pressure",
                     "sweep mobile: Continuity PressureForce ArtificialViscosity Gravity"}));
    static_assert(M::planner.meet(0, 0) && M::planner.meet(0, 1) && M::planner.meet(1, 0) && !M::planner.meet(1, 1));
}
TEST(Plan, OfGrainsIsASweep)
{
    using Grains = decltype(dem<2>({.mass = 1, .radius = 1}, LinearSpring{1}));
    using M = Model<Grains, Open>;
    static constexpr auto plan = M::rates_plan<Fields<Position, Velocity>>();
    EXPECT_EQ(lines<M>(plan, {"LinearSpring"}), (Lines{"pack mobile: position", "sweep mobile: LinearSpring"}));
}

inline constexpr struct Heat : ScalarField {
    static constexpr std::string_view name = "heat";
    static constexpr bool derived = true;
} heat{};
inline constexpr struct Warmth : ScalarField {
    static constexpr std::string_view name = "warmth";
    static constexpr bool derived = true;
} warmth{};
struct Push {
    static constexpr Fields adds{acceleration};
    void operator()(auto& i) const { i[acceleration] += Vec<2, double>{{1, 0}}; }
};
struct SumHeat {
    static constexpr Fields adds{heat};
    void operator()(auto& i, auto const&, auto const& ij) const { i[heat] += ij.overlap; }
};
struct Thermometer {
    static constexpr Fields reads{heat};
    static constexpr Fields writes{warmth};
    void operator()(auto& i) const { i[warmth] = 2 * i[heat]; }
};
struct WarmPush {
    static constexpr Fields reads{warmth};
    static constexpr Fields adds{acceleration};
    void operator()(auto& i, auto const& j, auto const& ij) const { i[acceleration] += (i[warmth] + j[warmth]) * ij.n; }
};
struct Dissipate {
    static constexpr Fields writes{warmth};
    static constexpr When when = When::after_step;
    void operator()(auto& i) const { i[warmth] = 0; }
};

// The order in which the user writes terms does not matter; what they read does.
TEST(Plan, FollowsWhatIsReadAndNotWhatIsWrittenFirst)
{
    using Chain = decltype(physics(Round<2>{1}, Uniform{radius, 1.0}, WarmPush{}, Thermometer{}, SumHeat{}));
    using M = Model<Chain, Open>;
    static constexpr auto plan = M::rates_plan<Fields<Velocity>>();
    EXPECT_EQ(lines<M>(plan, {"WarmPush", "Thermometer", "SumHeat"}),
              (Lines{"pack mobile: position", "sweep mobile: SumHeat", "pass mobile: Thermometer",
                     "pack mobile: position warmth", "sweep mobile: WarmPush"}));
}
TEST(Plan, OfParticleTermsAloneIsAPassFromZero)
{
    using M = Model<decltype(physics(Round<2>{1}, Uniform{radius, 1.0}, Push{}, Gravity<2>{})), Open>;
    static constexpr auto plan = M::rates_plan<Fields<Velocity>>();
    EXPECT_EQ(lines<M>(plan, {"Push", "Gravity"}), (Lines{"pass mobile: Push Gravity, from 0: acceleration"}));
    static_assert(!M::planner.meet(0, 0)); // so no list is ever built
}
TEST(Plan, OfAPhaseHoldsItsTermsOnly)
{
    using Chain =
        decltype(physics(Round<2>{1}, Uniform{radius, 1.0}, WarmPush{}, Thermometer{}, SumHeat{}, Dissipate{}));
    using M = Model<Chain, Open>;
    static constexpr auto after = M::phase_plan<When::after_step, 3>();
    EXPECT_EQ(lines<M>(after, {"WarmPush", "Thermometer", "SumHeat", "Dissipate"}), (Lines{"pass mobile: Dissipate"}));
    static constexpr auto rates = M::rates_plan<Fields<Velocity>>();
    for (int k = 0; k < rates.count; ++k) EXPECT_EQ(rates.stage[std::size_t(k)].terms & 8u, 0u);
}

/// A planner of one species whose field k is bit k; fields from `given` on are there without a term.
template <int N>
constexpr Planner<N, 1> planner(std::array<TermFacts, std::size_t(N)> terms, Mask given)
{
    for (auto& t : terms) t.targets = 1, t.sources = t.pair ? Mask(1) : Mask(0);
    return {terms, {{{.stored = 0xff, .uniform = 0, .given = given, .marker = false}}}, 0};
}
// The model is closed if each field that is read is given or made: of the target, and of the source.
TEST(Plan, FindsTheTermThatReadsWhatNothingProvides)
{
    constexpr Mask a = 1, b = 2, c = 4;
    const TermFacts b_from_a{.reads_i = a, .writes = b}, c_from_b{.reads_i = b, .writes = c};
    EXPECT_EQ((planner<2>({c_from_b, b_from_a}, a).open_term()), -1);
    EXPECT_EQ((planner<2>({c_from_b, b_from_a}, 0).open_term()), 1);
    EXPECT_EQ((planner<1>({c_from_b}, a).open_term()), 0);
    const TermFacts pair{.pair = true, .reads_i = a, .reads_j = b, .adds = c};
    EXPECT_EQ((planner<1>({pair}, a | b).open_term()), -1);
    EXPECT_EQ((planner<1>({pair}, a).open_term()), 0); // j lacks b
    EXPECT_EQ((planner<1>({pair}, b).open_term()), 0); // i lacks a
    const TermFacts late{.writes = b, .when = When::after_step};
    EXPECT_EQ((planner<2>({c_from_b, late}, a).open_term()), 0); // too late for an evaluation
}
// Terms that add to one field run as one: none may see half a sum.
TEST(Plan, WaitsForAllAddendsOfAField)
{
    constexpr Mask a = 1, b = 2, c = 4, d = 8;
    const TermFacts early{.pair = true, .reads_i = a, .adds = c}, make_b{.pair = true, .reads_i = a, .adds = b},
        late{.pair = true, .reads_i = b, .adds = c}, use{.reads_i = c, .writes = d};
    const auto plan = planner<4>({early, use, late, make_b}, a).plan({d});
    std::vector<Mask> order;
    for (int k = 0; k < plan.count; ++k)
        if (plan.stage[std::size_t(k)].action != Action::pack) order.push_back(plan.stage[std::size_t(k)].terms);
    EXPECT_EQ(order, (std::vector<Mask>{8, 1 | 4, 2})); // make_b; early and late together; use
}
TEST(Plan, LeavesOutWhatNobodyAskedFor)
{
    constexpr Mask a = 1, b = 2, c = 4;
    const TermFacts make_b{.reads_i = a, .writes = b}, make_c{.reads_i = a, .writes = c};
    const auto plan = planner<2>({make_b, make_c}, a).plan({c});
    ASSERT_EQ(plan.count, 1);
    EXPECT_EQ(plan.stage[0].terms, 2u);
    EXPECT_EQ((planner<2>({make_b, make_c}, a).plan({0}).count), 0);
}

/// A phase that changes a given field which its own sums read: they run on the state before it, and nobody else waits.
TEST(Plan, OfAPhaseThatChangesTheStateBringsItsSumsOfTheStateBefore)
{
    using P = decltype(wcsph(CubicSpline<2>{1}, Tait{1000, 10}, Continuity<2>{}, PressureForce<2>{},
                             DensityReinit<Shepard>{}, Shifting{.mach = 0.1}));
    using M = Model<P, Open>;
    const Lines terms{"Tait",          "Continuity",  "PressureForce", "ReinitSums",
                      "ReinitDensity", "CrowdingSum", "ShiftInside"};
    static constexpr auto reinit = M::phase_plan<When::after_step, 4>(), shift = M::phase_plan<When::after_step, 6>();
    EXPECT_TRUE(reinit.complete && shift.complete);
    const auto a = lines<M>(reinit, terms), b = lines<M>(shift, terms);
    EXPECT_EQ(a.size(), 3u);
    EXPECT_EQ(a[1], "sweep mobile: ReinitSums");
    EXPECT_EQ(a[2], "pass mobile: ReinitDensity") << "no shift: that has its own turn";
    EXPECT_EQ(b.size(), 3u);
    EXPECT_EQ(b[1], "sweep mobile: CrowdingSum");
    EXPECT_EQ(b[2], "pass mobile: ShiftInside");
    static constexpr auto rates = M::rates_plan<All>();
    EXPECT_EQ(rates.sweeps(), 1);
    for (auto const& line : lines<M>(rates, terms)) EXPECT_EQ(line.find("Sum"), std::string::npos) << line;
}

} // namespace
