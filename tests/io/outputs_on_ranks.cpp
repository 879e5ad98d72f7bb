// SPDX-License-Identifier: BSD-3-Clause
// What a run leaves in a folder does not depend on ranks: rows, snapshots and checkpoints, also of a run that one rank ends.
#include "spate/io/checkpoint.hpp"

#include "io/small_tank.hpp"
#include "spate/backend/virtual_ranks.hpp"
#include "spate/io/history.hpp"
#include "spate/io/snapshots.hpp"
#include "spate/measure/wall_force.hpp"

#include <gmock/gmock.h>

namespace {

using namespace spate;
using testing::HasSubstr;

constexpr double dt = 1 / 2048.0;
constexpr std::int64_t steps = 43;

class OutputsOnRanks : public small_tank::InFolder {
protected:
    struct Outputs {
        Outputs(std::filesystem::path const& folder, io::Keep keep)
            : history(folder, 2.5 * dt, WallForce{}), snapshots(folder, "tank", 7.5 * dt),
              checkpoints(folder, keep, history, snapshots)
        {}
        io::History<WallForce> history;
        io::Snapshots snapshots;
        io::Checkpoints<io::History<WallForce>, io::Snapshots> checkpoints;
        void run(auto& scene, std::int64_t n) { scene.run({.steps = n, .dt = dt}, history, snapshots, checkpoints); }
    };
    void SetUp() override
    {
        InFolder::SetUp();
        for (auto* name : {"whole", "ranks"}) std::filesystem::create_directories(folder / name);
        auto whole = small_tank::scene();
        Outputs(folder / "whole", {}).run(whole, steps);
    }
    /// f(backend) on so many ranks.
    static void on(int ranks, auto const& f)
    {
        VirtualRanks(ranks).run([&](auto rank) { f(OnRank{rank, Serial{}, 1}); });
    }
    void expect_files_of_one() const
    {
        for (auto* name : {"history.csv", "tank.hdf.series", "tank_000000.hdf", "tank_000003.hdf", "tank_000006.hdf"}) {
            EXPECT_EQ(content(folder / "whole" / name), content(folder / "ranks" / name)) << name;
            EXPECT_FALSE(content(folder / "whole" / name).empty()) << name;
        }
    }
};

TEST_F(OutputsOnRanks, AreThoseOfOne)
{
    on(5, [&](auto backend) {
        auto scene = small_tank::scene(backend);
        Outputs(folder / "ranks", {}).run(scene, steps);
    });
    expect_files_of_one();
}
TEST_F(OutputsOnRanks, GoOnAfterOneRankWasInterruptedAndOnAnotherNumber)
{
    on(4, [&](auto backend) {
        auto scene = small_tank::scene(backend);
        scene.interrupt_when([&] { return backend.rank.rank() == 2 && scene.steps() == 16; });
        Outputs o(folder / "ranks", {});
        o.run(scene, steps);
        EXPECT_EQ(scene.steps(), 16);
        EXPECT_EQ(o.checkpoints.last(), folder / "ranks" / "checkpoint_16.h5");
    });
    on(3, [&](auto backend) {
        auto scene = small_tank::scene(backend);
        Outputs o(folder / "ranks", {.steps = 11});
        o.checkpoints.restart(scene, folder / "ranks" / "checkpoint_16.h5");
        o.run(scene, steps - 16);
    });
    expect_files_of_one();
    std::vector<std::string> left;
    for (auto const& entry : std::filesystem::directory_iterator(folder / "ranks"))
        if (entry.path().extension() == ".h5") left.push_back(entry.path().filename());
    EXPECT_THAT(left, testing::UnorderedElementsAre("checkpoint_33.h5", "checkpoint_43.h5")); // the last two
}
TEST_F(OutputsOnRanks, ComeByTheClockOfWhoeverIsFirst)
{
    on(3, [&](auto backend) { // rank 1 alone finds that time is up
        auto scene = small_tank::scene(backend);
        io::Checkpoints checkpoints(folder / "ranks", {.wall = backend.rank.rank() == 1 ? 1e-9 : 1e9});
        scene.run({.steps = 4, .dt = dt}, checkpoints);
        EXPECT_EQ(checkpoints.last(), folder / "ranks" / "checkpoint_4.h5");
    });
}
/// Makes a velocity infinite after a step, on the rank that has the particle.
struct Saboteur {
    std::int64_t at;
    void begin(auto&) const {}
    void step(auto& scene) const
    {
        auto& p = scene.particles();
        for (std::size_t i = 0; i < p.size() && scene.steps() == at; ++i)
            if (p.id()[i] == 7) p.column(velocity)[0][i] = std::numeric_limits<double>::infinity();
    }
    void end(auto&) const {}
};
TEST_F(OutputsOnRanks, OfARunThatStopsAreAGoodStateAndTheFailingOneOfAllRanks)
{
    on(3, [&](auto backend) {
        auto scene = small_tank::scene(backend);
        io::Checkpoints checkpoints(folder / "ranks", {.recorder = 10});
        std::string said;
        try {
            scene.run({.steps = 50, .dt = dt}, Saboteur{27}, checkpoints);
        }
        catch (NonFinite const& stop) {
            said = stop.what();
        }
        EXPECT_THAT(said, HasSubstr("the last good state is " + (folder / "ranks" / "checkpoint_20.h5").string()));
        EXPECT_THAT(said, HasSubstr("the failing one " + (folder / "ranks" / "failing_27.h5").string()));
    });
    const auto failing = io::read_checkpoint(folder / "ranks" / "failing_27.h5");
    auto const& v = failing.table<double>("species_0/velocity", 2);
    EXPECT_EQ(v.size(), 2 * small_tank::scene().particles().size());
    EXPECT_EQ(std::count_if(v.begin(), v.end(), [](double x) { return std::isinf(x); }), 1);
    auto again = small_tank::scene(), whole = small_tank::scene();
    io::resume(again, io::read_checkpoint(folder / "ranks" / "checkpoint_20.h5"));
    again.run({.steps = 30, .dt = dt});
    whole.run({.steps = 50, .dt = dt});
    EXPECT_EQ(again.state_hash(), whole.state_hash());
}
TEST_F(OutputsOnRanks, ThatCannotBeWrittenOrReadEndAllRanksWithOneError)
{
    on(3, [&](auto backend) {
        auto scene = small_tank::scene(backend);
        io::Checkpoints nowhere(folder / "not_there", {.steps = 1});
        if (backend.rank.rank() == 0) EXPECT_THROW(scene.run({.steps = 2, .dt = dt}, nowhere), OutputError);
        else EXPECT_THROW(scene.run({.steps = 2, .dt = dt}, nowhere), OtherRankFailed);
    });
    std::ofstream(folder / "foreign.h5") << "something else";
    on(3, [&](auto backend) {
        auto scene = small_tank::scene(backend);
        io::Checkpoints checkpoints(folder, {});
        const auto before = scene.state_hash();
        try {
            checkpoints.restart(scene, folder / "foreign.h5");
            ADD_FAILURE() << "taken";
        }
        catch (BadInput const& e) {
            EXPECT_THAT(e.what(), HasSubstr("foreign.h5 is no checkpoint"));
        }
        EXPECT_EQ(scene.state_hash(), before);
        scene.run({.steps = 5, .dt = dt}); // and nobody waits
    });
}

} // namespace
