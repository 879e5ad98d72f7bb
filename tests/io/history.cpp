// SPDX-License-Identifier: BSD-3-Clause
#include "spate/io/history.hpp"

#include <map>
#include <sstream>

#include "io/small_tank.hpp"
#include "spate/measure/front.hpp"
#include "spate/measure/probe.hpp"
#include "spate/measure/wall_force.hpp"

namespace {

using namespace spate;
using io::History;
using small_tank::dx;

struct Table {
    std::vector<std::string> names;
    std::vector<std::map<std::string, std::string>> rows;

    double at(std::size_t row, std::string const& name) const { return std::stod(rows.at(row).at(name)); }
};

std::vector<std::string> cells(std::string const& line)
{
    std::vector<std::string> all;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) all.push_back(cell);
    return all;
}
Table parsed(std::string const& text)
{
    std::istringstream in(text);
    std::string line;
    std::getline(in, line);
    Table t{cells(line), {}};
    while (std::getline(in, line)) {
        const auto values = cells(line);
        EXPECT_EQ(values.size(), t.names.size()) << line;
        auto& row = t.rows.emplace_back();
        for (std::size_t k = 0; k < std::min(values.size(), t.names.size()); ++k) row[t.names[k]] = values[k];
    }
    return t;
}

class HistoryTest : public small_tank::InFolder {
protected:
    Table table() const { return parsed(content(folder / "history.csv")); }
};

TEST_F(HistoryTest, HasTheStateOfTheSceneInEachRow)
{
    auto tank = small_tank::scene();
    const Probe floor{"p_floor", pressure, Vec<2, double>{0.25, 0}};
    History history(folder, 0, Front{dx}, WallForce{}, floor);
    tank.run({.steps = 7}, history);
    const Table t = table();
    const std::vector<std::string> names{"step",
                                         "t",
                                         "dt",
                                         "dt_criterion",
                                         "kinetic",
                                         "potential",
                                         "compressive",
                                         "dissipated",
                                         "momentum_x",
                                         "momentum_y",
                                         "volume",
                                         "gravity_impulse_x",
                                         "gravity_impulse_y",
                                         "wall_impulse_x",
                                         "wall_impulse_y",
                                         "max_speed",
                                         "density_min",
                                         "density_max",
                                         "front",
                                         "wall_force_x",
                                         "wall_force_y",
                                         "p_floor"};
    EXPECT_EQ(t.names, names);
    ASSERT_EQ(t.rows.size(), 8u); // the start and each step
    EXPECT_EQ(t.at(0, "t"), 0);
    EXPECT_EQ(t.at(0, "front"), 0.5);
    // The last row, bit for bit: the shortest decimals read back as the same numbers.
    tank.refresh();
    const auto e = tank.energy();
    const auto x = tank.system().extremes();
    EXPECT_EQ(t.rows[7].at("step"), "7");
    EXPECT_EQ(t.at(7, "t"), tank.time());
    EXPECT_EQ(t.at(7, "dt"), tank.dt());
    EXPECT_EQ(t.rows[7].at("dt_criterion"), tank.criterion());
    EXPECT_EQ(t.at(7, "kinetic"), e.kinetic);
    EXPECT_EQ(t.at(7, "potential"), e.potential);
    EXPECT_EQ(t.at(7, "compressive"), e.internal);
    EXPECT_EQ(t.at(7, "momentum_x"), tank.momentum()[0]);
    EXPECT_EQ(t.at(7, "momentum_y"), tank.momentum()[1]);
    EXPECT_EQ(t.at(7, "max_speed"), x.speed);
    EXPECT_EQ(t.at(7, "density_min"), x.least_density);
    EXPECT_EQ(t.at(7, "density_max"), x.most_density);
    EXPECT_EQ(t.at(7, "front"), Front{dx}(tank));
    EXPECT_EQ(t.at(7, "wall_force_y"), WallForce{}(tank)[1]);
    EXPECT_EQ(t.at(7, "p_floor"), floor(tank));
    EXPECT_GT(e.kinetic, 0);
    for (std::size_t k = 0; k < 8; ++k)
        EXPECT_EQ(t.at(k, "dissipated"), t.at(0, "kinetic") + t.at(0, "potential") + t.at(0, "compressive") -
                                             (t.at(k, "kinetic") + t.at(k, "potential") + t.at(k, "compressive")));
}

/// The largest imbalance of momentum - momentum at the start - impulses in a stirred tank, over 0.02 s in steps of dt.
double imbalance(std::filesystem::path const& folder, double dt, Table& t)
{
    auto tank = small_tank::scene();
    auto& p = tank.particles();
    for (std::size_t i = 0; i < p.size(); ++i)
        p.put(velocity, i, Vec<2, double>{std::sin(9 * p.at(position, i)[1]), std::cos(7 * p.at(position, i)[0])});
    History history(folder, 0);
    tank.run({.until = 0.02, .dt = dt}, history);
    std::ifstream in(folder / "history.csv", std::ios::binary);
    t = parsed({std::istreambuf_iterator<char>(in), {}});
    double worst = 0;
    for (std::size_t k = 0; k < t.rows.size(); ++k)
        for (std::string c : {"_x", "_y"})
            worst = std::max(worst, std::abs(t.at(k, "momentum" + c) - t.at(0, "momentum" + c) -
                                             t.at(k, "gravity_impulse" + c) - t.at(k, "wall_impulse" + c)));
    return worst;
}
// The walls' impulse is by the trapezoidal rule and the run by a midpoint rule: they differ by the second order of dt.
TEST_F(HistoryTest, BalancesMomentumWithTheImpulsesOfGravityAndWalls)
{
    Table t;
    const double coarse = imbalance(folder, 1 / 8192.0, t), fine = imbalance(folder, 1 / 16384.0, t);
    const std::size_t last = t.rows.size() - 1;
    const double weight = 1000 * 0.5 * 0.5 * 9.81; // [N/m]
    EXPECT_NEAR(t.at(last, "gravity_impulse_y"), -weight * 0.02, 1e-12 * weight);
    EXPECT_GT(std::abs(t.at(last, "wall_impulse_y")), 0.1 * weight * 0.02);
    EXPECT_LE(fine, 1e-3 * weight * 0.02);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.5);
}
// A floor that shakes does work, and the column says that it is in it.
TEST_F(HistoryTest, NamesWhatIsDriven)
{
    auto heads = [&](auto... options) {
        auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 30}, Continuity<2>{},
                           PressureForce<2>{}, Gravity<2>{{0, -9.81}});
        Simulation tank(water, RungeKutta2{}, Bce(Box<2>{{0, 0}, {1, 1}}, dx, Adami{}, open(top), options...),
                        Serial{});
        tank.fill(Box<2>{{0, 0}, {1, 0.5}}, dx);
        History history(folder, 0);
        tank.run({.steps = 1}, history);
        return table().names.at(7);
    };
    EXPECT_EQ(heads(), "dissipated");
    EXPECT_EQ(heads(moving(Oscillation<2>{.amplitude = {0, 0.1}, .omega = 1})), "dissipated_less_work");
}
// Mass over density, exact: a lattice at the densities of its depth has a little less than its box.
TEST_F(HistoryTest, HasTheVolume)
{
    auto tank = small_tank::scene();
    History history(folder, 0);
    tank.run({.steps = 3}, history);
    double volume = 0;
    auto const& p = tank.particles();
    for (std::size_t i = 0; i < p.size(); ++i) volume += p.at(mass, i) / p.at(density, i);
    EXPECT_NEAR(table().at(3, "volume"), volume, 1e-14);
    EXPECT_NEAR(volume, 0.25, 0.25 * 9.81 * 0.5 / (30 * 30));
    EXPECT_LT(volume, 0.25);
}

// The first step at or after each multiple, the start and the end; no step is cut for it.
TEST_F(HistoryTest, IsWrittenAtEvenTimes)
{
    auto tank = small_tank::scene();
    const double dt = 1 / 4096.0;
    History history(folder, 2.5 * dt);
    tank.run({.steps = 9, .dt = dt}, history);
    const Table t = table();
    std::vector<double> steps;
    for (std::size_t k = 0; k < t.rows.size(); ++k) steps.push_back(t.at(k, "t") / dt);
    EXPECT_EQ(steps, (std::vector<double>{0, 3, 5, 8, 9}));
    EXPECT_FALSE(std::filesystem::exists(folder / "history.csv.tmp"));
}

TEST_F(HistoryTest, ChangesNoBitOfTheRun)
{
    auto with = small_tank::scene(), without = small_tank::scene();
    History history(folder, 0, WallForce{});
    with.run({.steps = 40}, history);
    without.run({.steps = 40});
    EXPECT_EQ(with.state_hash(), without.state_hash());
    EXPECT_EQ(with.time(), without.time());
    EXPECT_EQ(with.system().rebuilds(), without.system().rebuilds());
    EXPECT_EQ(with.system().evaluations(), without.system().evaluations());
}

TEST_F(HistoryTest, GoesOnInASecondRun)
{
    auto tank = small_tank::scene();
    History history(folder, 0);
    for (int run = 0; run < 2; ++run) tank.run({.steps = 3}, history);
    const Table t = table();
    ASSERT_EQ(t.rows.size(), 7u);
    for (std::size_t n = 0; n < 7; ++n) EXPECT_EQ(t.at(n, "step"), double(n));
}

/// An output that ends the run with a stop.
struct StopAt {
    std::int64_t at;
    void begin(auto&) {}
    void step(auto const& scene) const
    {
        if (scene.steps() == at) throw NonFinite(StopFacts{});
    }
    void end(auto&) {}
};

TEST_F(HistoryTest, IsWholeAfterAStop)
{
    auto tank = small_tank::scene();
    History history(folder, 0);
    EXPECT_THROW(tank.run({.steps = 9}, history, StopAt{4}), NonFinite);
    EXPECT_EQ(table().rows.size(), 5u);
    EXPECT_TRUE(tank.stopped());
}

/// An output that fails as a full disk does.
struct FailAt : StopAt {
    void step(auto const& scene) const
    {
        if (scene.steps() == at) throw OutputError("x", ENOSPC);
    }
};

TEST_F(HistoryTest, KeepsItsRowsIfAnotherOutputFails)
{
    std::ofstream(folder / "history.csv") << "old\n";
    {
        auto tank = small_tank::scene();
        History history(folder, 0);
        EXPECT_THROW(tank.run({.steps = 9}, history, FailAt{4}), OutputError);
    }
    EXPECT_EQ(content(folder / "history.csv"), "old\n");
    EXPECT_EQ(parsed(content(folder / "history.csv.tmp")).rows.size(), 5u);
}

TEST_F(HistoryTest, RefusesColumnsThatCannotBeToldApart)
{
    auto tank = small_tank::scene();
    auto refuses = [&](auto const& column, auto const& other) {
        History history(folder, 0, column, other);
        EXPECT_THROW(tank.run({.steps = 1}, history), BadInput);
    };
    refuses(Front{dx}, Front{dx});
    refuses(Front{dx}, Front{.spacing = dx, .name = "kinetic"});
    refuses(Front{dx}, Front{.spacing = dx, .name = "a,b"});
    EXPECT_TRUE(std::filesystem::is_empty(folder));
    EXPECT_THROW(History(folder, -1.0), BadInput);
    EXPECT_THROW(History(folder, std::nan("")), BadInput);
}

TEST_F(HistoryTest, SaysThatItCannotBeWritten)
{
    auto tank = small_tank::scene();
    History history(folder / "not_there", 0);
    try {
        tank.run({.steps = 1}, history);
        FAIL();
    }
    catch (OutputError const& e) {
        EXPECT_NE(std::string(e.what()).find("history.csv (No such file or directory)"), std::string::npos) << e.what();
    }
}

} // namespace
