// SPDX-License-Identifier: BSD-3-Clause
// A checkpoint knows nothing of ranks: written by any number of them, it is gone on from by any other with the same bits.
#include "spate/io/checkpoint.hpp"

#include "io/scenes_that_go_on.hpp"
#include "io/small_tank.hpp"
#include "spate/backend/virtual_ranks.hpp"

#include <gmock/gmock.h>

namespace {

using namespace spate;
using going_on::End;
using going_on::expect_the_same;

struct How {
    int ranks, cell = 2;
    Balance balance = {};
};
/// The end as rank 0 sees it; ranks agree on all but the state.
template <class Case>
End on(How how, std::int64_t n, io::State const* from = nullptr)
{
    if (how.ranks == 0) return going_on::run<Case>(Serial{.cell = how.cell}, n, from);
    std::vector<End> ends(std::size_t(how.ranks), End{});
    const io::State nothing;
    VirtualRanks(how.ranks).run([&](auto rank) {
        io::State const* mine = from && rank.rank() != 0 ? &nothing : from; // what others have has no say
        ends[std::size_t(rank.rank())] = going_on::run<Case>(OnRank{rank, Serial{}, how.cell, how.balance}, n, mine);
    });
    for (auto const& end : ends) expect_the_same(end, ends[0], "on another rank");
    return ends[0];
}
class CheckpointOnRanks : public small_tank::InFolder {
protected:
    io::State through_a_file(io::State const& state) const
    {
        io::write_checkpoint(folder / "state.h5", state);
        return io::read_checkpoint(folder / "state.h5");
    }
    /// \param ways  before and after the checkpoint; 0 ranks: one, that knows of no others
    template <class Case>
    void goes_on(std::vector<std::pair<How, How>> const& ways, std::int64_t cut) const
    {
        const End half = on<Case>({0}, cut), whole = on<Case>({0}, Case::steps);
        EXPECT_GE(whole.rebuilds, Case::rebuilds);
        for (auto const& [before, after] : ways) {
            const std::string where = std::to_string(before.ranks) + " ranks, then " + std::to_string(after.ranks);
            const End first = on<Case>(before, cut);
            expect_the_same(first, half, where);
            EXPECT_THAT(going_on::differences(first.state, half.state), testing::IsEmpty()) << where;
            const io::State state = through_a_file(first.state);
            const End again = on<Case>(after, Case::steps - cut, &state);
            expect_the_same(again, whole, where);
            EXPECT_THAT(going_on::differences(again.state, whole.state), testing::IsEmpty()) << where;
        }
    }
};

io::State with_lists_of_now(io::State state)
{
    state.tables["species_0/build_position"] = state.tables["species_0/position"];
    return state;
}
/// A cut of the grains' run after which lists of now instead of those of then lead to other bits on two ranks: where one is
/// depends on how fast they close in.
int telling_cut()
{
    using going_on::Hopper;
    for (int cut = 1236; cut < 1300; cut += 3) {
        const io::State state = on<Hopper>({0}, cut).state, of_now = with_lists_of_now(state);
        const std::int64_t rest = Hopper::steps - cut;
        if (on<Hopper>({2}, rest, &of_now).hash != on<Hopper>({2}, rest, &state).hash) return cut;
    }
    ADD_FAILURE() << "at no cut do lists of now lead to other bits";
    return 1236;
}

TEST_F(CheckpointOnRanks, OfADamBreakGoesOnWithTheSameBitsOnAnyOtherNumber)
{
    goes_on<going_on::Column>({{{2}, {1}},
                               {{3}, {0}},
                               {{0}, {5, 1}},
                               {{5, 1, {.every = 1, .by_pairs = true}}, {2, 4}},
                               {{2}, {16, 1, {.forced = 9}}}},
                              411);
}
TEST_F(CheckpointOnRanks, OfGrainsThatEnterAndLeaveGoesOnWithTheSameBitsOnAnyOtherNumber)
{
    goes_on<going_on::Hopper>({{{3}, {1}}, {{0}, {4, 1}}, {{4, 1, {.forced = 9}}, {2}}, {{2}, {0}}}, telling_cut());
}

/// What the tests of grains see: on two ranks neighbours in another order, and contacts without their past, are told.
TEST_F(CheckpointOnRanks, WithListsOfNowOrWithoutThePastOfContactsGoesOnWithOtherBits)
{
    using going_on::Column, going_on::Hopper;
    const End column = on<Column>({0}, 411);
    const io::State column_of_now = with_lists_of_now(column.state);
    EXPECT_NE(on<Column>({2}, 389, &column_of_now).hash, on<Column>({2}, 389, &column.state).hash);
    const int cut = telling_cut();
    const End hopper = on<Hopper>({0}, cut);
    io::State state = hopper.state;
    state.put("pairs_0_0/ids", std::vector<std::uint32_t>{}, 2);
    state.put("pairs_0_0/value", std::vector<double>{}, hopper.state.tables.at("pairs_0_0/value").columns);
    EXPECT_NE(on<Hopper>({2}, Hopper::steps - cut, &state).hash,
              on<Hopper>({2}, Hopper::steps - cut, &hopper.state).hash);
}

} // namespace
