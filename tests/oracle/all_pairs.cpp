// SPDX-License-Identifier: BSD-3-Clause
// Neighbour lists against brute force on ten thousand random scenes (numerics V07).
#include "oracle/all_pairs.hpp"
#include "oracle/dice.hpp"

#include <spate/spate.hpp>

#include <gtest/gtest.h>

namespace {
using namespace spate;
using oracle::Dice;
using oracle::Entry;
using oracle::Pair;

inline constexpr struct Count : ScalarField {
    static constexpr std::string_view name = "count";
    static constexpr bool derived = true;
} count{};
/// Any pair term: the engine keeps lists only for species that some term pairs.
struct CountPairs {
    static constexpr Fields adds{count};
    static constexpr When when = When::before_step;
    void operator()(auto& i, auto const&, auto const& ij) const { i[count] += 0 * ij.r2; }
};

enum class Kind { random, clustered, on_faces, lattice, thin_slab, one_bin, shortest_period };
constexpr int kinds = 7;

template <int Dim>
struct Scene {
    Box<Dim> box;
    std::array<bool, 3> open{};
    double h;
    Neighbours neighbours;
    int cell;
    std::vector<Vec<Dim, double>> x;
    Kind kind;

    [[nodiscard]] double range() const { return 2 * h; }
    [[nodiscard]] double reach() const { return range() * (1 + neighbours.skin); }
};

template <int Dim>
Scene<Dim> scene(Dice& dice)
{
    Scene<Dim> s;
    s.kind = Kind(dice.integer(0, kinds - 1));
    s.h = dice.chance(0.5) ? dice.of(std::array{0.25, 0.5, 1.0, 4.0}) : std::pow(10, dice.real(-4, 3));
    s.neighbours.skin = dice.of(std::array{0.01, 0.05, 0.1, 0.25, 0.3, 1.0, 2.0});
    s.neighbours.finer = dice.of(std::array{1, 2, 3, 4, 7, 16});
    s.neighbours.window = dice.of(std::array{1, 16, 50});
    if (dice.chance(0.3)) s.neighbours.bins = dice.real(1 + s.neighbours.skin, 4);
    s.cell = dice.of(std::array{0, 1, 1, 2, 3, 4, 8, 16});
    const double reach = s.reach();
    for (int c = 0; c < Dim; ++c) {
        s.open[std::size_t(c)] = s.kind != Kind::shortest_period && dice.chance(0.4);
        s.box.lo[c] = dice.chance(0.5) ? 0 : dice.real(-50, 50) * reach;
        double length = dice.real(2.01, 6) * reach;
        if (s.kind == Kind::thin_slab && s.open[std::size_t(c)]) length = dice.real(0, 0.2) * reach;
        if (s.kind == Kind::on_faces || s.kind == Kind::lattice) length = dice.integer(3, 6) * reach;
        if (s.kind == Kind::shortest_period || (s.kind == Kind::thin_slab && !s.open[std::size_t(c)])) {
            s.box.lo[c] = 0; // so that the length is the limit exactly
            length = 2 * reach;
        }
        s.box.hi[c] = s.box.lo[c] + length;
    }
    const int n = dice.of(std::array{0, 1, 2, 3, 17, 40, 40, 80, 80, 160});
    std::vector<Vec<Dim, double>> centre;
    for (int k = 0; k < 3; ++k) {
        centre.emplace_back();
        for (int c = 0; c < Dim; ++c) centre.back()[c] = dice.real(s.box.lo[c], s.box.hi[c]);
    }
    const double step = reach * dice.of(std::array{1.0, 0.5, 0.25, 1 / 1.1}); // of the points of faces and lattices
    for (int k = 0; k < n; ++k) {
        Vec<Dim, double> x;
        for (int c = 0; c < Dim; ++c) {
            const double lo = s.box.lo[c], hi = s.box.hi[c], out = s.open[std::size_t(c)] ? reach : 0;
            switch (s.kind) {
            case Kind::clustered: // to coincidence
                x[c] = centre[std::size_t(k % 3)][c] + reach * std::pow(10, dice.real(-9, 0)) * dice.real(-1, 1);
                break;
            case Kind::on_faces: // faces of bins and of the box, and a rounding beside them
                x[c] = dice.chance(0.2) ? hi : lo + step * dice.integer(s.open[std::size_t(c)] ? -3 : 0, 12);
                if (dice.chance(0.3)) x[c] = std::nextafter(x[c], dice.chance(0.5) ? hi + 1 : lo - 1);
                break;
            case Kind::lattice: x[c] = lo + step * (0.5 + dice.integer(-2, 12)); break;
            case Kind::one_bin: x[c] = centre[0][c] + 0.05 * reach * dice.real(0, 1); break;
            default: x[c] = dice.real(lo - out, hi + out);
            }
        }
        s.x.push_back(x);
    }
    return s;
}

template <int Dim>
Periodic<Dim> boundary(Scene<Dim> const& s)
{
    std::vector<Face> f;
    for (int c = 0; c < Dim; ++c)
        if (s.open[std::size_t(c)]) f.push_back({c, false}); // one open face opens the axis
    if (f.empty()) return Periodic<Dim>(s.box);
    if (f.size() == 1) return Periodic<Dim>(s.box, open(f[0]));
    if (f.size() == 2) return Periodic<Dim>(s.box, open(f[0], f[1]));
    return Periodic<Dim>(s.box, open(f[0], f[1], f[2]));
}

/// The largest distance at which a pair may be listed: the lists select in float, from a corner at most
/// cell + 2 bins away, and widen their reach by a hair for it; the hair and the rounding once more.
double most(double reach, double bin, int cell)
{
    return reach * (1 + 5e-6) + 1e-6 * (cell + 2) * std::max(bin, reach);
}

template <int Dim>
auto key_of(Entry const& e, auto const& source, Grid<Dim> const& grid)
{
    std::array<std::int64_t, std::size_t(Dim) + 1> key{}; // slowest axis first, the id last
    for (int c = 0; c < Dim; ++c)
        key[std::size_t(Dim - 1 - c)] =
            grid.bin(c, source.at(position, e.j)[c]) + std::int64_t(e.shift[std::size_t(c)]) * grid.bins(c);
    key.back() = source.id()[e.j];
    return key;
}

/// A pair for a message.
template <int Dim>
std::string words(Pair const& p, auto const& target, auto const& source, Vec<Dim, double> const& period, double reach,
                  Grid<Dim> const& grid)
{
    auto index = [](auto const& particles, std::uint32_t id) {
        return std::size_t(std::find(particles.id().begin(), particles.id().end(), id) - particles.id().begin());
    };
    const std::size_t i = index(target.particles, p.target), j = index(source.particles, p.source);
    std::ostringstream s;
    s.precision(17);
    s << p.target << " <- " << p.source << ", shifts " << p.shift[0] << ' ' << p.shift[1] << ' ' << p.shift[2]
      << ", distance over reach - 1 = "
      << std::sqrt(oracle::distance2<Dim>(target.particles, i, source.particles, j, p.shift, period)) / reach - 1;
    for (int c = 0; c < Dim; ++c) {
        const double x_i = target.particles.at(position, i)[c], x_j = source.particles.at(position, j)[c];
        s << "; axis " << c << ": " << x_i << " in bin " << grid.bin(c, x_i) << ", " << x_j << " in bin "
          << grid.bin(c, x_j) << " of " << grid.bins(c);
    }
    return s.str();
}

/// What lists target <- source must be; returns the number of entries.
template <int s, int q>
std::size_t expect_all_pairs(auto& system)
{
    using System = std::remove_cvref_t<decltype(system)>;
    constexpr int Dim = System::dim;
    auto const& grid = system.grid();
    auto const& target = system.template species<s>();
    auto const& source = system.template species<q>();
    const double range = system.physics().interaction.range(), reach = range * (1 + system.neighbours().skin);
    Vec<Dim, double> period;
    for (int c = 0; c < Dim; ++c) period[c] = grid.period(c);

    std::vector<Pair> listed;
    std::size_t too_far = 0, out_of_order = 0, target_of_last = ~std::size_t(0);
    std::array<std::int64_t, std::size_t(Dim) + 1> last{};
    const double bin = range * system.neighbours().bin_edge();
    const double limit = most(reach, 2 * bin, grid.cell()); // a periodic axis stretches its bins to less than twice
    const bool well_formed =
        oracle::each_entry(system.template lists<s, q>(), target.bins, source.bins, source.particles.size(),
                           width<typename System::V>, [&](Entry const& e) {
                               listed.push_back({target.particles.id()[e.i], source.particles.id()[e.j], e.shift});
                               too_far += !(oracle::distance2<Dim>(target.particles, e.i, source.particles, e.j,
                                                                   e.shift, period) < limit * limit);
                               const auto key = key_of<Dim>(e, source.particles, grid);
                               out_of_order += e.i == target_of_last && !(last < key);
                               target_of_last = e.i, last = key;
                           });
    EXPECT_TRUE(well_formed);
    EXPECT_EQ(too_far, 0u) << "pairs beyond the reach are listed";
    EXPECT_EQ(out_of_order, 0u) << "a list is not in the order (global bin, id)";
    std::sort(listed.begin(), listed.end());
    EXPECT_EQ(std::adjacent_find(listed.begin(), listed.end()), listed.end()) << "a pair is listed twice";
    // At the very reach the rounding of a position decides on its bin; a hundredth of it away the range begins.
    double far = reach;
    for (int c = 0; c < Dim; ++c) far = std::max({far, std::abs(grid.box().lo[c]), std::abs(grid.box().hi[c])});
    const double rounding = 8 * far * double(std::numeric_limits<typename System::T>::epsilon());
    EXPECT_LT(range, reach - rounding);
    const auto wanted = oracle::all_pairs<Dim>(target.particles, source.particles, s == q, period, reach - rounding);
    std::vector<Pair> missed;
    std::set_difference(wanted.begin(), wanted.end(), listed.begin(), listed.end(), std::back_inserter(missed));
    if (!missed.empty()) ADD_FAILURE() << "missed " << words<Dim>(missed[0], target, source, period, reach, grid);

    const auto pairs = std::size_t(system.template lists<s, q>().pairs());
    const double hair = most(range, 2 * bin, grid.cell()) - range; // pairs are counted in float
    EXPECT_LE(oracle::all_pairs<Dim>(target.particles, source.particles, s == q, period, range - hair).size(), pairs);
    EXPECT_GE(oracle::all_pairs<Dim>(target.particles, source.particles, s == q, period, range + hair).size(), pairs);
    return listed.size();
}

template <int Dim, class Precision>
struct Setting {
    static constexpr int dim = Dim;
    using precision = Precision;
};
template <class S>
class NeighbourLists : public ::testing::Test {};
// clang-format off
using Settings = ::testing::Types<
    Setting<1, Double>, Setting<1, Float>,
    Setting<2, Double>, Setting<2, Float>, Setting<2, ScalarOf<Double>>, Setting<2, ScalarOf<Float>>,
    Setting<3, Double>, Setting<3, Float>>; // lists are told the width of a pack when they are built
// clang-format on
TYPED_TEST_SUITE(NeighbourLists, Settings);

constexpr int cases = 1251; // of each of the 8 settings: 10,008

TYPED_TEST(NeighbourLists, EqualAllPairs)
{
    constexpr int Dim = TypeParam::dim;
    Dice dice(20240 + std::uint64_t(Dim));
    std::array<std::size_t, kinds> of_kind{};
    for (int k = 0; k < cases; ++k) {
        const Scene<Dim> s = scene<Dim>(dice);
        Simulation sim(physics(Smoothing<CubicSpline<Dim>>{{.h = s.h}}, CountPairs{}), ForwardEuler{}, boundary(s),
                       Serial{.cell = s.cell}, typename TypeParam::precision{}, NoWatch{}, s.neighbours);
        for (auto const& x : s.x) sim.add(x);
        sim.prepare();
        sim.system().rebuild();
        of_kind[std::size_t(s.kind)] += expect_all_pairs<0, 0>(sim.system());
        if (this->HasFailure()) {
            FAIL() << "case " << k << ": kind " << int(s.kind) << ", " << s.x.size() << " particles, range "
                   << s.range() << ", skin " << s.neighbours.skin << ", bins " << s.neighbours.bins << ", finer "
                   << s.neighbours.finer << ", cell " << s.cell << ", open " << s.open[0] << s.open[1] << s.open[2];
        }
    }
    for (std::size_t n : of_kind) EXPECT_GT(n, std::size_t(cases)); // the scenes are not empty
}

TEST(NeighbourLists, DoNotDependOnTheOrderOfParticles)
{
    Dice dice(7);
    std::size_t entries = 0;
    for (int k = 0; k < 50; ++k) {
        Scene<2> s = scene<2>(dice);
        auto lists = [&](bool backwards) {
            Simulation sim(physics(Smoothing<CubicSpline<2>>{{.h = s.h}}, CountPairs{}), ForwardEuler{}, boundary(s),
                           Serial{.cell = s.cell}, Double{}, NoWatch{}, s.neighbours);
            const std::size_t n = s.x.size();
            std::vector<std::uint32_t> id;
            for (std::size_t i = 0; i < n; ++i) {
                id.push_back(std::uint32_t(backwards ? n - 1 - i : i));
                sim.add(s.x[id.back()]);
            }
            sim.particles().set_ids(id);
            sim.prepare();
            sim.system().rebuild();
            std::vector<Pair> pairs; // in the order of the lists
            auto const& x = sim.system().template species<0>();
            oracle::each_entry(sim.system().template lists<0, 0>(), x.bins, x.bins, n, width<Pack<double>>,
                               [&](Entry const& e) {
                                   pairs.push_back({x.particles.id()[e.i], x.particles.id()[e.j], e.shift});
                               });
            return pairs;
        };
        const auto forwards = lists(false);
        EXPECT_EQ(forwards, lists(true));
        entries += forwards.size();
    }
    EXPECT_GT(entries, 1000u);
}

TEST(NeighbourLists, EqualAllPairsBetweenFluidAndMarkers)
{
    constexpr double dx = 0.1;
    for (int cell : {1, 3, 8}) {
        auto water = wcsph(WendlandC2<2>{.h = 1.5 * dx}, LinearEos{.rho0 = 1000, .c0 = 10}, Continuity<2>{},
                           PressureForce<2>{}, Gravity<2>{{0, -1}});
        const Box<2> box{{-0.3, 0}, {1.2, 1}};
        Simulation sim(water, ForwardEuler{}, Bce(box, dx, Adami{}, open(top)), Serial{.cell = cell});
        sim.fill(Box<2>{{-0.3, 0}, {0.2, 0.8}}, dx);
        Dice dice(11);
        for (std::size_t i = 0; i < sim.particles().size(); ++i) {
            auto x = sim.particles().at(position, i);
            for (int c = 0; c < 2; ++c) x[c] += dx * dice.real(-0.2, 0.2);
            sim.particles().put(position, i, x);
        }
        sim.prepare();
        sim.system().rebuild();
        EXPECT_GT((expect_all_pairs<0, 0>(sim.system())), 500u);
        EXPECT_GT((expect_all_pairs<0, 1>(sim.system())), 100u);
        EXPECT_GT((expect_all_pairs<1, 0>(sim.system())), 100u);
        EXPECT_EQ((sim.system().template lists<1, 1>().slots()), 0) << "walls do not search walls";
    }
}

TEST(NeighbourLists, EqualAllPairsWithoutABox)
{
    Dice dice(3);
    for (int k = 0; k < 100; ++k) {
        const Scene<3> s = scene<3>(dice);
        Simulation sim(physics(Smoothing<CubicSpline<3>>{{.h = s.h}}, CountPairs{}), ForwardEuler{}, Open{},
                       Serial{.cell = s.cell}, Double{}, NoWatch{}, s.neighbours);
        for (auto const& x : s.x) sim.add(x);
        sim.prepare();
        sim.system().rebuild();
        expect_all_pairs<0, 0>(sim.system());
        ASSERT_FALSE(HasFailure()) << "case " << k;
    }
}

} // namespace
