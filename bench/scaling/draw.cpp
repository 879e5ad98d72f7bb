// SPDX-License-Identifier: BSD-3-Clause
// What the library's own grid, shares and halo make of a plane of particles on four ranks, as a table to be drawn.
#include <spate/backend/virtual_ranks.hpp>

#include <cmath>
#include <fstream>
#include <iostream>

using namespace spate;

namespace {

constexpr int ranks = 4, cell = 3; ///< ranges along the edge of a cell
constexpr double range = 1;        ///< of bins, skin included
constexpr int corner = 3;          ///< index of the first cell: here a cube of the curve begins

using P = Particles<2, double, Fields<Position>, Fields<>>;

/// Water in a corner, its surface a wave.
P water()
{
    P p;
    std::vector<std::array<double, 2>> x;
    for (double a = 0.25; a < 18; a += 0.5)
        for (double b = 0.25; b < 12; b += 0.5)
            if (b < 11 - 0.035 * a * a + 0.4 * std::sin(1.7 * a)) x.push_back({a + 0.06 * std::sin(9 * b), b});
    p.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) p.put(position, i, {x[i][0], x[i][1]});
    return p;
}

} // namespace

/// draw FILE
int main(int argc, char** argv)
{
    if (argc != 2) {
        std::cerr << "usage: draw FILE\n";
        return 2;
    }
    std::ofstream to(argv[1]);
    to << "what,rank,x,y,of\n";
    static_assert((corner + curve_origin) % 8 == 0);
    const Grid<2> grid(Box<2>{{-corner * cell, -corner * cell}, {18, 12}}, Edges<2>(Edge::open), range, 4, cell);
    VirtualRanks(ranks).run([&](auto rank) {
        Decomposition<2, double, double, 1, decltype(rank)> parts(rank);
        P p = water();
        auto cell_of = [&](std::size_t i) {
            const auto x = p.at(position, i);
            return Index<2>{grid.cell_of(0, grid.bin(0, x[0])), grid.cell_of(1, grid.bin(1, x[1]))};
        };
        std::vector<CellCost> cost;
        for (std::size_t i = 0; i < p.size(); ++i)
            if (int(i % ranks) == rank.rank()) cost.push_back({along_curve<2>(cell_of(i)), 1});
        std::sort(cost.begin(), cost.end(), [](auto const& a, auto const& b) { return a.key < b.key; });
        parts.use(Shares<2>::of_like_cost(cost, rank));
        std::vector<std::int32_t> mine;
        for (std::size_t i = 0; i < p.size(); ++i)
            if (parts.owner(cell_of(i)) == rank.rank()) mine.push_back(std::int32_t(i));
        p.keep(mine);
        Binning<2> bins;
        bins.sort(p, grid);
        parts.halo(0).meet({&bins}, bins, Places<2, double>::of(p), p.id(), grid, parts.shares(), rank);
        for (std::size_t k = 0; k < bins.cells(); ++k) {
            const auto at = bins.cell(k);
            to << "cell," << rank.rank() << ',' << at[0] - corner << ',' << at[1] - corner << ',' << along_curve<2>(at)
               << '\n';
            each_cell_around(at, grid, [&](Index<2> const& other) {
                if (bins.find(other) >= 0 || parts.halo(0).bins().find(other) >= 0)
                    to << "pair," << rank.rank() << ',' << at[0] - corner << ',' << at[1] - corner << ','
                       << other[0] - corner << ' ' << other[1] - corner << '\n';
            });
        }
        for (std::size_t i = 0; i < p.size(); ++i)
            to << "own," << rank.rank() << ',' << p.at(position, i)[0] << ',' << p.at(position, i)[1] << ",\n";
        const auto foreign = parts.halo(0).places();
        for (std::size_t i = 0; i < foreign.size; ++i)
            to << "ghost," << rank.rank() << ',' << foreign.x[0][i] << ',' << foreign.x[1][i] << ",\n";
        (void)rank.all(1, agree::Sum{}); // one after the other
    });
}
