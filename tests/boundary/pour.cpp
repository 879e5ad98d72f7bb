// SPDX-License-Identifier: BSD-3-Clause
#include "spate/boundary/pour.hpp"

#include "extreme/chosen.hpp"
#include "spate/io/history.hpp"
#include "spate/spate.hpp"

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace {

using namespace spate;
using testing::HasSubstr;

constexpr double r = 0.01, k = 1e5, m = 0.1, g = 9.81, dt = 1e-4;

/// Grains in a periodic box of 1 m; nothing pulls.
auto chamber(int integrator = chosen::leapfrog)
{
    chosen::integrator = integrator;
    return Simulation(dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k}), chosen::AnyIntegrator{},
                      Periodic(Box<2>{{0, 0}, {1, 1}}), Serial{});
}

double least_distance(auto const& sim)
{
    auto const& p = sim.particles();
    double least2 = 1e300;
    for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            least2 = std::min(least2,
                              nearest_image(p.at(position, i) - p.at(position, j), sim.system().grid()).squaredNorm());
    return std::sqrt(least2);
}
/// How many there are after each step.
struct Census {
    std::vector<std::size_t> count;
    void begin(auto&) {}
    void step(auto& s) { count.push_back(s.particles().size()); }
    void end(auto&) {}
};

// Particle n is due at from + n / rate, and there at the next look.
TEST(Pour, ComesAtItsRate)
{
    auto sim = chamber();
    Pour pour(Box<2>{{0.2, 0.2}, {0.8, 0.8}}, {.rate = 1300, .from = 0.0051, .until = 0.0803, .every = 4});
    Census census;
    sim.run({.steps = 1000, .dt = dt}, pour, census);
    for (int n = 0; n < 1000; ++n) {
        const double look = n / 4 * 4 * dt; // before step n, counted from 0
        const int due = look < 0.0051 ? 0 : std::min(int((look - 0.0051) * 1300) + 1, 98); // 0.0752 * 1300 = 97.76
        ASSERT_EQ(census.count[std::size_t(n)], std::size_t(due)) << n;
    }
    EXPECT_EQ(pour.particles(), 98);
    EXPECT_EQ(pour.waiting(), 0);
    EXPECT_EQ(sim.exchanged().entered.particles, 98);
}
TEST(Pour, StopsAtSoMany)
{
    auto sim = chamber();
    Pour pour(Box<2>{{0.2, 0.2}, {0.8, 0.8}}, {.rate = 1e5, .most = 37, .every = 1});
    sim.run({.steps = 50, .dt = dt}, pour);
    EXPECT_EQ(sim.particles().size(), 37u);
}
TEST(Pour, NobodyTouchesAnybody)
{
    auto sim = chamber();
    sim.add({0.01, 0.5});
    Pour pour(Box<2>{{0, 0.4}, {1, 0.6}}, {.rate = 1e18, .most = 250, .every = 1, .tries = 500});
    sim.run({.steps = 2, .dt = 1e-12}, pour); // all at once, up to both periodic faces: about 40 % of the region
    EXPECT_GT(sim.particles().size(), 200u);
    EXPECT_GT(least_distance(sim), 2 * r);
    EXPECT_LT(least_distance(sim), 2.2 * r); // crowded
}
TEST(Pour, KeepsADistanceThatIsAskedFor)
{
    auto sim = chamber();
    Pour pour(Box<2>{{0, 0.4}, {1, 0.6}}, {.rate = 1e18, .most = 60, .apart = 0.05, .every = 1, .tries = 500});
    sim.run({.steps = 2, .dt = 1e-12}, pour);
    EXPECT_GT(sim.particles().size(), 30u);
    EXPECT_GT(least_distance(sim), 0.05);
}
// A region for one grain: the next one enters when there is room, and none is lost.
TEST(Pour, WaitsForRoom)
{
    auto sim = chamber();
    const Vec<2, double> spot{0.5, 0.5};
    Pour pour(Box<2>{spot, spot}, {.rate = 1000, .velocity = {1, 0}, .until = 0.1, .every = 1});
    sim.run({.steps = 501, .dt = dt}, pour); // a grain clears the spot in 20 ms: one every 20 ms and a step
    EXPECT_EQ(pour.particles(), 3);
    EXPECT_EQ(pour.particles() + pour.waiting(), 51);
    EXPECT_GT(least_distance(sim), 2 * r);
}
TEST(Pour, KeepsOffWalls)
{
    Simulation sim(dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k}), Leapfrog{},
                   Walls(Box<2>{{0, 0}, {0.2, 0.2}}, open(top), contact(LinearSpring{.k = k})), Serial{});
    Pour pour(Box<2>{{0, 0}, {0.2, 0.3}}, {.rate = 1e18, .most = 60, .every = 1, .tries = 100});
    sim.run({.steps = 2, .dt = 1e-12}, pour);
    ASSERT_GT(sim.particles().size(), 30u);
    double highest = 0;
    for (std::size_t i = 0; i < sim.particles().size(); ++i) {
        const auto x = sim.particles().at(position, i);
        EXPECT_GT(x[0], r);
        EXPECT_LT(x[0], 0.2 - r);
        EXPECT_GT(x[1], r);
        highest = std::max(highest, x[1]);
    }
    EXPECT_GT(highest, 0.2); // the top is open
    EXPECT_EQ(sim.energy().internal, 0);
}
TEST(Pour, GivesWhatTheUserGives)
{
    auto sim = chamber();
    std::vector<std::int64_t> numbers;
    double most = 0, least = 1;
    Pour pour(Box<2>{{0.1, 0.1}, {0.9, 0.9}}, {.rate = 1999, .velocity = {3, 0}, .seed = 5, .every = 10},
              [&](auto& p, std::size_t i, Draw& draw) {
                  if (numbers.empty() || numbers.back() != draw.number) numbers.push_back(draw.number);
                  const double u = draw();
                  most = std::max(most, u), least = std::min(least, u);
                  EXPECT_EQ(p.at(velocity, i)[0], 3);
                  p.put(velocity, i, {0, draw.late});
              });
    sim.run({.steps = 500, .dt = dt}, pour);
    ASSERT_EQ(numbers.size(), 98u); // 49 ms at 1999 a second, and the first
    for (std::size_t n = 0; n < numbers.size(); ++n) EXPECT_EQ(numbers[n], std::int64_t(n));
    EXPECT_GT(most, 0.9);
    EXPECT_LT(least, 0.1);
    for (std::size_t i = 0; i < sim.particles().size(); ++i) {
        const double late = sim.particles().at(velocity, i)[1], n = sim.particles().id()[i];
        EXPECT_NEAR(late, std::ceil(n / 1.999) * 1e-3 - n / 1999, 1e-12) << n; // looks are 1 ms apart
    }
}
TEST(Pour, PlacesFillTheRegionEvenly)
{
    auto sim = chamber();
    std::array<int, 9> in{};
    const double a = 0.1, b = 0.9;
    Pour pour(Box<2>{{a, a}, {b, b}}, {.rate = 1e18, .most = 900, .every = 1, .tries = 1},
              [&](auto& p, std::size_t i, Draw&) {
                  const auto x = p.at(position, i);
                  ++in[std::size_t(3 * int((x[0] - a) / (b - a) * 3) + int((x[1] - a) / (b - a) * 3))];
                  p.put(position, i, {0.5 + 1e-6 * double(i), 0.5}); // in nobody's way: they are only counted
              });
    sim.run({.steps = 900, .dt = 1e-12}, pour);
    double chi2 = 0, all = 0;
    for (int n : in) all += n;
    for (int n : in) chi2 += (n - all / 9) * (n - all / 9) / (all / 9);
    EXPECT_EQ(all, 900);
    EXPECT_LT(chi2, 26.1); // 8 degrees of freedom, one in a thousand
    EXPECT_GT(chi2, 0.86); // and not more even than chance
}
// Energy grows a hundredfold, but it is what grains bring; what Forward Euler makes of their contacts is no source.
TEST(Pour, TheWatchKnowsWhatItBrings)
{
    const Box<2> region{{0.1, 0.1}, {0.9, 0.9}};
    const PourOptions<2> flow{.rate = 5000};
    const auto to_all_sides = [](auto& p, std::size_t i, Draw& draw) {
        const double sign = draw() < 0.5 ? -1 : 1;
        p.put(velocity, i, draw() < 0.5 ? Vec<2, double>{2 * sign, 1} : Vec<2, double>{1, 2 * sign});
    };
    auto sim = chamber();
    sim.add({0.5, 0.1}, {0.2, 0});
    Pour pour(region, flow, to_all_sides);
    sim.run({.steps = 1000, .dt = dt}, pour);
    EXPECT_GT(pour.particles(), 300);
    EXPECT_NEAR(sim.exchanged().entered.energy, 0.5 * m * 5 * double(pour.particles()), 1e-9);
    EXPECT_LT(sim.report().energy_rise, 0.01);
    sim.make_lists_current();
    const double brought = 0.5 * m * 0.04 + sim.exchanged().entered.energy;
    EXPECT_NEAR(sim.energy().total(), brought, 0.005 * brought); // (omega dt)^2 / 4 of what is in contacts
    EXPECT_GT(sim.energy().internal, 0);

    auto runaway = chamber(chosen::forward_euler);
    runaway.add({0.5, 0.1}, {0.2, 0});
    Pour again(region, flow, to_all_sides);
    EXPECT_THROW(runaway.run({.steps = 1000, .dt = 2 * dt}, again), EnergyRunaway);
}
TEST(Pour, ChangesNothingBeforeItsTime)
{
    auto with = chamber(), without = chamber();
    for (auto* sim : {&with, &without})
        for (int n = 0; n < 10; ++n) sim->add({0.05 + 0.03 * n, 0.5}, {n % 2 - 0.5, 0});
    Pour pour(Box<2>{{0.1, 0.1}, {0.9, 0.9}}, {.rate = 1000, .from = 1, .every = 1});
    with.run({.steps = 300, .dt = dt}, pour);
    without.run({.steps = 300, .dt = dt});
    EXPECT_EQ(with.state_hash(), without.state_hash());
    EXPECT_EQ(with.system().rebuilds(), without.system().rebuilds());
}
TEST(Pour, RefusesWhatItCannotDo)
{
    auto sim = Simulation(dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k}), Leapfrog{},
                          Walls(Box<2>{{0, 0}, {1, 1}}, contact(LinearSpring{.k = k})), Serial{});
    sim.add({0.5, 0.5});
    const Box<2> region{{0.1, 0.1}, {0.9, 0.9}};
    auto refusal = [&](Box<2> const& box, PourOptions<2> const& o) -> std::string {
        Pour pour(box, o);
        try {
            sim.run({.steps = 1, .dt = dt}, pour);
        }
        catch (BadInput const& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_THAT(refusal(region, {.rate = 0}), HasSubstr("PourOptions.rate is 0"));
    EXPECT_THAT(refusal(region, {.rate = std::nan("")}), HasSubstr("PourOptions.rate is nan"));
    EXPECT_THAT(refusal(region, {.rate = 1, .from = 2, .until = 1}), HasSubstr("PourOptions.until is 1"));
    EXPECT_THAT(refusal(region, {.rate = 1, .most = -1}), HasSubstr("PourOptions.most is -1"));
    EXPECT_THAT(refusal(region, {.rate = 1, .apart = -1}), HasSubstr("PourOptions.apart is -1"));
    EXPECT_THAT(refusal(region, {.rate = 1, .every = 0}), HasSubstr("PourOptions.every is 0"));
    EXPECT_THAT(refusal(region, {.rate = 1, .tries = 0}), HasSubstr("PourOptions.tries is 0"));
    EXPECT_THAT(refusal({{0.5, 0.5}, {0.4, 0.6}}, {.rate = 1}), HasSubstr("Pour.region length along axis 0 is -0.1"));
    EXPECT_THAT(refusal({{0.5, 0.5}, {0.6, 1.25}}, {.rate = 1}),
                HasSubstr("the distance of Pour.region beyond a wall is 0.25"));
    Pour heavy(region, {.rate = 1}, [](auto& p, std::size_t i, Draw&) { p.put(velocity, i, {std::nan(""), 0}); });
    EXPECT_THROW(sim.run({.steps = 1, .dt = dt}, heavy), BadInput);
}

/// The last row of a history by the names of its columns, and its first.
std::array<std::map<std::string, double>, 2> ends_of(std::filesystem::path const& file)
{
    std::ifstream in(file);
    std::vector<std::vector<std::string>> rows;
    for (std::string line, cell; std::getline(in, line);) {
        rows.emplace_back();
        for (std::istringstream cells(line); std::getline(cells, cell, ',');) rows.back().push_back(cell);
    }
    std::array<std::map<std::string, double>, 2> ends;
    for (std::size_t c = 0; c < rows.at(0).size(); ++c) {
        if (rows[0][c] == "dt_criterion") continue;
        ends[0][rows[0][c]] = std::stod(rows.at(1).at(c));
        ends[1][rows[0][c]] = std::stod(rows.back().at(c));
    }
    return ends;
}
// Grains fall through a window: they enter above it and leave below.
TEST(Pour, HistoryBalancesMassMomentumAndEnergy)
{
    const auto folder = std::filesystem::temp_directory_path() / ("spate_pour_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    auto sim = Simulation(dem<2>({.mass = m, .radius = r}, LinearSpring{.k = k}, Gravity<2>{{0, -g}}), Leapfrog{},
                          Open{}, Serial{});
    for (int n = 0; n < 5; ++n) sim.add({0.05 * n, 0.2});
    Pour pour(Box<2>{{0, 0.4}, {0.2, 0.5}}, {.rate = 2000, .velocity = {0.3, -1}, .until = 0.25});
    Outlet out(HalfSpace<2>{{0, 0}, {0, 1}});
    sim.run({.steps = 500, .dt = dt}, pour, out); // not all before the first row is nothing
    sim.run({.steps = 2500, .dt = dt}, pour, out, io::History(folder, 0.01, exchanged_columns<2>()));
    const auto [first, last] = ends_of(folder / "history.csv");
    std::filesystem::remove_all(folder);
    ASSERT_GT(first.at("entered_particles"), 50);
    ASSERT_GT(last.at("left_particles"), 50);
    auto change = [&, first = first, last = last](std::string const& name) { return last.at(name) - first.at(name); };
    const double mass_unit = m * double(pour.particles()), momentum_unit = 3 * mass_unit;
    EXPECT_NEAR(last.at("entered_mass"), m * last.at("entered_particles"), 1e-12 * mass_unit);
    EXPECT_EQ(5 + last.at("entered_particles") - last.at("left_particles"), double(sim.particles().size()));
    for (std::string axis : {"_x", "_y"})
        EXPECT_NEAR(change("momentum" + axis),
                    change("gravity_impulse" + axis) + change("entered_momentum" + axis) -
                        change("left_momentum" + axis),
                    1e-11 * momentum_unit)
            << axis;
    const double energy = change("kinetic") + change("potential") + change("elastic");
    const double brought = change("entered_energy") - change("left_energy");
    EXPECT_GT(std::abs(brought), 1);
    EXPECT_NEAR(last.at("dissipated"), brought - energy, 1e-11);
    EXPECT_NEAR(last.at("dissipated"), 0, 0.005 * (std::abs(brought) + last.at("kinetic")));
}

} // namespace
