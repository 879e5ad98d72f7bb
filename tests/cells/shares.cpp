// SPDX-License-Identifier: BSD-3-Clause
#include "spate/backend/virtual_ranks.hpp"
#include "spate/spate.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <set>

namespace {

using namespace spate;

/// The cells of a cube from a corner, in the order of the curve.
template <int Dim>
std::vector<Index<Dim>> in_order(std::int32_t from, std::int32_t edge)
{
    std::vector<Index<Dim>> cells;
    std::int64_t n = 1;
    for (int c = 0; c < Dim; ++c) n *= edge;
    for (std::int64_t k = 0; k < n; ++k) {
        Index<Dim> cell;
        auto rest = k;
        for (auto& i : cell) i = from + std::int32_t(rest % edge), rest /= edge;
        cells.push_back(cell);
    }
    std::sort(cells.begin(), cells.end(),
              [](auto const& a, auto const& b) { return along_curve<Dim>(a) < along_curve<Dim>(b); });
    return cells;
}
/// \param shift  by how many cubes the first one lies off that which holds the origin
template <int Dim>
void expect_a_path(std::int32_t shift, std::int32_t edge)
{
    const std::int32_t from = shift * edge - curve_origin % edge; // a corner of a cube of the curve
    const auto cells = in_order<Dim>(from, edge);
    for (std::size_t k = 1; k < cells.size(); ++k) {
        int steps = 0;
        for (std::size_t c = 0; c < std::size_t(Dim); ++c) steps += std::abs(cells[k][c] - cells[k - 1][c]);
        ASSERT_EQ(steps, 1) << "from " << k - 1 << " to " << k;
        ASSERT_NE(along_curve<Dim>(cells[k]), along_curve<Dim>(cells[k - 1]));
    }
}
TEST(Curve, GoesFromCellToCellThroughACubeOfTwoToTheN)
{
    expect_a_path<1>(0, 64);
    expect_a_path<2>(0, 32);
    expect_a_path<3>(0, 16);
    expect_a_path<2>(-1, 16);
    expect_a_path<3>(-1, 8);
    expect_a_path<2>(-(curve_origin / 16), 16);
}
TEST(Curve, KnowsCellsOnBothSidesOfTheOrigin)
{
    std::set<std::uint64_t> keys;
    for (auto const& cell : in_order<2>(-5, 11)) keys.insert(along_curve<2>(cell));
    EXPECT_EQ(keys.size(), 121);
}
TEST(Shares, OfAllIsOneRanks)
{
    const Shares<2> all;
    for (auto const& cell : in_order<2>(-5, 11)) EXPECT_EQ(all.owner(cell), 0);
}
/// As if so many ranks asked, and this one had all cells.
struct Many {
    int ranks;
    [[nodiscard]] int rank() const { return 0; }
    [[nodiscard]] int count() const { return ranks; }
    template <class T>
    [[nodiscard]] T all(T mine, auto const&) const
    {
        return mine;
    }
    void each(auto&, auto const&) const {}
};
struct Turns : Many {
    int* n;
    void each(auto&, auto const&) const { ++*n; }
};
TEST(Shares, AreOfLikeCost)
{
    std::vector<CellCost> cost;
    std::int64_t total = 0, dearest = 0;
    for (auto const& cell : in_order<3>(0, 16)) {
        const std::int64_t c = 1 + (cell[0] * 7 + cell[1] * 3 + cell[2]) % 20 + (cell[2] == 0 ? 100 : 0);
        cost.push_back({along_curve<3>(cell), c});
        total += c, dearest = std::max(dearest, c);
    }
    for (int ranks : {1, 2, 3, 8, 100}) {
        const auto shares = Shares<3>::of_like_cost(cost, Many{ranks});
        std::vector<std::int64_t> of(std::size_t(ranks), 0);
        for (auto const& c : cost) of[std::size_t(shares.owner_of(c.key))] += c.cost;
        for (auto const c : of) EXPECT_LE(std::abs(double(c) - double(total) / ranks), double(dearest)) << ranks;
        EXPECT_EQ(shares.owner_of(0), 0);
        EXPECT_EQ(shares.owner_of(~std::uint64_t(0)), ranks - 1);
    }
}
struct Summing : VirtualRanks::Rank {
    int* n;
    void each(auto& values, auto const& merge) const { ++*n, VirtualRanks::Rank::each(values, merge); }
};
// Who has the cells between two cuts knows which new cuts are among them: the same cuts as found by halves.
TEST(Shares, AreCutAnewInTwoSums)
{
    const auto cells = in_order<3>(-3, 12);
    for (int ranks : {1, 2, 7, 64, 700})
        for (int round = 0; round < 3; ++round) {
            std::vector<CellCost> all; // twice: of two species
            for (std::size_t k = 0; k < 2 * cells.size(); ++k) {
                const auto n = std::int64_t(k) * (7 + round) % 23;
                all.push_back({along_curve<3>(cells[k / 2]), round == 0 ? n % 3 : round == 1 ? n * n * n : k == 99});
            }
            std::vector<std::uint64_t> first(std::size_t(ranks), 0);
            for (std::size_t r = 1; r < first.size(); ++r) // uneven stretches, some with nothing in them
                first[r] = along_curve<3>(cells[r * r * cells.size() / (first.size() * first.size())]) + r % 2;
            const Shares<3> before(first);
            std::vector<Shares<3>::Anew> anew(first.size());
            std::vector<int> sums(first.size(), 0);
            VirtualRanks(ranks).run([&](auto rank) {
                std::vector<CellCost> mine;
                for (auto const& c : all)
                    if (before.owner_of(c.key) == rank.rank()) mine.push_back(c);
                const auto me = std::size_t(rank.rank());
                anew[me] = before.cut_anew(mine, Summing{rank, &sums[me]});
            });
            const auto shares = Shares<3>::of_like_cost(all, Many{ranks});
            std::vector<std::int64_t> of(std::size_t(ranks), 0);
            for (auto const& c : all) of[std::size_t(shares.owner_of(c.key))] += c.cost;
            for (std::size_t r = 0; r < first.size(); ++r) {
                ASSERT_EQ(anew[r].shares, shares) << ranks << " ranks, round " << round;
                EXPECT_EQ(anew[r].dearest, *std::max_element(of.begin(), of.end()));
                EXPECT_EQ(sums[r], 2);
            }
        }
}
// Walls have cells on both sides of the origin: their keys must not lie at both ends of the curve.
TEST(Shares, OfADomainWithWallsAreFoundInFewTurns)
{
    for (int edge : {6, 14, 30}) { // cells of a walled cube: -1 to edge
        std::vector<CellCost> cost;
        for (auto const& cell : in_order<3>(-1, edge + 2)) cost.push_back({along_curve<3>(cell), 1});
        int turns = 0;
        (void)Shares<3>::of_like_cost(cost, Turns{{8}, &turns});
        EXPECT_LE(turns, 3 * (std::bit_width(unsigned(edge + 1)) + 2)) << edge; // a cube of at most four times the edge
    }
}
TEST(Shares, AreStretchesOfTheCurve)
{
    std::vector<CellCost> cost;
    for (auto const& cell : in_order<2>(0, 32)) cost.push_back({along_curve<2>(cell), 1});
    const auto shares = Shares<2>::of_like_cost(cost, Many{7});
    int last = 0;
    for (auto const& cell : in_order<2>(0, 32)) {
        const int owner = shares.owner(cell);
        EXPECT_TRUE(owner == last || owner == last + 1);
        last = owner;
    }
    EXPECT_EQ(last, 6);
}

} // namespace
