// SPDX-License-Identifier: BSD-3-Clause
#include "spate/cells/cell_pairs.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;

/// One particle in the middle of each of R x C cells of `cell` ranges.
struct Field {
    Particles<2, double, Fields<Position>, Fields<>> particles;
    Grid<2> grid;
    Binning<2> bins;

    Field(int R, int C, int cell, Edge edge)
        : grid({{0, 0}, {double(C * cell), double(R * cell)}}, Edges<2>(edge), 1, 4, cell)
    {
        particles.resize(std::size_t(R * C));
        for (int k = 0; k < R * C; ++k)
            particles.put(position, std::size_t(k), {(k % C + 0.5) * cell, (k / C + 0.5) * cell});
        bins.sort(particles, grid);
    }
    [[nodiscard]] std::int64_t pairs() const { return cell_pairs(bins, grid); }
};

// The granular deck: a box of R x C cells within walls has R(C - 1) + C(R - 1) + 2(R - 1)(C - 1) pairs of different cells, and
// each cell with itself: 16,002 and 4,096 for 64 x 64, 42 for 4 x 4.
TEST(CellPairs, OfABoxWithWallsAreThoseOfTheDeck)
{
    for (int cell : {1, 3, 4})
        for (auto [R, C] : {std::pair{64, 64}, {4, 4}, {1, 1}, {1, 9}, {7, 2}, {5, 13}}) {
            const std::int64_t different = R * (C - 1) + C * (R - 1) + 2 * (R - 1) * (C - 1);
            EXPECT_EQ(Field(R, C, cell, Edge::wall).pairs(), R * C + different) << R << " x " << C;
        }
    EXPECT_EQ(Field(64, 64, 2, Edge::wall).pairs(), 16'002 + 4'096);
    EXPECT_EQ(Field(4, 4, 2, Edge::wall).pairs(), 42 + 16);
}
// Without walls each cell has eight around it; where there are fewer than three along an axis none is counted twice.
TEST(CellPairs, OfAPeriodicBoxHaveEightNeighbours)
{
    EXPECT_EQ(Field(8, 5, 2, Edge::periodic).pairs(), 40 + 40 * 8 / 2);
    EXPECT_EQ(Field(2, 2, 2, Edge::periodic).pairs(), 4 + 6);
    EXPECT_EQ(Field(1, 3, 2, Edge::periodic).pairs(), 3 + 3);
}

} // namespace
