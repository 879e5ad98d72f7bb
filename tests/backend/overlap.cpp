// SPDX-License-Identifier: BSD-3-Clause
// Target cells are computed while messages are on their way; when messages come changes the order of tasks and no bit.
#include "spate/backend/virtual_ranks.hpp"
#include "spate/spate.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;

/// Tasks done since values were sent for which messages are still awaited, by the order of events on a rank.
struct Log {
    std::int64_t tasks = 0;           ///< all
    std::int64_t since = 0;           ///< since the last exchange began
    std::int64_t before_the_last = 0; ///< between the beginning of an exchange and the last message of it
    int missing = 0;                  ///< messages
    bool any_came = true;             ///< of the exchange of water
    std::int64_t before_water = 0;    ///< tasks from sending water to the first message of others' water, the most
};
/// When a message is there: as soon as it was sent; not before the rank has nothing left to do; before it does anything.
enum class Comes { soon, late, at_once };

template <class R>
struct Logged {
    static constexpr bool alone = false;
    static constexpr const char* name = R::name;
    R on;
    Log* log;
    Comes comes;

    [[nodiscard]] int rank() const { return on.rank(); }
    [[nodiscard]] int count() const { return on.count(); }
    template <class T>
    [[nodiscard]] T all(T mine, auto const& merge) const
    {
        return on.all(std::move(mine), merge);
    }
    void each(auto& values, auto const& merge) const { on.each(values, merge); }
    [[nodiscard]] auto scatter(std::vector<Parcel> parcels) const { return on.scatter(std::move(parcels)); }

    using Inner = std::remove_cvref_t<decltype(std::declval<R const&>().exchange({}, {}, 0))>;
    struct Flown {
        Inner inner;
        Log* log;
        Comes comes;
        bool water;
        std::vector<int> known = {};

        int named(int k)
        {
            if (k >= 0 && --log->missing == 0) log->before_the_last += log->since;
            if (k >= 0 && water && !log->any_came) {
                log->any_came = true;
                log->before_water = std::max(log->before_water, log->since);
            }
            return k;
        }
        int taken()
        {
            if (known.empty()) return -1;
            const int k = known.back();
            known.pop_back();
            return k;
        }
        int poll() { return comes == Comes::soon ? named(inner.poll()) : comes == Comes::late ? -1 : taken(); }
        int next() { return comes == Comes::at_once ? taken() : named(inner.next()); }
    };
    [[nodiscard]] Flown exchange(std::span<Packet const> out, std::span<Packet const> in, int tag) const
    {
        Flown flown{on.exchange(out, in, tag), log, comes, tag == 0};
        if (flown.water) log->any_came = in.empty();
        if (log->missing == 0) log->since = 0;
        log->missing += int(in.size());
        if (comes == Comes::at_once)
            for (int k; (k = flown.named(flown.inner.next())) >= 0;) flown.known.push_back(k);
        return flown;
    }
};
struct LoggedTasks {
    Log* log;
    [[maybe_unused]] static constexpr const char* name = "logged";
    static constexpr int threads() { return 1; }
    static void check() {}
    void for_each(std::size_t tasks, auto const& run) const
    {
        for (std::size_t k = 0; k < tasks; ++k) run(k), ++log->tasks, ++log->since;
    }
};

struct Seen {
    std::vector<std::int64_t> before, early; ///< by rank: tasks before the last message; as the engine counts them
    std::uint64_t hash = 0;
};
Seen block(Comes comes)
{
    constexpr int ranks = 4;
    Seen seen{std::vector<std::int64_t>(ranks, 0), std::vector<std::int64_t>(ranks, 0)};
    VirtualRanks(ranks).run([&](auto rank) {
        constexpr double dx = 0.02;
        Log log;
        auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 30}, Continuity<2>{},
                           PressureForce<2>{}, ArtificialViscosity{.alpha = 0.1});
        Simulation sim(
            water, RungeKutta2{}, Open{},
            OnRank{Logged<decltype(rank)>{rank, &log, comes}, LoggedTasks{&log}, 1, Balance{.by_pairs = true}});
        sim.fill(Box<2>{{}, {{1, 1}}}, dx, [&](auto& p, std::size_t i) {
            const auto x = p.at(position, i);
            p.put(velocity, i, {std::sin(6 * x[1]), std::sin(6 * x[0])});
        });
        sim.run({.steps = 30, .cfl = 0.2});
        const auto r = std::size_t(rank.rank());
        seen.before[r] = log.before_the_last;
        seen.early[r] = sim.system().parts().report().early;
        const auto hash = sim.state_hash();
        if (r == 0) seen.hash = hash;
    });
    return seen;
}
TEST(Overlap, TargetCellsRunBeforeTheLastMessageHasCome)
{
    const Seen soon = block(Comes::soon), late = block(Comes::late), at_once = block(Comes::at_once);
    for (std::size_t r = 0; r < 4; ++r) {
        // However late messages are, a rank does all that needs none of them; more than it does where they come soon.
        EXPECT_GT(late.early[r], 0) << r;
        EXPECT_GE(late.early[r], soon.early[r]) << r;
        EXPECT_GE(late.before[r], late.early[r]) << r;
        EXPECT_EQ(at_once.early[r], 0) << r;
        EXPECT_EQ(at_once.before[r], 0) << r;
    }
    EXPECT_GT(soon.early[0], 0); // the first to run: nothing can have come
    EXPECT_EQ(soon.hash, late.hash);
    EXPECT_EQ(soon.hash, at_once.hash);
}
// Walls wait for water, and water for walls. A rank does not idle meanwhile: cells of water that see no wall need neither.
TEST(Overlap, WaterRunsWhileWallsWait)
{
    auto full_tank = [](auto backend) {
        constexpr double dx = 0.02;
        auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 30}, Continuity<2>{},
                           PressureForce<2>{}, ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -9.81}});
        Simulation sim(water, RungeKutta2{}, Bce(Box<2>{{}, {{1, 1}}}, dx, Adami{}, open(top)), backend);
        sim.fill(Box<2>{{}, {{1, 1}}}, dx, hydrostatic);
        sim.run({.steps = 20, .cfl = 0.2});
        return sim;
    };
    const auto hash = full_tank(Serial{}).state_hash();
    std::array<std::int64_t, 4> tasks{}; // of a rank, where nothing runs ahead
    for (const Comes comes : {Comes::at_once, Comes::soon, Comes::late})
        VirtualRanks(4).run([&](auto rank) {
            Log log;
            const auto sim = full_tank(
                OnRank{Logged<decltype(rank)>{rank, &log, comes}, LoggedTasks{&log}, 1, Balance{.by_pairs = true}});
            const auto walls = std::int64_t(sim.system().template species<1>().bins.cells());
            EXPECT_GT(walls, 0);
            if (comes == Comes::late) {
                EXPECT_GT(log.before_water, 2 * walls);
            }
            if (comes == Comes::at_once) {
                EXPECT_EQ(log.before_water, 0);
                tasks[std::size_t(rank.rank())] = log.tasks;
            }
            EXPECT_EQ(log.tasks, tasks[std::size_t(rank.rank())]); // none runs twice
            EXPECT_EQ(sim.state_hash(), hash);
        });
}
// Where all water sees a wall, so that all waits for markers that wait for water: cells whose walls are our own, and have all that
// they need, run as soon as these are made.
TEST(Overlap, WaterRunsBetweenWallsOfItsOwn)
{
    auto sheet = [](auto backend) {
        constexpr double dx = 0.02;
        auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 30}, Continuity<2>{},
                           PressureForce<2>{}, ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -9.81}});
        Simulation sim(water, RungeKutta2{}, Bce(Box<2>{{}, {{4, 1}}}, dx, Adami{}, open(top)), backend);
        sim.fill(Box<2>{{}, {{4, 2 * dx}}}, dx, hydrostatic);
        sim.run({.steps = 20, .cfl = 0.2});
        return sim;
    };
    const auto hash = sheet(Serial{}).state_hash();
    for (const Comes comes : {Comes::at_once, Comes::soon, Comes::late})
        VirtualRanks(3).run([&](auto rank) {
            Log log;
            const auto sim = sheet(
                OnRank{Logged<decltype(rank)>{rank, &log, comes}, LoggedTasks{&log}, 1, Balance{.by_pairs = true}});
            auto const& system = sim.system();
            const auto walls = std::int64_t(system.template species<1>().bins.cells());
            const auto cells = system.template species<0>().bins.cells();
            for (std::size_t k = 0; k < cells; ++k)
                EXPECT_FALSE((system.template lists<0, 1>().of_cell(k).index.empty())) << k; // all see a wall
            if (comes == Comes::late) {
                EXPECT_GT(log.before_water, walls); // tasks of walls alone would be fewer
            }
            EXPECT_EQ(sim.state_hash(), hash);
        });
}
// Markers at a periodic face have images on their own rank, which are made with the cell that they are images of.
TEST(Overlap, ImagesOfWallsAreMadeWithTheirCells)
{
    auto between_plates = [](auto backend) {
        constexpr double dx = 0.02;
        auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = 30}, Continuity<2>{},
                           PressureForce<2>{}, ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{-5, 3}});
        Simulation sim(water, RungeKutta2{}, Bce(Box<2>{{}, {{1, 0.4}}}, dx, Adami{}, periodic(y_axis)), backend);
        sim.fill(Box<2>{{}, {{1, 0.4}}}, dx, hydrostatic);
        sim.run({.steps = 20, .cfl = 0.2});
        return sim;
    };
    const auto hash = between_plates(Serial{}).state_hash();
    for (const Comes comes : {Comes::at_once, Comes::soon, Comes::late})
        VirtualRanks(2).run([&](auto rank) {
            Log log;
            const auto sim = between_plates(
                OnRank{Logged<decltype(rank)>{rank, &log, comes}, LoggedTasks{&log}, 1, Balance{.by_pairs = true}});
            EXPECT_FALSE(sim.system().template species<1>().bins.images().of.empty());
            EXPECT_EQ(sim.state_hash(), hash);
        });
}

} // namespace
