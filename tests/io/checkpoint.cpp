// SPDX-License-Identifier: BSD-3-Clause
// A run that goes on from a checkpoint has the bits of one that was never interrupted, on whatever backend.
#include "spate/io/checkpoint.hpp"

#include "backend/scenes_of_ranks.hpp"
#include "io/small_tank.hpp"

namespace {

using namespace spate;

class CheckpointTest : public small_tank::InFolder {
protected:
    /// The state as a file holds it.
    io::State through_a_file(io::State const& state) const
    {
        const auto file = folder / "state.h5";
        io::write_checkpoint(file, state);
        return io::read_checkpoint(file);
    }
    /// Goes on from each of `cuts` steps with a scene of `make` and from there in pieces; the run without a break is `whole`.
    void goes_on(auto&& make, auto& whole, std::int64_t steps, std::vector<std::int64_t> const& cuts) const
    {
        std::vector<io::State> states;
        for (const auto cut : cuts) {
            whole.run({.steps = cut - whole.steps(), .cfl = 0.2});
            states.push_back(through_a_file(io::state_of(whole)));
        }
        whole.run({.steps = steps - whole.steps(), .cfl = 0.2});
        for (std::size_t k = 0; k < cuts.size(); ++k) {
            auto again = make();
            io::resume(again, states[k]);
            ASSERT_EQ(again.steps(), cuts[k]);
            EXPECT_EQ(through_a_file(io::state_of(again)).tables, states[k].tables); // nothing is lost
            forget_what_is_made_anew(again);
            again.run({.steps = steps - cuts[k], .cfl = 0.2});
            EXPECT_EQ(again.state_hash(), whole.state_hash()) << "from step " << cuts[k];
            EXPECT_EQ(again.time(), whole.time());
            EXPECT_EQ(again.system().rebuilds(), whole.system().rebuilds());
            EXPECT_EQ(again.system().pairs_evaluated(), whole.system().pairs_evaluated());
            EXPECT_EQ(again.report().energy_rise, whole.report().energy_rise);
        }
    }
    /// What a checkpoint leaves out must have no say: NaN would show.
    template <class Scene>
    static void forget_what_is_made_anew(Scene& scene)
    {
        using M = typename Scene::Engine::M;
        scene.system().each_species([&](auto s) {
            auto& p = scene.system().template species<s()>().particles;
            for_each(p.fields - M::template lasting<s()>(), [&](auto f) {
                for (auto& column : p.column(f)) std::fill(column.begin(), column.end(), std::nan(""));
            });
        });
    }
};

template <class Precision = Double, class Backend>
auto dam(Backend backend)
{
    return ranked::column<Precision>(backend);
}

TEST_F(CheckpointTest, OfADamBreakGoesOnWithTheSameBitsOnAnyBackend)
{
    auto serial = dam(Serial{});
    goes_on([] { return dam(Threads{.count = 3, .cell = 2}); }, serial, 1200, {1, 420, 811, 990});
    EXPECT_GE(serial.system().rebuilds(), 20);
    auto threads = dam(Threads{.count = 2});
    goes_on([] { return dam(Serial{.cell = 5}); }, threads, 1200, {613, 1001});
    EXPECT_EQ(threads.state_hash(), serial.state_hash());
}
TEST_F(CheckpointTest, OfADamBreakInFloatGoesOnWithTheSameBits)
{
    auto whole = dam<Float>(Threads{.count = 2});
    goes_on([] { return dam<Float>(Threads{.count = 3, .cell = 1}); }, whole, 900, {300, 777});
    EXPECT_GE(whole.system().rebuilds(), 20);
}
TEST_F(CheckpointTest, OfARestartGoesOnToo)
{
    auto whole = dam(Serial{});
    whole.run({.steps = 700, .cfl = 0.2});
    io::State state;
    for (std::int64_t n = 0; n < 700; n += 100) {
        auto part = dam(Serial{});
        if (n > 0) io::resume(part, state);
        part.run({.steps = 100, .cfl = 0.2});
        state = through_a_file(io::state_of(part));
        if (n == 600) {
            EXPECT_EQ(part.state_hash(), whole.state_hash());
        }
    }
}

inline constexpr struct Age : ScalarField {
    static constexpr std::string_view name = "age", unit = "1";
} age{};
inline constexpr struct Rub : VectorField {
    static constexpr std::string_view name = "rub", unit = "m/s^2";
} rub{};
/// A push that grows while a contact lives, and turns with it: the state depends on the whole history of each pair.
struct GrowingPush {
    static constexpr Fields adds{acceleration};
    static constexpr Fields keeps{age, rub};
    double unit; ///< [m/s^2]
    void operator()(auto& i, auto const&, auto const& ij) const
    {
        i[age] += 1;
        i[rub] += unit * ij.n;
        const auto kept = i[rub];
        i[acceleration] += (unit * i[age]) * ij.n + kept;
    }
};
/// Discs between elastic walls that bounce off each other.
template <class Backend>
auto discs(Backend backend)
{
    constexpr int side = 16;
    constexpr double r = 0.01, pitch = 2.2 * r;
    Simulation sim(dem<2>({.mass = 0.1, .radius = r}, LinearSpring{.k = 1e4}, GrowingPush{1e-3}), SymplecticEuler{},
                   Walls{Box<2>{{}, {{side * pitch, side * pitch}}}}, backend, Double{}, NoWatch{});
    for (int n = 0; n < side * side; ++n) { // no two alike, and the same with every library
        const double a = (n * 7919 % 1009) / 504.5 - 1, b = (n * 104729 % 997) / 498.5 - 1;
        sim.add({{(n % side + 0.5) * pitch, (n / side + 0.5) * pitch}}, {{a, b}});
    }
    return sim;
}
TEST_F(CheckpointTest, OfDiscsBetweenWallsKeepsTheHistoryOfTheirContacts)
{
    auto one = discs(Threads{.count = 1});
    goes_on([] { return discs(Threads{.count = 2, .cell = 2}); }, one, 1500, {700, 1203});
    EXPECT_GE(one.system().rebuilds(), 20);
    auto threads = discs(Threads{.count = 2});
    goes_on([] { return discs(Threads{.count = 1, .cell = 3}); }, threads, 1500, {999});
    const auto state = io::state_of(threads);
    EXPECT_GT(state.table<std::uint32_t>("pairs_0_0/ids", 2).size(), 20u);
    EXPECT_EQ(threads.state_hash(), one.state_hash());
}
/// What the test above can see: neighbours in another order, contacts without their past.
TEST_F(CheckpointTest, GoesOnWithOtherBitsIfListsAreThoseOfNowOrContactsAreForgotten)
{
    auto whole = discs(Threads{.count = 1});
    whole.run({.steps = 700, .cfl = 0.2});
    const io::State state = io::state_of(whole);
    whole.run({.steps = 800, .cfl = 0.2});
    auto hash = [](io::State const& s) {
        auto again = discs(Threads{.count = 1});
        io::resume(again, s);
        again.run({.steps = 800, .cfl = 0.2});
        return again.state_hash();
    };
    EXPECT_EQ(hash(state), whole.state_hash());
    io::State now = state;
    now.tables["species_0/build_position"] = now.tables["species_0/position"];
    EXPECT_NE(hash(now), whole.state_hash());
    io::State born = state;
    born.put("pairs_0_0/ids", std::vector<std::uint32_t>{}, 2);
    born.put("pairs_0_0/value", std::vector<double>{}, 3);
    EXPECT_NE(hash(born), whole.state_hash());
}

/// A stirrer in a channel that is periodic along x: images, markers that move, a transport velocity, a scheme that begins
/// with the accelerations of the step before.
auto stirred(int cell)
{
    constexpr double dx = 0.05;
    auto fluid = wcsph(WendlandC2<2>{.h = 1.5 * dx}, LinearEos{.rho0 = 1, .c0 = 20}, Continuity<1>{},
                       PressureForce<1>{}, LaminarViscosity{.mu = 0.02}, Xsph{.eps = 0.3});
    Bce channel(Box<2>{{}, {{1, 1}}}, dx, Adami{}, periodic(0), no_slip,
                obstacle(Box<2>{{{0.4, 0.4}}, {{0.6, 0.6}}}, Rotation<2>{.centre = {{0.5, 0.5}}, .omega = 3}));
    Simulation sim(fluid, Leapfrog{}, channel, Serial{.cell = cell});
    sim.fill(Box<2>{{}, {{1, 1}}}, dx);
    return sim;
}
TEST_F(CheckpointTest, OfAStirredChannelGoesOnWithTheSameBits)
{
    auto whole = stirred(0);
    goes_on([] { return stirred(2); }, whole, 600, {233, 401});
    EXPECT_GE(whole.system().rebuilds(), 5);
}

TEST_F(CheckpointTest, HoldsWhatNoEvaluationMakesAnew)
{
    using Dam = decltype(dam(Serial{}))::Engine::M;
    EXPECT_EQ(to_string(Dam::lasting<0>()), "position velocity density acceleration build_position");
    EXPECT_EQ(to_string(Dam::lasting<1>()), "position density");
    using Grains = decltype(discs(Threads{}))::Engine::M;
    EXPECT_EQ(to_string(Grains::lasting<0>()), "position velocity acceleration build_position");
}
TEST_F(CheckpointTest, IsTheSameFileWhoeverRanTheScene)
{
    auto one = dam(Serial{.cell = 7});
    auto two = dam(Threads{.count = 3, .cell = 2});
    one.run({.steps = 150, .cfl = 0.2});
    two.run({.steps = 150, .cfl = 0.2});
    auto a = io::state_of(one), b = io::state_of(two);
    for (auto* clock : {"run/wall_s", "run/cpu_s"}) a.tables.erase(clock), b.tables.erase(clock);
    EXPECT_EQ(a.tables, b.tables);
    EXPECT_EQ(a.texts, b.texts);
    io::write_checkpoint(folder / "a.h5", a);
    io::write_checkpoint(folder / "b.h5", b);
    EXPECT_EQ(content(folder / "a.h5"), content(folder / "b.h5"));
}

} // namespace
