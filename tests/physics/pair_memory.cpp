// SPDX-License-Identifier: BSD-3-Clause
// What a term keeps of a pair is born zero with the contact, survives sorting and rebuilds, and dies with the contact.
#include <spate/spate.hpp>

#include <gtest/gtest.h>

namespace {
using namespace spate;

inline constexpr struct Age : ScalarField {
    static constexpr std::string_view name = "age", unit = "1";
} age{};

// A push that grows by one unit with each evaluation that a contact has lived.
struct GrowingPush {
    static constexpr Fields adds{acceleration};
    static constexpr Fields keeps{age};
    double unit; ///< [m/s^2]
    void operator()(auto& i, auto const&, auto const& ij) const
    {
        i[age] += 1;
        i[acceleration] += (unit * i[age]) * ij.n;
    }
};

constexpr double r = 0.01, unit = 1e-6, dt = 1e-4;

template <class Backend>
auto crowd(Backend backend)
{
    Simulation box(dem<2>({.mass = 0.1, .radius = r}, GrowingPush{unit}), SymplecticEuler{},
                   Periodic(Box<2>{{0, 0}, {1, 1}}), backend, Double{}, NoWatch{},
                   Neighbours{.skin = 0.3, .finer = 1, .window = 1});
    box.add({0.5, 0.5});
    box.add({0.5 + 1.5 * r, 0.5});
    for (int k = 0; k < 40; ++k) // pass by at speed and force rebuilds
        box.add({0.021 * k + (k < 20 ? 0.01 : 0.15), 0.1 + 0.3 * (k % 2)}, {0, 4.0 + 0.02 * k});
    return box;
}
template <class S>
std::size_t index_of(S const& box, std::uint32_t id)
{
    auto const& ids = box.particles().id();
    return std::size_t(std::find(ids.begin(), ids.end(), id) - ids.begin());
}
template <class S>
double push_on(S const& box, std::uint32_t id) // in units
{
    return box.particles().at(acceleration, index_of(box, id))[0] / unit;
}

TEST(PairMemory, CountsEveryEvaluationOfAContactThroughRebuilds)
{
    auto box = crowd(Serial{});
    for (int n = 1; n <= 300; ++n) {
        box.run({.steps = 1, .dt = dt});
        ASSERT_NEAR(push_on(box, 0), -n, 1e-9 * n) << "after step " << n;
        ASSERT_NEAR(push_on(box, 1), n, 1e-9 * n) << "after step " << n;
    }
    EXPECT_GT(box.system().rebuilds(), 20);
}
// What is kept is carried to where positions are: as old as the contact, whatever stages the integrator takes, and looking
// at it changes nothing.
struct Ageing {
    static constexpr Fields adds{acceleration};
    static constexpr Fields keeps{age};
    static constexpr bool stores_energy = true;
    void operator()(auto& i, auto const&, auto const& ij) const
    {
        i[age] = value(i[age]) + i[elapsed];
        i[acceleration] += (1e-9 * value(i[age])) * ij.n;
    }
    double energy(auto const& i, auto const&, auto const&) const { return value(i[age]); }
};
template <class I>
class PairMemoryOf : public testing::Test {};
using Integrators = testing::Types<ForwardEuler, SymplecticEuler, Leapfrog, RungeKutta2>;
TYPED_TEST_SUITE(PairMemoryOf, Integrators);

TYPED_TEST(PairMemoryOf, IsAsOldAsTheContact)
{
    Simulation box(dem<2>({.mass = 0.1, .radius = r}, Ageing{}), TypeParam{}, Open{}, Serial{}, Double{}, NoWatch{});
    box.add({0.5, 0.5});
    box.add({0.5 + 1.5 * r, 0.5});
    double t = 0;
    for (int n = 1; n <= 50; ++n) {
        const double step = n % 3 == 0 ? dt : dt / 4; // no two alike
        box.run({.steps = 1, .dt = step});
        t += step;
        const auto hash = box.state_hash();
        EXPECT_NEAR(box.energy().internal, t, 1e-12) << "after step " << n; // of two copies, half of each
        EXPECT_EQ(box.state_hash(), hash);
        const auto pairs = box.system().template kept_of_pairs<0, 0>();
        const double kept = pairs.empty() ? 0 : pairs[0].value[0]; // zero is not listed
        EXPECT_NEAR(kept + box.system().memory_age(), t, 1e-12);
    }
}
TEST(PairMemory, DiesWithTheContactAndIsBornAtZero)
{
    auto box = crowd(Serial{});
    auto move = [&](double x) { // within the list, so that no rebuild forgets the pair
        box.particles().put(position, index_of(box, 1), {x, 0.5});
    };
    box.run({.steps = 5, .dt = dt});
    EXPECT_NEAR(push_on(box, 1), 5, 1e-9);
    move(0.5 + 2.1 * r);
    box.run({.steps = 1, .dt = dt});
    EXPECT_EQ(push_on(box, 1), 0);
    move(0.5 + 1.5 * r);
    box.run({.steps = 1, .dt = dt});
    EXPECT_NEAR(push_on(box, 1), 1, 1e-9);
}
TEST(PairMemory, DoesNotDependOnThreadsCellsOrPacks)
{
    auto one = crowd(Serial{.cell = 16});
    auto two = crowd(Threads{.count = 3, .cell = 2});
    one.run({.steps = 150, .dt = dt});
    two.run({.steps = 150, .dt = dt});
    EXPECT_EQ(one.state_hash(), two.state_hash());
}
TEST(PairMemory, SurvivesThatOthersComeAndGo)
{
    auto box = crowd(Serial{});
    for (int n = 1; n <= 120; ++n) {
        if (n % 3 == 0) box.remove([&](auto const& p, std::size_t i) { return p.id()[i] == std::uint32_t(1 + n / 3); });
        if (n % 5 == 0) {
            auto more = box.newcomers();
            box.append(more, {0.9, 0.02 + 0.008 * n}, {1, 0});
            box.enter(more);
        }
        if (n % 7 == 0) box.add({0.7, 0.02 + 0.008 * n}, {-1, 0});
        box.run({.steps = 1, .dt = dt});
        ASSERT_NEAR(push_on(box, 0), -n, 1e-9 * n) << "after step " << n;
    }
    EXPECT_EQ(box.exchanged().left.particles, 40);
}
// Of many that were, few are left: their ids lie far apart.
TEST(PairMemory, IsFoundWhereIdsAreFewAmongMany)
{
    auto box = crowd(Serial{});
    box.add({0.2, 0.8});
    for (int k = 0; k < 3000; ++k) box.add({0.02 + 0.0003 * k, 0.9});
    const auto last = std::uint32_t(box.particles().size());
    box.add({0.2 + 1.5 * r, 0.8});
    box.remove([&](auto const& p, std::size_t i) { return p.id()[i] > 42 && p.id()[i] < last; });
    ASSERT_EQ(box.particles().size(), 44u);
    for (int n = 1; n <= 120; ++n) {
        box.run({.steps = 1, .dt = dt});
        ASSERT_NEAR(push_on(box, 42), -n, 1e-9 * n) << "after step " << n;
        ASSERT_NEAR(push_on(box, last), n, 1e-9 * n) << "after step " << n;
    }
    EXPECT_GT(box.system().rebuilds(), 5);
}
TEST(PairMemory, OfAGrainThatLeavesIsForgotten)
{
    auto box = crowd(Serial{});
    box.run({.steps = 5, .dt = dt});
    auto pairs = [&] { return box.system().template kept_of_pairs<0, 0>(); };
    const auto of_1 = [](auto const& pair) { return pair.i == 1 || pair.j == 1; };
    auto count = [&] {
        const auto all = pairs();
        return std::count_if(all.begin(), all.end(), of_1);
    };
    ASSERT_EQ(count(), 2);
    const auto all = pairs().size();
    box.remove([](auto const& p, std::size_t i) { return p.id()[i] == 1; });
    EXPECT_EQ(count(), 0);
    EXPECT_EQ(pairs().size(), all - 2); // those of others are still known before lists are built again
    box.run({.steps = 1, .dt = dt});
    EXPECT_EQ(count(), 0);
    EXPECT_EQ(push_on(box, 0), 0);
}
// Lists that are thrown away by hand, twice: what is kept is neither lost nor as it was when they were built.
TEST(PairMemory, IsThatOfNowAfterListsWereForgotten)
{
    auto box = crowd(Serial{});
    for (int n = 1; n <= 12; ++n) {
        box.run({.steps = 1, .dt = dt});
        ASSERT_NEAR(push_on(box, 0), -n, 1e-9 * n) << "after step " << n;
        if (n % 3 == 0) box.prepare(), box.prepare();
    }
}
} // namespace
