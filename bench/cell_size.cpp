// SPDX-License-Identifier: BSD-3-Clause
// The seed's study of the cell size, with all that has a say beside it: edge of a cell, shape of a bin, skin, h/dx. None
// of them changes a bit of the result at equal bins; here is what they cost.
#include "support/least.hpp"
#include "support/scenes.hpp"
#include "support/stages.hpp"

using namespace bench;

namespace {

constexpr int n = 40; // particles along an edge: 64,000

/// A step of the dam break, whose fastest flow is c0/10, with cfl 0.2: two evaluations by midpoint. Two particles close in
/// by the diagonal of the box of all displacements: between one and two times the fastest flow; one and a half is taken.
double evaluations_of_a_list(double skin)
{
    constexpr double support = 2, cfl = 0.2, fastest = 0.1, closing = 1.5; // [h], [-], [c0], [fastest]
    const double a_step = closing * fastest * cfl / (1 + fastest);         // [h]
    return 2 * std::max(1.0, std::floor(skin * support / a_step));
}

void cell_size(benchmark::State& state)
{
    const double skin = 1e-3 * double(state.range(2)), h = 0.1 * double(state.range(3));
    auto sim = block(n,
                     water(h, Continuity<2>{}, DensityDiffusion{.delta = 0.1}, PressureForce<2>{},
                           ArtificialViscosity{.alpha = 0.1}, Gravity<3>{{0, 0, -g}}),
                     RungeKutta2{}, Double{}, {.skin = skin, .finer = int(state.range(1))}, int(state.range(0)));
    auto& s = sim.system();
    SweepsOf sweeps(s);
    Least rebuild, sweep;
    for (auto _ : state) {
        rebuild.of([&] { s.rebuild(); });
        sweep.of([&] { sweeps.run(); });
        sweep.of([&] { sweeps.run(); });
    }
    const double particles = double(s.total());
    auto& c = state.counters;
    c["sweep_ns"] = sweep.ns(particles);
    c["rebuild_ns"] = rebuild.ns(particles);
    c["sweep_ns_pair"] = sweep.ns(double(s.pairs()));
    c["pairs"] = double(s.pairs()) / particles;
    c["slots_pair"] = slots(s) / double(s.pairs());
    c["flow_ns"] = sweep.ns(particles) + rebuild.ns(particles) / evaluations_of_a_list(skin);
}
BENCHMARK(cell_size)
    ->ArgNames({"cell", "finer", "skin_permille", "h_tenths"})
    ->ArgsProduct({{1, 2, 4, 8, 16}, {1, 2, 4, 8}, {30, 70, 120, 200}, {12, 13, 15}})
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

/// What the decks' codes do instead: no bins and no lists, all particles of a pair of cells are tested. Forces of pressure on the
/// particles of a block, from all in the 27 cells, a pack of sources at a time.
void brute_force(benchmark::State& state)
{
    using V = Pack<double>;
    constexpr int edge_n = 40, W = width<V>;
    const CubicSpline<3> kernel{.h = 1.2}; // spacing 1
    const double range = CubicSpline<3>::radius * kernel.h, edge = range * double(state.range(0));
    const int cells = int(std::ceil(edge_n / edge));
    std::vector<std::vector<std::array<double, 3>>> in_cell(std::size_t(cells * cells * cells));
    const auto number = [&](int x, int y, int z) { return std::size_t((z * cells + y) * cells + x); };
    for (int k = 0; k < edge_n * edge_n * edge_n; ++k) {
        const std::array<double, 3> x{0.5 + k % edge_n, 0.5 + k / edge_n % edge_n, 0.5 + k / (edge_n * edge_n)};
        in_cell[number(int(x[0] / edge), int(x[1] / edge), int(x[2] / edge))].push_back(x);
    }
    std::array<Array<double>, 4> column; // x, y, z, p / rho^2
    std::vector<std::size_t> first{0};
    for (auto const& all : in_cell) {
        for (auto const& x : all) {
            for (std::size_t c = 0; c < 3; ++c) column[c].push_back(x[c]);
            column[3].push_back(1 + 0.01 * x[2]);
        }
        first.push_back(column[0].size());
    }
    const std::size_t n = column[0].size();
    for (auto& c : column) c.resize(n + std::size_t(W), 1e9); // lanes beyond the last meet nobody
    std::int64_t tests = 0;
    double sum = 0, number_of_lane[W];
    for (int l = 0; l < W; ++l) number_of_lane[l] = l;
    const V lane = load<V>(number_of_lane);
    const auto lanes_of = [&](std::array<double, 4> const& i, std::size_t from, std::size_t to) {
        V force(0);
        for (std::size_t j = from; j < to; j += std::size_t(W)) {
            const V dx = i[0] - load<V>(&column[0][j]), dy = i[1] - load<V>(&column[1][j]),
                    dz = i[2] - load<V>(&column[2][j]);
            const V r2 = dx * dx + dy * dy + dz * dz;
            const auto meets = r2 < where(lane < V(double(to - j)), V(range * range), V(0)); // not beyond the row
            if (!spate::any(meets)) continue;
            const V q = sqrt(max(r2, V(1e-12))) / kernel.h;
            const V slope = CubicSpline<3>::g(q) * (i[3] + load<V>(&column[3][j])) * dz;
            force = force + where(meets, slope, V(0));
        }
        tests += std::int64_t(to - from);
        return force;
    };
    Least time;
    for (auto _ : state)
        time.of([&] {
            tests = 0;
            for (int k = 0; k < cells * cells * cells; ++k)
                for (std::size_t t = first[std::size_t(k)]; t < first[std::size_t(k) + 1]; ++t) {
                    const std::array<double, 4> i{column[0][t], column[1][t], column[2][t], column[3][t]};
                    const int x = k % cells, y = k / cells % cells, z = k / (cells * cells);
                    V force(0);
                    for (int b = std::max(0, z - 1); b <= std::min(cells - 1, z + 1); ++b)
                        for (int a = std::max(0, y - 1); a <= std::min(cells - 1, y + 1);
                             ++a) // a row of cells lies in one piece
                            force = force + lanes_of(i, first[number(std::max(0, x - 1), a, b)],
                                                     first[number(std::min(cells - 1, x + 1), a, b) + 1]);
                    double of_lane[W];
                    store(of_lane, force);
                    for (const double f : of_lane) sum += f;
                }
        });
    benchmark::DoNotOptimize(sum);
    state.counters["tests"] = double(tests) / double(n);
    state.counters["ns"] = time.ns(double(n));
}
BENCHMARK(brute_force)->ArgName("cell")->RangeMultiplier(2)->Range(1, 16)->Iterations(2)->Unit(benchmark::kMillisecond);

} // namespace
