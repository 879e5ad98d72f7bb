// SPDX-License-Identifier: BSD-3-Clause
#include <spate/core/errors.hpp>

#include <gmock/gmock.h>

#include <limits>

namespace {
using namespace spate;
using ::testing::HasSubstr;
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string message(auto const& f)
{
    try {
        f();
    }
    catch (std::exception const& e) {
        return e.what();
    }
    return "nothing was thrown";
}

TEST(BadInput, NamesTheParameterItsValueAndWhatIsAllowed)
{
    EXPECT_EQ(message([] { require_positive("kernel.h", -0.02, "m"); }),
              "spate: kernel.h is -0.02; allowed is a finite number above 0 [m]");
    EXPECT_EQ(message([] { throw BadInput("case", "tiny", "small or big"); }),
              "spate: case is tiny; allowed is small or big");
}

TEST(BadInput, IsThrownForWhatIsOutOfRangeOnly)
{
    for (double bad : {0.0, -1.0, inf, -inf, nan}) EXPECT_THROW(require_positive("x", bad, "m"), BadInput) << bad;
    for (double bad : {-1e-300, inf, nan}) EXPECT_THROW(require_non_negative("x", bad, "m"), BadInput) << bad;
    for (double bad : {inf, -inf, nan}) EXPECT_THROW(require_finite("x", bad, "m"), BadInput) << bad;
    EXPECT_NO_THROW(require_positive("x", 1e-300, "m"));
    EXPECT_NO_THROW(require_non_negative("x", 0, "m"));
    EXPECT_NO_THROW(require_finite("x", -1e300, "m"));
    EXPECT_NO_THROW(require(true, "x", nan, "anything"));
}

TEST(BadInput, ShowsNumbersInTheirShortestForm)
{
    EXPECT_EQ(text(0.1), "0.1");
    EXPECT_EQ(text(1000), "1000");
    EXPECT_EQ(text(1e-9), "1e-09");
    EXPECT_EQ(text(nan), "nan");
}

StopFacts facts()
{
    StopFacts f;
    f.step = 42, f.time = 0.25, f.particle = 7, f.species = 0, f.quantity = "velocity", f.value = 3, f.limit = 2;
    f.position[0] = 0.5, f.velocity[1] = -8;
    return f;
}

TEST(Stop, TellsStepTimeParticleValueAndLimit)
{
    const NonFinite stop(facts());
    const std::string s = stop.what();
    for (const char* part : {"NonFinite", "step 42", "t = 0.25 s", "particle 7 of species 0", "(0.5, 0, 0) m",
                             "(0, -8, 0) m/s", "velocity is 3, limit 2", "smaller dt"})
        EXPECT_THAT(s, HasSubstr(part));
    EXPECT_EQ(stop.name(), "NonFinite");
    EXPECT_EQ(stop.facts().particle, 7);
}

TEST(Stop, OfTheWholeSceneNamesNoParticle)
{
    StopFacts f = facts();
    f.particle = -1;
    EXPECT_THAT(EnergyRunaway(f).what(), ::testing::Not(HasSubstr("particle")));
}

TEST(Stop, IsCaughtAsOneKindAndKnownByName)
{
    auto name = [](auto const& stop) {
        try {
            throw stop;
        }
        catch (Stop const& s) {
            return s.name();
        }
    };
    EXPECT_EQ(name(OutOfDomain(facts())), "OutOfDomain");
    EXPECT_EQ(name(EnergyRunaway(facts())), "EnergyRunaway");
    EXPECT_EQ(name(DtCollapse(facts())), "DtCollapse");
    EXPECT_EQ(name(IndexOverflow(facts())), "IndexOverflow");
}

} // namespace
