// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A scene cut over ranks: which cells are at home here, who borders on whom, what is on its way. Knows particles
/// and records, but no physics.
#pragma once

#include "spate/cells/cell_pairs.hpp"
#include "spate/cells/halo.hpp"
#include "spate/cells/pair_memory.hpp"
#include "spate/physics/sweep.hpp"

#include <chrono>
#include <ctime>
#include <functional>
#include <map>
#include <optional>

namespace spate {

/// What a rank has done for and with others, so far.
struct RankReport {
    double busy = 0;              ///< in tasks of cells [s]
    double idle = 0;              ///< in waiting for messages of others with nothing left to do [s]
    std::int64_t early = 0;       ///< tasks of cells that ran while messages were on their way
    std::int64_t tasks = 0;       ///< of cells
    std::int64_t messages = 0;    ///< of values of particles, sent
    std::int64_t bytes = 0;       ///< in them
    std::int64_t moved = 0;       ///< particles that went to another rank
    std::int64_t moved_cells = 0; ///< cells that did, with all that was in them
    std::int64_t cuts = 0;        ///< times that shares were cut anew
    double imbalance = 1;         ///< largest cost of a rank over the mean, when last looked at [-]
};

/// \tparam T  of columns    \tparam S  of records    \tparam R  the ranks    \tparam Species  at most two
template <int Dim, class T, class S, int Species, class R>
class Decomposition {
public:
    using Flying = std::remove_cvref_t<decltype(std::declval<R const&>().exchange({}, {}, 0))>;
    static constexpr auto species = std::size_t(Species);

    /// \param by_cpu  whether tasks cost the time of their processor, not that of the clock
    explicit Decomposition(R ranks, bool by_cpu = false) : ranks_(std::move(ranks)), by_cpu_(by_cpu) {}

    [[nodiscard]] R const& ranks() const { return ranks_; }
    [[nodiscard]] Shares<Dim> const& shares() const { return shares_; }
    void use(Shares<Dim> shares) { shares_ = std::move(shares); }
    [[nodiscard]] Halo<Dim, T>& halo(int s) { return halo_[std::size_t(s)]; }
    /// Particles of a species that others own, as a source of lists: their records follow `records` of our own.
    void place(int s, std::size_t records) { first_[std::size_t(s)] = std::int32_t(records); }
    [[nodiscard]] Foreign<Dim, T> foreign(int s) const
    {
        auto const& h = halo_[std::size_t(s)];
        return {h.places(), h.bins(), first_[std::size_t(s)], h.ids()};
    }
    [[nodiscard]] Halo<Dim, T> const& halo(int s) const { return halo_[std::size_t(s)]; }
    [[nodiscard]] RankReport const& report() const { return report_; }
    [[nodiscard]] RankReport& report() { return report_; }

    // ---- whose particles are whose
    /// Of the first so many particles of a species each rank has its own; what comes after them has been given to all ranks
    /// alike, and each still has to keep what is its own.
    [[nodiscard]] std::size_t owned(int s) const { return owned_[std::size_t(s)]; }
    void own(int s, std::size_t n) { owned_[std::size_t(s)] = n; }
    /// The particles that this rank counts when all are counted.
    [[nodiscard]] std::size_t counted(int s, std::size_t size) const { return ranks_.rank() == 0 ? size : owned(s); }
    [[nodiscard]] int owner(Index<Dim> const& cell) const { return shares_.owner(cell); }

    /// Sends particles home. \param home  of particle i, a rank    \param extra  of each, goes along
    template <class P>
    void leave(int s, P& particles, std::vector<int> const& home, std::vector<double>& extra,
               std::map<int, Message>& to)
    {
        std::map<int, std::vector<std::int32_t>> away;
        std::vector<std::int32_t> stay;
        for (std::size_t i = 0; i < home.size(); ++i) {
            if (home[i] == ranks_.rank()) stay.push_back(std::int32_t(i));
            else if (i < owned(s)) away[home[i]].push_back(std::int32_t(i));
        }
        for (auto const& leaving : away) {
            auto const& which = leaving.second; // clang 14 hands no binding to a lambda
            report_.moved += std::int64_t(which.size());
            Message& m = to[leaving.first];
            m.put(s);
            m.put(picked(particles.id(), which));
            for_each(P::fields, [&](auto f) {
                for (auto const& a : particles.column(f)) put_column(m, a, which);
            });
            m.put(extra.empty() ? extra : picked(extra, which));
        }
        if (stay.size() < home.size()) {
            particles.keep(stay);
            if (!extra.empty()) extra = picked(extra, stay);
        }
        own(s, stay.size());
    }
    template <class P>
    void arrive(int s, P& particles, std::vector<double>& extra, Message& m)
    {
        const auto ids = m.take_all<std::uint32_t>();
        particles.append(ids);
        for_each(P::fields, [&](auto f) {
            for (auto& a : particles.column(f)) take_column(m, a, particles.size() - ids.size(), ids.size());
        });
        const auto more = m.take_all<double>();
        extra.insert(extra.end(), more.begin(), more.end());
        own(s, particles.size());
    }

    // ---- which cell waits for whom
    /// For the cells of target s: what arrives with link l of source q is read by cells waiting(s, q)[l].
    void look_around(int s, int q, Binning<Dim> const& at, Grid<Dim> const& grid)
    {
        auto& links = waiting_[std::size_t(s * Species + q)];
        auto const& halo = halo_[std::size_t(q)];
        links.assign(halo.in().size(), {});
        std::map<int, std::size_t> link;
        for (std::size_t l = 0; l < links.size(); ++l) link[halo.in()[l].rank] = l;
        std::vector<std::size_t> link_of(halo.bins().cells());
        for (std::size_t c = 0; c < link_of.size(); ++c) link_of[c] = link.at(owner(halo.bins().cell(c)));
        for (std::size_t k = 0; k < at.cells(); ++k)
            each_cell_around(at.cell(k), grid, [&](Index<Dim> const& cell) {
                const auto foreign = halo.bins().find(cell);
                if (foreign < 0) return;
                auto& cells = links[link_of[std::size_t(foreign)]];
                if (cells.empty() || cells.back() != std::int32_t(k)) cells.push_back(std::int32_t(k));
            });
        cost_[std::size_t(s)].assign(at.cells(), 0);
    }
    /// What the tasks of the cells of one target make is read by which cells of another; after look_around.
    void look_inside(Binning<Dim> const& made, Binning<Dim> const& at, Grid<Dim> const& grid)
    {
        reads_.assign(made.cells(), {});
        makers_.assign(at.cells(), 0);
        for (std::size_t k = 0; k < at.cells(); ++k) {
            auto one = [&](Index<Dim> const& cell) {
                const auto there = made.find(cell);
                if (there >= 0) reads_[std::size_t(there)].push_back(std::int32_t(k)), ++makers_[k];
            };
            one(at.cell(k));
            each_cell_around(at.cell(k), grid, one);
        }
        for (auto const& cells : waiting_[1])
            for (auto const k : cells) makers_[std::size_t(k)] = never;
    }

    // ---- values on their way
    /// Sends values of those particles of a species that others have asked for; `put(i, to)` writes those of particle i,
    /// `land(i, from)` will take those of foreign particle i. \param count  values a particle
    void send(int s, std::size_t count, auto const& put, auto land)
    {
        finish(s);
        auto& air = air_[std::size_t(s)];
        auto const& halo = halo_[std::size_t(s)];
        const auto out = packets(air.out, halo.out(), count), in = packets(air.in, halo.in(), count);
        S* to = air.out.data();
        for (auto const& l : halo.out())
            for (auto const i : l.particle) put(i, to), to += count;
        report_.messages += std::int64_t(out.size()), report_.bytes += std::int64_t(air.out.size() * sizeof(S));
        air.count = count;
        air.land = [count, land = std::move(land)](std::vector<std::int32_t> const& particles, S const* from) {
            for (auto const i : particles) land(i, from), from += count;
        };
        air.flying.emplace(ranks_.exchange(out, in, s));
        air.missing.assign(in.size(), 1);
    }
    /// Waits for all that is on its way of a species.
    void finish(int s)
    {
        while (air_[std::size_t(s)].flying) landed(s, true);
    }
    void finish()
    {
        for (int s = 0; s < Species; ++s) finish(s);
    }
    /// Tasks of a later sweep that may run in an earlier one: cells of a target that read what is in the air for that one
    /// too, and of what its tasks make no more than what they make here.
    template <class Free, class Task>
    struct Ahead {
        int target;
        std::size_t cells;
        unsigned sources;
        Free const& free; ///< of a cell: whether it reads nothing of what they make
        Task const& task;
    };
    struct Nobody {};
    /// Runs task(cell) for each cell of target s, each as soon as the last of what it reads has arrived, those that others
    /// have waited for first. Where nothing is left but to wait, tasks of a later sweep run: `then`.
    /// \param sources  bit q: reads source q    \param rest  without those that have run ahead of their sweep
    template <class Then = Nobody>
    void run(int s, std::size_t cells, unsigned sources, auto const& task, auto const& backend, bool rest = false,
             [[maybe_unused]] Then const& then = {})
    {
        constexpr bool any_ahead = !std::same_as<Then, Nobody>;
        Due mine = due(s, cells, sources, [&](std::size_t k) { return !rest || ran_[k] == 0; }), later;
        unsigned all = sources;
        if constexpr (any_ahead) {
            ran_.assign(then.cells, 0);
            auto made = [&](std::size_t k) { return then.free(k) ? 0 : makers_[k]; };
            later = due(
                then.target, then.cells, then.sources, [&](std::size_t k) { return made(k) != never; }, made);
            all |= then.sources;
        }
        auto is_missing = [&] {
            for (int q = 0; q < Species; ++q) {
                auto const& air = air_[std::size_t(q)];
                if ((all >> q & 1) != 0 && air.flying &&
                    std::find(air.missing.begin(), air.missing.end(), 1) != air.missing.end())
                    return true;
            }
            return false;
        };
        auto look = [&](bool patient) { // at what has come
            bool any = true;
            while (any) {
                any = false;
                for (int q = 0; q < Species; ++q) {
                    if ((all >> q & 1) == 0 || !air_[std::size_t(q)].flying) continue;
                    const int l = landed(q, patient);
                    if (l < 0) continue;
                    any = true, patient = false;
                    if ((sources >> q & 1) != 0) mine.arrived(waiting_[std::size_t(s * Species + q)][std::size_t(l)]);
                    if constexpr (any_ahead)
                        if ((then.sources >> q & 1) != 0)
                            later.arrived(waiting_[std::size_t(then.target * Species + q)][std::size_t(l)]);
                }
            }
        };
        // Between two looks; threads that meet after every few tasks would do little else.
        const auto threads = std::size_t(backend.threads());
        const std::size_t some = threads == 1 ? 4 : std::max(4 * threads, cells / 16);
        while (mine.left > 0) { // what no task here waits for may fly on
            const bool waiting = is_missing();
            if (waiting) look(mine.idle() && later.idle());
            if (!mine.idle()) {
                const auto some_cells = mine.next(waiting ? some : cells);
                compute(s, some_cells, task, backend, is_missing());
                if constexpr (any_ahead)
                    for (auto const k : some_cells)
                        for (auto const reader : reads_[std::size_t(k)])
                            if (!then.free(std::size_t(reader))) later.one_less(reader);
            }
            else if constexpr (any_ahead) {
                const auto some_cells = later.next(some);
                for (auto const k : some_cells) ran_[std::size_t(k)] = 1;
                compute(then.target, some_cells, then.task, backend, is_missing());
            }
        }
    }
    /// Boxes of patches of those who share a border: of ours to them, of theirs to us, after `own` of ours.
    template <class Box>
    void exchange_patches(int s, std::vector<Box>& of_patch, std::size_t own)
    {
        std::vector<Box> out, in;
        auto const& halo = halo_[std::size_t(s)];
        for (auto const& l : halo.out())
            for (auto const p : l.patch) out.push_back(of_patch[std::size_t(p)]);
        for (auto const& l : halo.in()) in.resize(in.size() + l.patch.size());
        auto cut = [](std::vector<Box>& all, std::vector<Link> const& links) {
            std::vector<Packet> packets;
            std::size_t at = 0;
            for (auto const& l : links) {
                packets.push_back({l.rank, std::as_writable_bytes(std::span(all).subspan(at, l.patch.size()))});
                at += l.patch.size();
            }
            return packets;
        };
        const auto to = cut(out, halo.out()), from = cut(in, halo.in());
        auto flying = ranks_.exchange(to, from, Species);
        wait([&] {
            while (flying.next() >= 0) {}
        });
        std::size_t k = 0;
        for (auto const& l : halo.in())
            for (auto const p : l.patch) of_patch[own + std::size_t(p)] = in[k++];
    }

    // ---- balance
    /// Cuts shares of like cost if the dearest rank costs more than `tolerated` times the mean, and what that saves is
    /// more than the last move has cost.
    void cut_by_cost(std::vector<CellCost> cost, double tolerated)
    {
        std::int64_t mine = 0;
        for (auto const& c : cost) mine += c.cost;
        const auto most = ranks_.all(mine, agree::Most{}), sum = ranks_.all(mine, agree::Sum{});
        report_.imbalance = sum > 0 ? double(most) * ranks_.count() / double(sum) : 1;
        if (report_.imbalance <= tolerated) return;
        auto [shares, dearest] = shares_.cut_anew(std::move(cost), ranks_);
        if (dearest >= most) return;
        ++report_.cuts;
        shares_ = std::move(shares);
    }
    /// What the cells of a target have cost since lists were built [ns].
    [[nodiscard]] std::vector<std::int64_t> const& cost(int s) const { return cost_[std::size_t(s)]; }

private:
    struct Air {
        std::vector<S> out, in; // persistent
        std::size_t count = 0;
        std::optional<Flying> flying;
        std::vector<char> missing;                                            // by link
        std::function<void(std::vector<std::int32_t> const&, S const*)> land; // all particles of a link
    };
    /// The tasks of a target: how many messages each cell waits for, and which cells can run.
    struct Due {
        std::vector<std::int32_t> missing, ready, inner; // missing: -1 is none of these tasks
        std::size_t done = 0, left = 0;                  // done: of inner

        [[nodiscard]] bool idle() const { return ready.empty() && done == inner.size(); }
        void arrived(std::vector<std::int32_t> const& cells)
        {
            for (auto const k : cells) one_less(k);
        }
        void one_less(std::int32_t k)
        {
            if (missing[std::size_t(k)] > 0 && --missing[std::size_t(k)] == 0) ready.push_back(k);
        }
        /// The next cells to run: those that others have waited for, else at most so many more.
        [[nodiscard]] std::vector<std::int32_t> next(std::size_t some)
        {
            std::vector<std::int32_t> cells;
            if (!ready.empty()) std::swap(cells, ready);
            else {
                const std::size_t end = std::min(inner.size(), done + some);
                cells.assign(inner.begin() + std::ptrdiff_t(done), inner.begin() + std::ptrdiff_t(end));
                done = end;
            }
            left -= cells.size();
            return cells;
        }
    };
    struct Nothing {
        std::int32_t operator()(std::size_t) const { return 0; }
    };
    /// \param is_one  of a cell: whether it is one of the tasks    \param more  of a cell: what else it waits for
    template <class More = Nothing>
    Due due(int s, std::size_t cells, unsigned sources, auto const& is_one, More const& more = {}) const
    {
        Due d;
        d.missing.assign(cells, 0);
        for (int q = 0; q < Species; ++q) {
            auto const& air = air_[std::size_t(q)];
            if ((sources >> q & 1) == 0 || !air.flying) continue;
            for (std::size_t l = 0; l < air.missing.size(); ++l)
                if (air.missing[l])
                    for (auto const k : waiting_[std::size_t(s * Species + q)][l]) ++d.missing[std::size_t(k)];
        }
        for (std::size_t k = 0; k < cells; ++k) {
            if (!is_one(k)) {
                d.missing[k] = -1;
                continue;
            }
            ++d.left;
            d.missing[k] += more(k);
            if (d.missing[k] == 0) d.inner.push_back(std::int32_t(k));
        }
        return d;
    }

    template <class X>
    static std::vector<X> picked(std::vector<X> const& all, std::vector<std::int32_t> const& which)
    {
        std::vector<X> some(which.size());
        for (std::size_t k = 0; k < which.size(); ++k) some[k] = all[std::size_t(which[k])];
        return some;
    }
    [[gnu::noinline]] static void put_column(Message& m, Array<T> const& a, std::vector<std::int32_t> const& which)
    {
        std::vector<T> some(which.size());
        for (std::size_t k = 0; k < which.size(); ++k) some[k] = a[std::size_t(which[k])];
        m.put(std::span<T const>(some));
    }
    [[gnu::noinline]] static void take_column(Message& m, Array<T>& a, std::size_t first, std::size_t n)
    {
        m.take(std::span<T>(a.data() + first, n));
    }
    static std::vector<Packet> packets(std::vector<S>& buffer, std::vector<Link> const& links, std::size_t count)
    {
        std::size_t n = 0;
        for (auto const& l : links) n += l.particle.size() * count;
        buffer.resize(n);
        std::vector<Packet> all;
        S* at = buffer.data();
        for (auto const& l : links) {
            all.push_back({l.rank, std::as_writable_bytes(std::span<S>(at, l.particle.size() * count))});
            at += l.particle.size() * count;
        }
        return all;
    }
    void wait(auto const& f)
    {
        const auto start = std::chrono::steady_clock::now();
        f();
        report_.idle += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    /// Takes one message of a species that has come, -1: none has.
    int landed(int s, bool patient)
    {
        auto& air = air_[std::size_t(s)];
        int l = -1;
        if (patient) wait([&] { l = air.flying->next(); });
        else l = air.flying->poll();
        if (l < 0) {
            if (patient) air.flying.reset();
            return -1;
        }
        auto const& in = halo_[std::size_t(s)].in();
        S const* from = air.in.data();
        for (int b = 0; b < l; ++b) from += in[std::size_t(b)].particle.size() * air.count;
        air.land(in[std::size_t(l)].particle, from);
        air.missing[std::size_t(l)] = 0;
        return l;
    }
    [[nodiscard]] std::int64_t now() const // [ns]
    {
        if (!by_cpu_) return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
        timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return 1'000'000'000 * std::int64_t(t.tv_sec) + std::int64_t(t.tv_nsec);
    }
    void compute(int s, std::span<std::int32_t const> cells, auto const& task, auto const& backend, bool early)
    {
        using Clock = std::chrono::steady_clock;
        const auto start = Clock::now();
        auto& cost = cost_[std::size_t(s)];
        backend.for_each(cells.size(), [&](std::size_t k) {
            const auto cell = std::size_t(cells[k]);
            const auto begin = now();
            task(cell);
            cost[cell] += now() - begin;
        });
        report_.busy += std::chrono::duration<double>(Clock::now() - start).count();
        report_.tasks += std::int64_t(cells.size());
        if (early) report_.early += std::int64_t(cells.size());
    }

    R ranks_;
    bool by_cpu_;
    Shares<Dim> shares_;
    std::array<Halo<Dim, T>, species> halo_;
    std::array<std::int32_t, species> first_{}; ///< record of the first of others
    std::array<std::size_t, species> owned_{};
    std::array<std::vector<std::vector<std::int32_t>>, species * species> waiting_;
    std::array<Air, species> air_;
    static constexpr std::int32_t never = std::numeric_limits<std::int32_t>::max();
    std::vector<std::vector<std::int32_t>>
        reads_;                        ///< by cell of the markers: cells of the mobile particles that see them
    std::vector<std::int32_t> makers_; ///< of those cells: how many of these; never: markers of others too
    std::vector<char> ran_; ///< cells of the target whose sweep comes next: whether they have run in the last one
    std::array<std::vector<std::int64_t>, species> cost_;
    RankReport report_;
};

} // namespace spate
