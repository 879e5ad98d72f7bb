// SPDX-License-Identifier: BSD-3-Clause
// Ranks that share a process write a file in turns.
#include "spate/io/detail/shared_file.hpp"

#include "io/shared_rows.hpp"
#include "spate/backend/virtual_ranks.hpp"

namespace {

using namespace spate;

class SharedFile : public small_tank::InFolder {};

TEST_F(SharedFile, IsThatOfOneRank)
{
    for (int ranks : {1, 2, 3, 7})
        VirtualRanks(ranks).run([&](auto rank) { shared_rows::expect_files_of_one(rank, folder); });
}
TEST_F(SharedFile, EndsAllRanksWithAnErrorIfItCannotBeWritten)
{
    for (int ranks : {1, 3})
        VirtualRanks(ranks).run([&](auto rank) { shared_rows::expect_errors_of_all(rank, folder); });
}

/// The stretch of each rank, as its first and last key.
TEST(Stretches, AreOfLikeLengthWhateverIdsAreLeft)
{
    auto ids_of = [](int rank, std::uint32_t first, std::uint32_t step) {
        std::vector<std::uint32_t> ids;
        for (std::uint32_t k = 0; k < 100; ++k) ids.push_back(first + step * (4 * k + std::uint32_t(rank)));
        return ids;
    };
    // dense; with gaps; all at the end; beyond the largest signed number
    for (auto const& [first, step] : std::vector<std::pair<std::uint32_t, std::uint32_t>>{
             {0, 1}, {17, 1000}, {4'294'966'000u, 1}, {2'147'483'000u, 3}})
        VirtualRanks(4).run([&, first = first, step = step](auto rank) {
            const io::TheseRanks these(rank);
            const auto mine = ids_of(rank.rank(), first, step);
            const io::detail::Stretches stretches(these, io::detail::keys_of(mine, 1), 1);
            EXPECT_EQ(stretches.where().total, 400u);
            EXPECT_EQ(stretches.where().first, 100u * unsigned(rank.rank()));
            const auto here = stretches(mine, 1);
            ASSERT_EQ(here.size(), 100u);
            for (std::uint32_t k = 0; k < 100; ++k)
                EXPECT_EQ(here[k], first + step * (100 * std::uint32_t(rank.rank()) + k));
        });
}

} // namespace
