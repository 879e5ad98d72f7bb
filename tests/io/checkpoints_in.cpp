// SPDX-License-Identifier: BSD-3-Clause
// Checkpoints come when they are due, the last two stay, outputs go on as if nothing had been, and a stop leaves a good state.
#include "spate/io/checkpoint.hpp"

#include <csignal>
#include <cstdio>
#include <map>
#include <set>
#include <sys/wait.h>
#include <unistd.h>

#include "io/small_tank.hpp"
#include "spate/io/history.hpp"
#include "spate/io/snapshots.hpp"
#include "spate/measure/wall_force.hpp"

#include <gmock/gmock.h>

namespace {

using namespace spate;
using testing::HasSubstr;

class CheckpointsTest : public small_tank::InFolder {
protected:
    std::set<std::string> files() const
    {
        std::set<std::string> names;
        for (auto const& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename());
        return names;
    }
    using Names = std::set<std::string>;
};

constexpr double dt = 1 / 2048.0;

TEST_F(CheckpointsTest, ComeEveryFewStepsAndTheLastTwoStay)
{
    auto tank = small_tank::scene();
    io::Checkpoints checkpoints(folder, {.steps = 3});
    std::ofstream(folder / "checkpoint_77.h5.tmp") << "half a file";
    tank.run({.steps = 11, .dt = dt}, checkpoints);
    EXPECT_EQ(files(), (Names{"checkpoint_9.h5", "checkpoint_11.h5"})); // the last state too
    EXPECT_EQ(checkpoints.last(), folder / "checkpoint_11.h5");
    EXPECT_EQ(io::read_checkpoint(folder / "checkpoint_9.h5").one<std::int64_t>("run/step"), 9);
}
TEST_F(CheckpointsTest, ComeByTheClock)
{
    auto tank = small_tank::scene();
    io::Checkpoints checkpoints(folder, {.wall = 1e-9});
    tank.run({.steps = 4, .dt = dt}, checkpoints);
    EXPECT_EQ(files(), (Names{"checkpoint_3.h5", "checkpoint_4.h5"}));
}
TEST_F(CheckpointsTest, AreNotTakenOfAStepThatWasCutToEnd)
{
    auto tank = small_tank::scene();
    io::Checkpoints checkpoints(folder, {.steps = 1});
    tank.run({.until = 3.5 * dt, .dt = dt}, checkpoints);
    EXPECT_EQ(tank.steps(), 4);
    EXPECT_EQ(files(), (Names{"checkpoint_2.h5", "checkpoint_3.h5"}));
}
TEST_F(CheckpointsTest, AreLeftByARunThatIsInterruptedOnly)
{
    auto tank = small_tank::scene();
    io::Checkpoints checkpoints(folder, {});
    tank.run({.steps = 4, .dt = dt}, checkpoints);
    EXPECT_EQ(files(), Names{});
    tank.interrupt_when([&] { return tank.steps() == 6; });
    tank.run({.steps = 4, .dt = dt}, checkpoints);
    EXPECT_EQ(files(), Names{"checkpoint_6.h5"});
}
TEST_F(CheckpointsTest, RefuseWhatMakesNoSense)
{
    EXPECT_THROW(io::Checkpoints(folder, {.steps = -1}), BadInput);
    EXPECT_THROW(io::Checkpoints(folder, {.wall = -1}), BadInput);
    EXPECT_THROW(io::Checkpoints(folder, {.wall = std::nan("")}), BadInput);
    auto tank = small_tank::scene();
    io::Checkpoints nowhere(folder / "not_there", {.steps = 1});
    EXPECT_THROW(tank.run({.steps = 2, .dt = dt}, nowhere), OutputError);
}

TEST(Every, GoesOnWithTheIntervalThatItHasNow)
{
    io::detail::Every before(0.1), same(0.1), other(0.25);
    EXPECT_TRUE(before.due(0.35)); // for 0.3
    std::map<std::string, double> notes;
    before.notes("e", [&](std::string const& name, double& value) { notes[name] = value; });
    auto recall = [&](std::string const& name, double& value) { value = notes.at(name); };
    same.notes("e", recall), other.notes("e", recall);
    EXPECT_FALSE(same.due(0.39));
    EXPECT_TRUE(same.due(0.4));
    EXPECT_FALSE(other.due(0.45));
    EXPECT_TRUE(other.due(0.5));
}

/// What a run leaves in a folder: in one piece, or interrupted at some steps and continued.
class ContinuedTest : public CheckpointsTest {
protected:
    struct Outputs {
        explicit Outputs(std::filesystem::path const& folder, io::Keep keep)
            : history(folder, 2.5 * dt, WallForce{}), snapshots(folder, "tank", 7.5 * dt),
              checkpoints(folder, keep, history, snapshots)
        {}
        io::History<WallForce> history;
        io::Snapshots snapshots;
        io::Checkpoints<io::History<WallForce>, io::Snapshots> checkpoints;

        void run(auto& scene, RunOptions const& o) { scene.run(o, history, snapshots, checkpoints); }
    };
    std::filesystem::path in(std::string const& name) const
    {
        std::filesystem::create_directories(folder / name);
        return folder / name;
    }
    void expect_the_same_files(std::string const& a, std::string const& b) const
    {
        for (auto* name : {"history.csv", "tank.hdf.series", "tank_000000.hdf", "tank_000003.hdf", "tank_000005.hdf"})
            EXPECT_EQ(content(folder / a / name), content(folder / b / name)) << name;
        EXPECT_FALSE(content(folder / a / "history.csv").empty());
        EXPECT_FALSE(content(folder / a / "tank_000005.hdf").empty());
    }
    static constexpr std::int64_t steps = 43;
};
TEST_F(ContinuedTest, AfterAnInterruptionHasNoGapAndNoDoubleRow)
{
    auto whole = small_tank::scene();
    Outputs(in("whole"), {}).run(whole, {.steps = steps, .dt = dt});
    for (std::int64_t cut : {1, 14, 15, 16, 38}) { // also where a row or a snapshot is due
        auto first = small_tank::scene();
        first.interrupt_when([&] { return first.steps() == cut; });
        Outputs before(in("cut"), {});
        before.run(first, {.steps = steps, .dt = dt});
        EXPECT_EQ(first.steps(), cut);
        auto second = small_tank::scene();
        Outputs after(in("cut"), {});
        after.checkpoints.restart(second, before.checkpoints.last());
        after.run(second, {.steps = steps - cut, .dt = dt});
        EXPECT_EQ(second.state_hash(), whole.state_hash());
        EXPECT_EQ(after.snapshots.count(), 7u);
        expect_the_same_files("whole", "cut");
    }
}
struct KilledAt {
    std::int64_t at;
    void begin(auto&) const {}
    void step(auto& scene) const
    {
        if (scene.steps() == at) throw std::runtime_error("killed");
    }
    void end(auto&) const {}
};
TEST_F(ContinuedTest, AfterItWasKilledHasNoGapAndNoDoubleRow)
{
    auto whole = small_tank::scene();
    Outputs(in("whole"), {}).run(whole, {.steps = steps, .dt = dt});
    {
        auto first = small_tank::scene();
        Outputs o(in("killed"), {.steps = 11});
        EXPECT_THROW(first.run({.steps = steps, .dt = dt}, o.history, o.snapshots, o.checkpoints, KilledAt{32}),
                     std::runtime_error);
    }
    auto second = small_tank::scene();
    Outputs o(in("killed"), {.steps = 11});
    o.checkpoints.restart(second, folder / "killed" / "checkpoint_22.h5"); // 8 steps and 4 rows before the end
    o.run(second, {.steps = steps - 22, .dt = dt});
    expect_the_same_files("whole", "killed");
    EXPECT_FALSE(std::filesystem::exists(folder / "killed" / "checkpoint_22.h5"));
    EXPECT_TRUE(std::filesystem::exists(folder / "killed" / "checkpoint_33.h5"));
}
/// Tells a pipe that the run has begun.
struct Begun {
    int pipe;
    void begin(auto&) const
    {
        if (pipe >= 0 && ::write(pipe, "b", 1) != 1) throw std::runtime_error("no pipe");
    }
    void step(auto&) const {}
    void end(auto&) const {}
};
/// A run that is killed again and again, while it computes or writes, goes on from a whole file each time.
TEST_F(ContinuedTest, AfterFiftyKillsAtAnyMomentGoesOnFromAWholeFile)
{
    in("killed");
    auto newest = [&] {
        std::int64_t step = -1;
        for (auto const& entry : std::filesystem::directory_iterator(folder / "killed")) {
            const std::string name = entry.path().filename();
            long long n = -1;
            if (std::sscanf(name.c_str(), "checkpoint_%lld", &n) != 1 || name.rfind(".h5") != name.size() - 3) continue;
            EXPECT_EQ(io::read_checkpoint(entry.path()).one<std::int64_t>("run/step"), n); // each is whole
            step = std::max(step, std::int64_t(n));
        }
        return step;
    };
    auto go_on = [&](auto& scene, std::int64_t from, RunOptions const& how, std::int64_t every, int told) {
        Outputs o(folder / "killed", {.steps = every});
        if (from >= 0) o.checkpoints.restart(scene, folder / "killed" / ("checkpoint_" + std::to_string(from) + ".h5"));
        scene.run(how, o.history, o.snapshots, o.checkpoints, Begun{told});
    };
    std::uint64_t dice = 5; // a linear congruence (Knuth): any moments will do
    std::int64_t from = -1;
    int moved = 0, kills = 0;
    for (; kills < 50 || (moved < 10 && kills < 200); ++kills) {
        int ends[2];
        ASSERT_EQ(::pipe(ends), 0);
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            try {
                auto scene = small_tank::scene();
                go_on(scene, from, {.steps = 1'000'000, .dt = dt}, 1, ends[1]); // most of the time goes into files
            }
            catch (std::exception const& e) {
                std::fputs(e.what(), stderr);
            }
            ::_exit(1);
        }
        ::close(ends[1]);
        char begun = 0;
        if (kills % 4 != 0) {
            ASSERT_EQ(::read(ends[0], &begun, 1), 1);
        } // else perhaps while it sets up
        ::close(ends[0]);
        dice = dice * 6364136223846793005u + 1442695040888963407u;
        ::usleep(useconds_t((dice >> 33) % 120'000));
        ::kill(child, SIGKILL);
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status));
        const auto now = newest();
        EXPECT_GE(now, from); // none is lost
        moved += now > from;
        from = now;
    }
    EXPECT_GE(moved, 10);
    auto last = small_tank::scene(), whole = small_tank::scene();
    go_on(last, from, {.steps = 20, .dt = dt}, 7, -1);
    Outputs(in("whole"), {}).run(whole, {.steps = last.steps(), .dt = dt});
    EXPECT_EQ(last.state_hash(), whole.state_hash());
    EXPECT_EQ(content(folder / "killed" / "history.csv"), content(folder / "whole" / "history.csv"));
    EXPECT_EQ(content(folder / "killed" / "tank.hdf.series"), content(folder / "whole" / "tank.hdf.series"));
    for (auto const& entry : std::filesystem::directory_iterator(folder / "killed"))
        EXPECT_NE(entry.path().extension(), ".tmp") << entry.path(); // what a kill has left is gone
}
TEST_F(ContinuedTest, InAnotherFolderHasTheRowsFromThere)
{
    auto first = small_tank::scene();
    Outputs before(in("before"), {.steps = 20});
    before.run(first, {.steps = 20, .dt = dt});
    auto second = small_tank::scene();
    Outputs after(in("after"), {});
    after.checkpoints.restart(second, before.checkpoints.last());
    after.run(second, {.steps = 5, .dt = dt});
    std::istringstream rows(content(folder / "after" / "history.csv"));
    std::string line;
    std::getline(rows, line);
    EXPECT_EQ(line.rfind("step,t,", 0), 0u);
    std::getline(rows, line);
    EXPECT_EQ(line.rfind("23,", 0), 0u) << line;                     // the first step after 22.5 dt
    EXPECT_TRUE(std::filesystem::exists(before.checkpoints.last())); // not ours to remove
}
TEST_F(ContinuedTest, WithAnotherStepIsTold)
{
    auto first = small_tank::scene();
    first.run({.steps = 5, .cfl = 0.2});
    const auto state = io::state_of(first);
    auto second = small_tank::scene();
    io::resume(second, state);
    second.run({.steps = 1, .cfl = 0.2});
    EXPECT_EQ(second.report().warnings, first.report().warnings);
    io::resume(second, state);
    second.run({.steps = 1, .cfl = 0.1});
    EXPECT_EQ(second.report().warnings.size(), first.report().warnings.size() + 1);
}

/// Makes a velocity infinite after a step.
struct Saboteur {
    std::int64_t at;
    void begin(auto&) const {}
    void step(auto& scene) const
    {
        if (scene.steps() == at) scene.particles().column(velocity)[0][7] = std::numeric_limits<double>::infinity();
    }
    void end(auto&) const {}
};
TEST_F(CheckpointsTest, OfARunThatStopsAreAGoodStateAndTheFailingOne)
{
    auto tank = small_tank::scene();
    io::Checkpoints checkpoints(folder, {.recorder = 10});
    std::string said;
    try {
        tank.run({.steps = 50, .dt = dt}, Saboteur{27}, checkpoints);
    }
    catch (NonFinite const& stop) {
        said = stop.what();
    }
    EXPECT_THAT(said, HasSubstr("the last good state is " + (folder / "checkpoint_20.h5").string()));
    EXPECT_THAT(said, HasSubstr("the failing one " + (folder / "failing_27.h5").string()));
    EXPECT_EQ(files(), (Names{"checkpoint_10.h5", "checkpoint_20.h5", "failing_27.h5"}));

    auto again = small_tank::scene();
    const auto failing = io::read_checkpoint(folder / "failing_27.h5");
    EXPECT_THROW(io::resume(again, failing), BadInput);
    EXPECT_TRUE(failing.has("species_0/pressure")); // all there is, to look at
    const auto& v = failing.table<double>("species_0/velocity", 2);
    EXPECT_EQ(std::count_if(v.begin(), v.end(), [](double x) { return std::isinf(x); }), 1);

    io::resume(again, io::read_checkpoint(folder / "checkpoint_20.h5"));
    again.run({.steps = 30, .dt = dt});
    auto whole = small_tank::scene();
    whole.run({.steps = 50, .dt = dt});
    EXPECT_EQ(again.state_hash(), whole.state_hash());
}
TEST_F(CheckpointsTest, AreNotTakenOfAStateThatIsNotFinite)
{
    auto tank = small_tank::scene();
    io::Checkpoints checkpoints(folder, {.steps = 9});
    EXPECT_THROW(tank.run({.steps = 50, .dt = dt}, Saboteur{27}, checkpoints), NonFinite); // seen in step 28
    EXPECT_EQ(files(), (Names{"checkpoint_9.h5", "checkpoint_18.h5", "failing_27.h5"}));
}

} // namespace
