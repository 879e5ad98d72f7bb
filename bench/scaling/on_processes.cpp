// SPDX-License-Identifier: BSD-3-Clause
// Whole scenes on the processes of mpirun: time a step, where it goes, and a diary of one step. One line of JSON.
#include "../support/developed.hpp"
#include "counting.hpp"
#include "noted.hpp"

#include <spate/backend/mpi.hpp>
#include <spate/backend/virtual_ranks.hpp>

#include <cstdlib>
#include <iostream>

namespace {

using namespace bench;

using Transport = Noted<Counting<MpiRanks>>;
using Workers = OnRank<Transport, Watched<Threads>>;

struct Options {
    std::string scene = "big", diary;
    int steps = 40, repeats = 2, cell = 0, threads = 1;
    bool patient = false, balance = true;
    double delay = 0;
};

/// The least time of a stretch over repeats, and what was counted in the last of them.
struct Found {
    std::vector<double> wall; ///< of each ten steps [s]
    double busy = 0, idle = 0, whole = 0;
    std::int64_t reach = 0; ///< particles that tasks read in an evaluation
    std::int64_t early = 0, tasks = 0, messages = 0, bytes = 0, moved = 0, cuts = 0, rebuilds = 0, pairs = 0;
    double imbalance = 1, markers = 0, dt = 0;
    std::vector<double> first{0, 0}, values{0, 0}; ///< by species: particles sent with the first lists; values of each
    Asked asked;
};

/// How many particles of a species are sent with the lists of now, and how many values of each.
template <class Sim>
void sent_of_each(Sim& sim, RunOptions const& run, Found& f)
{
    auto const& s = sim.system();
    std::vector<double> particles(2, 0);
    s.each_species([&](auto q) {
        for (auto const& l : s.parts().halo(q()).out()) particles[std::size_t(q())] += double(l.particle.size());
    });
    const auto before = s.ranks().on.asked();
    const auto rebuilds = s.rebuilds();
    sim.step(run);
    if (s.rebuilds() != rebuilds) return; // the lists of then are gone
    const auto asked = s.ranks().on.asked() - before;
    f.first = particles;
    for (std::size_t q = 0; q < 2; ++q)
        if (particles[q] > 0)
            f.values[q] = double(asked.bytes[q]) / double(asked.exchanges[q]) / particles[q] / sizeof(double);
}

/// What the tasks of an evaluation read.
void reach_of_cells(auto const& s, Found& f)
{
    f.reach = 0;
    s.each_species([&](auto t) {
        auto const& bins = s.template species<t()>().bins;
        for (std::size_t k = 0; k < bins.cells(); ++k)
            s.each_species([&](auto q) {
                auto const& lists = s.template lists<t(), q()>();
                if (lists.pairs() > 0 && lists.of_cell(k).pairs > 0)
                    f.reach +=
                        in_reach(bins.cell(k), s.template species<q()>().bins, s.parts().halo(q()).bins(), s.grid());
            });
    });
}

template <class Make>
Found measure(Make const& make, RunOptions const& run, Options const& o, Diary& diary, MpiRanks const& ranks)
{
    Found f;
    for (int repeat = 0; repeat < o.repeats; ++repeat) {
        auto sim = make();
        auto const& s = sim.system();
        sim.step(run);
        sent_of_each(sim, run, f);
        for (int k = 0; k < 8; ++k) sim.step(run); // balance has something to look at
        const auto before = s.parts().report();
        const auto asked = s.ranks().on.asked();
        const auto pairs = s.pairs_evaluated(), rebuilds = s.rebuilds();
        const double time = sim.time();
        double whole = 0;
        for (int k = 0; k < o.steps; k += 10) {
            const double start = Diary::now();
            for (int n = 0; n < 10; ++n) sim.step(run);
            const double wall = ranks.all(Diary::now() - start, agree::Most{});
            whole += wall;
            if (std::size_t(k / 10) == f.wall.size()) f.wall.push_back(wall);
            f.wall[std::size_t(k / 10)] = std::min(f.wall[std::size_t(k / 10)], wall);
        }
        auto const& r = s.parts().report();
        f.busy = r.busy - before.busy, f.idle = r.idle - before.idle, f.whole = whole;
        f.early = r.early - before.early, f.tasks = r.tasks - before.tasks, f.messages = r.messages - before.messages;
        f.bytes = r.bytes - before.bytes, f.moved = r.moved - before.moved, f.cuts = r.cuts, f.imbalance = r.imbalance;
        f.asked = s.ranks().on.asked() - asked;
        f.rebuilds = s.rebuilds() - rebuilds, f.pairs = s.pairs_evaluated() - pairs, f.markers = double(s.total());
        f.dt = (sim.time() - time) / o.steps;
        reach_of_cells(s, f);
        if (!o.diary.empty() && repeat == 0) {
            Diary shortest; // of ten steps: the one that others have disturbed least
            double least = std::numeric_limits<double>::infinity();
            for (int k = 0; k < 10; ++k) {
                diary.entries.clear(), diary.open = true;
                const double start = Diary::now();
                sim.step(run);
                diary.open = false;
                const double took = ranks.all(Diary::now() - start, agree::Most{});
                if (took < least) least = took, shortest.entries = diary.entries;
            }
            diary.entries = shortest.entries;
        }
    }
    return f;
}

Found of_scene(Options const& o, Diary& diary, MpiRanks const& ranks)
{
    Balance balance;
    if (!o.balance) balance.every = 0;
    const Workers workers{Transport{Counting(ranks), &diary, o.patient, o.delay},
                          Watched<Threads>{Threads{.count = o.threads}, &diary}, o.cell, balance};
    if (o.scene == "seed") return measure([&] { return seed_dam_on(workers); }, {.dt = 1e-4}, o, diary, ranks);
    if (o.scene == "granular") return measure([&] { return granular_deck_on(workers); }, {.dt = 1e-4}, o, diary, ranks);
    const auto big = [&] {
        auto dam = big_dam_on(workers);
        Developed::flow().put_into(dam);
        return dam;
    };
    return measure(big, like_dam_break, o, diary, ranks);
}

/// Half the time of a message there and back between ranks 0 and 1 [s].
double ping_pong(MpiRanks const& ranks, std::size_t bytes)
{
    std::vector<std::byte> there(bytes), back(bytes);
    const int me = ranks.rank(), other = 1 - me;
    double least = me < 2 ? 1 : 0;
    for (int repeat = 0; repeat < 300 && me < 2; ++repeat) {
        const double start = Diary::now();
        const Packet out{other, there}, in{other, back};
        for (int k = 0; k < 2; ++k) {
            const bool mine = (k == 0) == (me == 0);
            auto flight = mine ? ranks.exchange(std::span(&out, 1), {}, 7) : ranks.exchange({}, std::span(&in, 1), 7);
            while (flight.next() >= 0) {}
        }
        least = std::min(least, (Diary::now() - start) / 2);
    }
    return ranks.all(least, agree::Most{});
}
double reduction(MpiRanks const& ranks)
{
    double least = 1;
    for (int repeat = 0; repeat < 300; ++repeat) {
        const double start = Diary::now();
        (void)ranks.all(start, agree::Most{});
        least = std::min(least, Diary::now() - start);
    }
    return ranks.all(least, agree::Most{});
}

template <class T>
std::string list(std::vector<T> const& values)
{
    std::string s = "[";
    for (auto const& v : values) s += (s.size() > 1 ? "," : "") + std::to_string(v);
    return s + "]";
}

void tell(Options const& o, Found const& f, MpiRanks const& ranks)
{
    double sum = 0;
    for (const double w : f.wall) sum += w;
    const auto busy = shared(ranks, std::vector<double>{f.busy / f.whole});
    const auto idle = shared(ranks, std::vector<double>{f.idle / f.whole});
    const auto total = [&](std::int64_t n) { return ranks.all(n, agree::Sum{}); };
    const auto early = total(f.early), tasks = total(f.tasks), messages = total(f.messages), bytes = total(f.bytes);
    const auto reach = total(f.reach);
    const auto moved = total(f.moved), wide = total(f.asked.wide), reductions = total(f.asked.reductions);
    const auto reduced = total(f.asked.reduced), scatters = total(f.asked.scatters), parcels = total(f.asked.parcels);
    const auto sent = total(f.asked.sent), patches = total(f.asked.exchanges[2]), boxes = total(f.asked.bytes[2]);
    const auto first = shared(ranks, f.first), values = shared(ranks, f.values);
    const double small = ranks.count() > 1 ? ping_pong(ranks, 8) : 0,
                 large = ranks.count() > 1 ? ping_pong(ranks, 1 << 20) : 0;
    const double agreed = reduction(ranks);
    if (ranks.rank() != 0) return;
    std::cout << "{\"scene\": \"" << o.scene << "\", \"ranks\": " << ranks.count() << ", \"threads\": " << o.threads
              << ", \"cell\": " << o.cell << ", \"patient\": " << o.patient << ", \"delay\": " << o.delay
              << ", \"steps\": " << o.steps << ", \"ms_step\": " << 1e3 * sum / o.steps
              << ", \"markers\": " << f.markers << ", \"pairs\": " << f.pairs << ", \"rebuilds\": " << f.rebuilds
              << ", \"dt\": " << f.dt << ", \"busy\": " << list(busy) << ", \"idle\": " << list(idle)
              << ", \"early\": " << early << ", \"tasks\": " << tasks << ", \"reach\": " << reach
              << ", \"reach\": " << reach << ", \"messages\": " << messages << ", \"bytes\": " << bytes
              << ", \"moved\": " << moved << ", \"cuts\": " << f.cuts << ", \"imbalance\": " << f.imbalance
              << ", \"reductions\": " << reductions << ", \"reduced\": " << reduced << ", \"wide\": " << wide
              << ", \"scatters\": " << scatters << ", \"parcels\": " << parcels << ", \"sent\": " << sent
              << ", \"patch_exchanges\": " << patches << ", \"patch_bytes\": " << boxes
              << ", \"first\": " << list(first) << ", \"values\": " << list(values) << ", \"latency\": " << small
              << ", \"megabyte\": " << large << ", \"agreement\": " << agreed << "}\n";
}

void write(Diary const& diary, std::string const& file, MpiRanks const& ranks)
{
    std::ofstream to(file + "_" + std::to_string(ranks.rank()) + ".csv");
    to.precision(12);
    to << "kind,tag,begin,end\n";
    for (auto const& e : diary.entries) to << int(e.kind) << ',' << e.tag << ',' << e.begin << ',' << e.end << '\n';
}

} // namespace

/// on_processes KEY=VALUE...: scene big|seed|granular, steps, repeats, cell, threads, patient, delay, balance, diary FILE
int main(int argc, char** argv)
{
    Options o;
    for (int k = 1; k < argc; ++k) {
        const std::string word = argv[k], key = word.substr(0, word.find('=')), value = word.substr(word.find('=') + 1);
        if (key == "scene") o.scene = value;
        else if (key == "steps") o.steps = std::stoi(value);
        else if (key == "repeats") o.repeats = std::stoi(value);
        else if (key == "cell") o.cell = std::stoi(value);
        else if (key == "threads") o.threads = std::stoi(value);
        else if (key == "patient") o.patient = value == "1";
        else if (key == "balance") o.balance = value == "1";
        else if (key == "delay") o.delay = std::stod(value);
        else if (key == "diary") o.diary = value;
        else {
            std::cerr << "on_processes: there is no option " << key << '\n';
            return 2;
        }
    }
    const MpiRanks ranks;
    Diary diary;
    const Found f = of_scene(o, diary, ranks);
    tell(o, f, ranks);
    if (!o.diary.empty()) write(diary, o.diary, ranks);
}
