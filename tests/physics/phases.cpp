// SPDX-License-Identifier: BSD-3-Clause
// Terms of a phase run before or after a step, on the steps that they name, and see what an evaluation derives.
#include <spate/spate.hpp>

#include <gtest/gtest.h>

namespace {
using namespace spate;

inline constexpr struct Seen : ScalarField {
    static constexpr std::string_view name = "seen";
} seen{};
inline constexpr struct KernelWeight : ScalarField {
    static constexpr std::string_view name = "kernel_weight";
    static constexpr bool derived = true;
} kernel_weight{};

struct NotePressure {
    static constexpr Fields reads{pressure};
    static constexpr Fields writes{seen};
    static constexpr When when = When::before_step;
    void operator()(auto& i) const { i[seen] = i[pressure]; }
};
struct HalveSpeed {
    static constexpr Fields reads{velocity};
    static constexpr Fields writes{velocity};
    static constexpr When when = When::after_step;
    int every;
    void operator()(auto& i) const { i[velocity] = 0.5 * i[velocity]; }
};
struct SumOfKernels { // nobody reads it: refresh() makes it
    static constexpr Fields adds{kernel_weight};
    void operator()(auto& i, auto const&, auto const& ij) const { i[kernel_weight] += ij.w; }
};

auto block(int every)
{
    Simulation s(wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, NotePressure{},
                       HalveSpeed{every}, SumOfKernels{}),
                 SymplecticEuler{}, Open{});
    s.fill(Box<2>{{0, 0}, {0.1, 0.1}}, 0.01, [](auto& p, std::size_t i) {
        p.put(velocity, i, {1, 0});
        p.put(density, i, 1001);
    });
    return s;
}

TEST(Phases, TermBeforeAStepSeesWhatTheEvaluationDerives)
{
    auto s = block(1);
    s.run({.steps = 1, .dt = 1e-5});
    const Tait eos{.rho0 = 1000, .c0 = 10};
    EXPECT_NEAR(s.particles().at(seen, 50), eos.pressure_of(1001.0), 1e-12 * eos.pressure_of(1001.0));
}
TEST(Phases, TermAfterAStepMayChangeWhatItReadsAndRunsOnItsSteps)
{
    auto s = block(3);
    s.run({.steps = 7, .dt = 1e-5}); // after steps 0, 3 and 6
    EXPECT_DOUBLE_EQ(s.particles().at(velocity, 50)[0], 0.125);
}
TEST(Phases, SumThatIsNoRateIsMadeByRefresh)
{
    auto s = block(1);
    s.refresh();
    auto const& p = s.particles();
    const CubicSpline<2> kernel{.h = 0.012};
    for (std::size_t i : {std::size_t(0), std::size_t(50), std::size_t(99)}) {
        double sum = 0;
        for (std::size_t j = 0; j < p.size(); ++j)
            if (j != i)
                sum += kernel.sigma() *
                       kernel.f((p.at(position, i) - p.at(position, j)).squaredNorm() > 0
                                    ? std::sqrt((p.at(position, i) - p.at(position, j)).squaredNorm()) / kernel.h
                                    : 0.0);
        EXPECT_NEAR(p.at(kernel_weight, i), sum, 1e-12 * sum);
    }
}
TEST(Phases, TermThatChangesTheStateMakesTheForceAtTheEndOfAStepStale)
{
    auto kept = [](auto... term) {
        Simulation s(wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{},
                           PressureForce<2>{}, term...),
                     Leapfrog{}, Open{});
        s.fill(Box<2>{{0, 0}, {0.1, 0.1}}, 0.01);
        s.run({.steps = 1, .dt = 1e-5});
        return s.system().kick_rates_current();
    };
    EXPECT_TRUE(kept());
    EXPECT_TRUE(kept(NotePressure{}));
    EXPECT_FALSE(kept(HalveSpeed{1}));
    EXPECT_FALSE(kept(DensityReinit<Shepard>{}));
}
} // namespace
