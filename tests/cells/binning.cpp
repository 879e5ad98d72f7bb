// SPDX-License-Identifier: BSD-3-Clause
#include <spate/backend/threads.hpp>
#include <spate/cells/binning.hpp>

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace {
using namespace spate;

template <int Dim>
using Points = Particles<Dim, double, Fields<Position>, Fields<>>;

template <int Dim>
Points<Dim> points(std::size_t n, double lo, double hi, unsigned seed)
{
    std::mt19937 random(seed);
    Points<Dim> p;
    p.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        Vec<Dim, double> x;
        for (int c = 0; c < Dim; ++c) x[c] = lo + (hi - lo) * double(random()) * 0x1p-32;
        p.put(position, i, x);
    }
    return p;
}

TEST(Binning, SortsByCellThenBinThenId)
{
    const Grid<2> grid(Box<2>{{0, 0}, {1, 1}}, Edges<2>(Edge::open), 1, 4, 2);
    auto p = points<2>(500, -7, 7, 1);
    const auto before = p;
    Binning<2> bins;
    bins.sort(p, grid);

    std::set<std::uint32_t> ids(p.id().begin(), p.id().end());
    EXPECT_EQ(ids.size(), 500u) << "nobody is lost";
    for (std::size_t i = 0; i < p.size(); ++i) // and everybody keeps its fields
        EXPECT_EQ(p.at(position, i), before.at(position, p.id()[i]));

    EXPECT_EQ(bins.begin(0), 0);
    EXPECT_EQ(bins.end(bins.cells() - 1), 500);
    for (std::size_t k = 0; k < bins.cells(); ++k) {
        const auto cell = bins.cell(k);
        EXPECT_EQ(bins.find(cell), std::int32_t(k));
        EXPECT_LT(bins.begin(k), bins.end(k)) << "cells that are kept are occupied";
        for (int b = 0; b < grid.bins_of_cell(); ++b)
            for (std::int32_t i = bins.first(k, b); i < bins.first(k, b + 1); ++i) {
                const auto x = p.at(position, std::size_t(i));
                const int bx = grid.bin(0, x[0]), by = grid.bin(1, x[1]);
                EXPECT_EQ(grid.cell_of(0, bx), cell[0]);
                EXPECT_EQ(grid.cell_of(1, by), cell[1]);
                EXPECT_EQ((by - 2 * cell[1]) * 8 + (bx - 8 * cell[0]), b);
                if (i > bins.first(k, b)) {
                    EXPECT_LT(p.id()[std::size_t(i) - 1], p.id()[std::size_t(i)]);
                }
            }
    }
    EXPECT_EQ(bins.find({1000, -1000}), -1);
}

TEST(Binning, NeedsMemoryForOccupiedCellsOnly)
{
    const Grid<3> grid(Box<3>{{0, 0, 0}, {1, 1, 1}}, Edges<3>(Edge::open), 1, 4, 4);
    auto p = points<3>(2, 0, 1, 1);
    p.put(position, 1, {{1e5, 1e5, 1e5}}); // 1.6e13 cells lie between
    Binning<3> bins;
    bins.sort(p, grid);
    EXPECT_EQ(bins.cells(), 2u);
    EXPECT_LT(bins.bytes(), 100000u);
}

TEST(Binning, OfNobodyHasNoCells)
{
    const Grid<2> grid(Box<2>{{0, 0}, {1, 1}}, Edges<2>(Edge::periodic), 0.1, 4, 2);
    Points<2> p;
    Binning<2> bins;
    bins.sort(p, grid);
    EXPECT_EQ(bins.cells(), 0u);
    EXPECT_EQ(bins.find({0, 0}), -1);
    EXPECT_TRUE(bins.images().of.empty());
}

TEST(Binning, StopsAtWhatNoIndexCanName)
{
    const Grid<2> grid(Box<2>{{0, 0}, {1, 1}}, Edges<2>(Edge::open), 1, 1, 1);
    auto p = points<2>(3, 0, 1, 1);
    p.put(position, 2, {{0, 1e9}});
    Binning<2> bins;
    try {
        bins.sort(p, grid);
        FAIL() << "an index has overflowed in silence";
    }
    catch (IndexOverflow const& e) {
        EXPECT_EQ(e.facts().particle, 2);
        EXPECT_EQ(e.facts().position[1], 1e9);
    }
    p.put(position, 2, {{std::numeric_limits<double>::quiet_NaN(), 0}});
    EXPECT_THROW(bins.sort(p, grid), IndexOverflow);
}

TEST(Binning, IsTheSameByManyThreads)
{
    const Grid<3> grid(Box<3>{{0, 0, 0}, {1, 1, 1}}, Edges<3>(Edge::open), 0.5, 4, 3);
    for (const std::size_t n : {0u, 1u, 7u, 20000u}) {
        auto alone = points<3>(n, -3, 4, 5), shared = alone;
        Binning<3> a, b;
        a.sort(alone, grid);
        b.sort(shared, grid, InParts{Threads{3}});
        EXPECT_EQ(alone.id(), shared.id());
        ASSERT_EQ(a.cells(), b.cells());
        for (std::size_t bin = 0; bin <= a.cells() * std::size_t(grid.bins_of_cell()); ++bin)
            ASSERT_EQ(a.first(bin), b.first(bin));
        for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(alone.at(position, i), shared.at(position, i));
    }
}

TEST(Binning, NamesTheFirstThatNoIndexCanName)
{
    const Grid<2> grid(Box<2>{{0, 0}, {1, 1}}, Edges<2>(Edge::open), 1, 1, 1);
    auto p = points<2>(5000, 0, 1, 1);
    for (const std::size_t i : {0u, 700u, 4999u}) p.put(position, i, {{0, 1e9 + double(i)}});
    Binning<2> bins;
    try {
        bins.sort(p, grid, InParts{Threads{3}});
        FAIL() << "an index has overflowed in silence";
    }
    catch (IndexOverflow const& e) {
        EXPECT_EQ(e.facts().particle, 0);
    }
}

/// Each particle near a periodic face has one image for each shift that brings it beside the domain, and no other.
template <int Dim>
void expect_images(Edges<Dim> const& edges, double length)
{
    Box<Dim> box;
    for (int c = 0; c < Dim; ++c) box.lo[c] = 0, box.hi[c] = length;
    const Grid<Dim> grid(box, edges, 1, 2, 2);
    auto p = points<Dim>(200, 0, length, 3);
    Binning<Dim> bins;
    bins.sort(p, grid);
    auto const& images = bins.images();
    std::size_t expected = 0;
    int codes = 1;
    for (int c = 0; c < Dim; ++c) codes *= 3;
    for (std::size_t i = 0; i < p.size(); ++i)
        for (int code = 1; code < codes; ++code) {
            bool wanted = true;
            int rest = code;
            for (int c = 0; c < Dim; ++c, rest /= 3) {
                const int digit = rest % 3, bin = grid.bin(c, p.at(position, i)[c]);
                if (digit == 1) wanted = wanted && grid.periodic(c) && bin < grid.per_range(c);
                if (digit == 2) wanted = wanted && grid.periodic(c) && bin >= grid.bins(c) - grid.per_range(c);
            }
            if (!wanted) continue;
            ++expected;
            const auto record = std::size_t(bins.record_of(std::int32_t(i), code, p.size()));
            ASSERT_GT(record, p.size());
            ASSERT_LE(record, p.size() + images.of.size());
            EXPECT_EQ(images.of[record - p.size() - 1], std::int32_t(i));
            EXPECT_EQ(images.code[record - p.size() - 1], code);
        }
    EXPECT_EQ(images.of.size(), expected);
    EXPECT_EQ(images.code.size(), expected);
}
TEST(Binning, HasAnImageForEachShiftThatIsNear)
{
    for (double length : {1.0, 1.5, 2.0, 3.7, 6.0}) { // one range, two, and more
        expect_images<1>(Edges<1>(Edge::periodic), length);
        expect_images<2>(Edges<2>(Edge::periodic), length);
        expect_images<3>(Edges<3>(Edge::periodic), length);
        Edges<3> mixed(Edge::open);
        mixed.set_axis(y_axis, Edge::periodic);
        expect_images<3>(mixed, length);
    }
    const Grid<2> grid(Box<2>{{0, 0}, {3, 5}}, Edges<2>(Edge::periodic), 1, 2, 2);
    EXPECT_EQ(shift_of(1, grid), (Vec<2, double>{{3, 0}}));
    EXPECT_EQ(shift_of(2 + 3, grid), (Vec<2, double>{{-3, 5}}));
    EXPECT_EQ(shift_of(6, grid), (Vec<2, double>{{0, -5}}));
}

} // namespace
