// SPDX-License-Identifier: BSD-3-Clause
// The decomposition, the halo and the balance of the library, run for the load of the developed dam break on as many
// virtual ranks as memory allows: deal, cut by number, go home, meet, count pairs, cut by cost, go home, meet, and look
// again when particles have moved on. There is no physics; a row of the table is what one rank has.
#include "counting.hpp"
#include "load.hpp"

#include <spate/backend/virtual_ranks.hpp>
#include <spate/kernel/cubic_spline.hpp>
#include <spate/physics/smoothing.hpp>

#include <cstdio>
#include <ctime>
#include <iostream>
#include <set>

#include <malloc.h>

using namespace bench;

namespace {

double cpu() // of the thread, and each virtual rank is one [s]
{
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

constexpr int a_node[] = {12, 36};       // ranks
constexpr std::int64_t a_record = 2;     // of a particle in reach, in pairs: page.py, constants measured here
constexpr std::size_t values[] = {8, 5}; // of a particle in a message, by species

auto timed(double& seconds, auto const& f)
{
    const double begin = cpu();
    auto result = f();
    seconds += cpu() - begin;
    return result;
}
/// Virtual ranks that tell their own time apart: they copy each message twice, and hand the processor on.
class Timed : public VirtualRanks::Rank {
public:
    using R = VirtualRanks::Rank;
    explicit Timed(R on) : R(on) {}
    [[nodiscard]] double inside() const { return *inside_; }

    using Inner = std::remove_cvref_t<decltype(std::declval<R const&>().exchange({}, {}, 0))>;
    struct Flown {
        Inner inner;
        double* inside;
        int poll()
        {
            return timed(*inside, [&] { return inner.poll(); });
        }
        int next()
        {
            return timed(*inside, [&] { return inner.next(); });
        }
    };
    [[nodiscard]] Flown exchange(std::span<Packet const> out, std::span<Packet const> in, int tag) const
    {
        return {timed(*inside_, [&] { return R::exchange(out, in, tag); }), inside_.get()};
    }
    [[nodiscard]] std::vector<Parcel> scatter(std::vector<Parcel> parcels) const
    {
        return timed(*inside_, [&] { return R::scatter(std::move(parcels)); });
    }

private:
    std::shared_ptr<double> inside_ = std::make_shared<double>(0); // [s]
};

struct Options {
    int ranks = 8, finer = 1, cell = 2;
    double look = 2e-3; ///< time between two looks of the balance, at finer 1 [s]
    std::string state, table, shares;
};

struct Row {
    std::int64_t particles = 0, cells = 0, pairs = 0, inner = 0; ///< inner: pairs of cells that wait for nobody
    std::int64_t by_number = 0, later = 0; ///< pairs with the first cuts; with these cuts when the next look is due
    std::array<std::int64_t, 2> out{}, in{}, out_particles{}, in_particles{};
    std::int64_t wall_cells = 0;
    std::int64_t reach = 0,
                 patches =
                     0; ///< particles that the tasks of an evaluation read; patches of water in messages that go out
    /// For nodes of 12, of 36: pairs of cells of water that see no marker of others and wait, they or the walls that they see,
    /// for the water of so many ranks of other nodes, the last: or more; of those that see no marker of other nodes.
    std::array<std::array<std::int64_t, 6>, 2> free{};
    std::array<std::int64_t, 2> late{};
    std::array<std::int64_t, 2> walls{}; ///< pairs of wall cells that see no water of other nodes
    std::array<std::int64_t, 2> first{}; ///< particles sent with the first cuts
    std::array<std::int64_t, 2> far{}; ///< values sent to other nodes in an evaluation, of nodes of 12 and of 36 ranks
    std::array<std::int64_t, 2> links{}; ///< messages that go there
    std::int64_t moved = 0, bytes = 0;   ///< particles that have left until the next look; memory of the halo
    double meet = 0, cut = 0,
           copy = 0; ///< CPU: a meeting; a search for cuts; packing and landing a round of values [s]
    Asked start, meeting, cutting;
};

template <class T>
class OneRank {
public:
    using R = Counting<Timed>;
    using P = Particles<3, T, Fields<Position>, Fields<>>;

    OneRank(VirtualRanks::Rank rank, Load const& load, Options const& o)
        : time_(rank), ranks_(R(time_)), load_(load), o_(o), parts_(ranks_),
          grid_(Box<3>{{0, 0, 0}, {1, 0.4, 0.5}}, Edges<3>(Edge::open), load.reach() * (1 + skin), 4, o.cell)
    {}
    Row run()
    {
        Row row;
        deal();
        parts_.use(Shares<3>::of_like_cost(by_number(), ranks_));
        go_home();
        meet();
        for (int q = 0; q < 2; ++q)
            for (auto const& l : parts_.halo(q).out()) row.first[std::size_t(q)] += std::int64_t(l.particle.size());
        row.by_number = count_pairs();
        row.start = ranks_.asked();
        double begin = cpu();
        parts_.cut_by_cost(cost_, 1);
        row.cut = cpu() - begin;
        row.cutting = ranks_.asked() - row.start;
        go_home();
        const auto before = ranks_.asked();
        begin = own();
        meet();
        row.meet = own() - begin;
        row.meeting = ranks_.asked() - before;
        row.pairs = count_pairs();
        row.inner = inner_, row.reach = reach_, row.free = free_, row.late = late_, row.walls = walls_;
        describe(row);
        exchange(row);
        const auto left = parts_.report().moved;
        move_on();
        go_home();
        row.moved = parts_.report().moved - left;
        meet();
        row.later = count_pairs();
        return row;
    }
    [[nodiscard]] Shares<3> const& shares() const { return parts_.shares(); }

private:
    static constexpr double skin = Smoothing<CubicSpline<3>>::neighbours.skin;

    /// As the engine begins: every so-many-th block of 256.
    void deal()
    {
        for (int s = 0; s < 2; ++s) {
            std::vector<std::uint32_t> ids;
            const auto n = load_.places(s), step = 256 * std::size_t(ranks_.count());
            for (std::size_t b = 256 * std::size_t(ranks_.rank()); b < n; b += step)
                for (std::size_t id = b; id < std::min(n, b + 256); ++id)
                    if (load_.occupied(s, id)) ids.push_back(std::uint32_t(id));
            auto& p = particles(s);
            p.append(ids);
            place(s, 0);
            parts_.own(s, p.size());
        }
    }
    void place(int s, double t)
    {
        auto& p = particles(s);
        for (std::size_t i = 0; i < p.size(); ++i) p.put(position, i, load_.at(s, p.id()[i], t));
    }
    void move_on() { place(0, o_.look / load_.finer()); }
    Index<3> cell_at(P const& p, std::size_t i) const
    {
        Index<3> cell;
        for (int c = 0; c < 3; ++c)
            cell[std::size_t(c)] = grid_.cell_of(c, grid_.bin(c, double(p.column(position)[std::size_t(c)][i])));
        return cell;
    }
    std::vector<CellCost> by_number()
    {
        std::map<std::uint64_t, std::int64_t> in_cell;
        for (int s = 0; s < 2; ++s) {
            Index<3> last{};
            std::int64_t* count = nullptr;
            for (std::size_t i = 0; i < particles(s).size(); ++i) {
                const auto cell = cell_at(particles(s), i);
                if (!count || cell != last) count = &in_cell[along_curve<3>(cell)], last = cell;
                ++*count;
            }
        }
        std::vector<CellCost> cost;
        for (auto const& [key, n] : in_cell) cost.push_back({key, n});
        return cost;
    }
    void go_home()
    {
        std::map<int, Message> to;
        std::vector<double> nothing;
        for (int s = 0; s < 2; ++s) {
            auto& p = particles(s);
            std::vector<int> home(p.size());
            Index<3> last{};
            for (std::size_t i = 0; i < home.size(); ++i) {
                const auto cell = cell_at(p, i);
                home[i] = i > 0 && cell == last ? home[i - 1] : parts_.owner(cell);
                last = cell;
            }
            parts_.leave(s, p, home, nothing, to);
        }
        std::vector<Parcel> parcels;
        for (auto& [rank, message] : to) parcels.push_back({rank, std::move(message)});
        to.clear();
        for (auto& parcel : ranks_.scatter(std::move(parcels)))
            while (!parcel.message.empty()) {
                const int s = parcel.message.template take<int>();
                parts_.arrive(s, particles(s), nothing, parcel.message);
            }
        for (int s = 0; s < 2; ++s) {
            bins_[std::size_t(s)].sort(particles(s), grid_);
            particles(s).fit();
        }
    }
    /// Water meets all, the tank meets the water.
    void meet()
    {
        for (int q = 0; q < 2; ++q) {
            auto const& p = particles(q);
            const auto places = Places<3, T>::of(p);
            auto const& source = bins_[std::size_t(q)];
            if (q == 0)
                parts_.halo(q).meet({&bins_[0], &bins_[1]}, source, places, p.id(), grid_, parts_.shares(), ranks_);
            else parts_.halo(q).meet({&bins_[0]}, source, places, p.id(), grid_, parts_.shares(), ranks_);
            parts_.place(q, p.size() + 1);
        }
        for (int s = 0; s < 2; ++s)
            for (int q = 0; q < 2; ++q) parts_.look_around(s, q, bins_[std::size_t(s)], grid_);
    }
    /// Directed pairs within the range with a target here; what each cell costs; the pairs of cells that wait for nobody.
    std::int64_t count_pairs()
    {
        std::int64_t all = 0;
        inner_ = 0, reach_ = 0, free_ = {}, late_ = walls_ = {};
        cost_.clear();
        for (int s = 0; s < 2; ++s)
            for (std::size_t k = 0; k < bins_[std::size_t(s)].cells(); ++k) {
                const auto cell = bins_[std::size_t(s)].cell(k);
                bool sees_marker = false, sees_water = false;
                const auto n = pairs_of(s, 0, k, sees_water) + (s == 0 ? pairs_of(0, 1, k, sees_marker) : 0);
                std::int64_t reach = 0;
                for (int q = 0; q < 2 - s && n > 0; ++q)
                    reach += in_reach(cell, bins_[std::size_t(q)], parts_.halo(q).bins(), grid_);
                reach_ += reach;
                bool waits = false;
                Far far,
                    of_walls; // ranks of other nodes that are waited for: by this task, by those of walls that it sees
                each_cell_around(cell, grid_, [&](Index<3> const& c) {
                    for (std::size_t q = 0; q < 2 - std::size_t(s); ++q) {
                        if (parts_.halo(int(q)).bins().find(c) < 0) continue;
                        waits = true;
                        wait_for(c, far[q]);
                    }
                    if (s == 1 || bins_[1].find(c) < 0) return;
                    each_cell_around(c, grid_, [&](Index<3> const& water) {
                        if (parts_.halo(0).bins().find(water) >= 0) wait_for(water, of_walls[0]);
                    });
                });
                const bool sees_foreign = sees_foreign_marker(cell);
                for (std::size_t node = 0; node < 2; ++node) {
                    if (s == 1 && far[0][node].empty()) walls_[node] += n;
                    if (s == 0 && far[1][node].empty()) late_[node] += n;
                    if (s == 1 || sees_foreign) continue;
                    if (sees_marker) far[0][node].merge(of_walls[0][node]);
                    free_[node][std::min(far[0][node].size(), free_[node].size() - 1)] += n;
                }
                const std::int64_t here = bins_[std::size_t(s)].end(k) - bins_[std::size_t(s)].begin(k);
                // The time of its task, and what is added to it, in pairs: as System::cut_by_cost does.
                const std::int64_t cost = n + a_record * reach + std::int64_t(Balance{}.a_particle) * here;
                cost_.push_back({along_curve<3>(cell), cost});
                all += n;
                if (!waits) inner_ += n;
            }
        return all;
    }
    using Far = std::array<std::array<std::set<int>, 2>, 2>; // by source, by node
    void wait_for(Index<3> const& cell, std::array<std::set<int>, 2>& far) const
    {
        const int owner = parts_.owner(cell);
        for (std::size_t node = 0; node < 2; ++node)
            if (owner / a_node[node] != ranks_.rank() / a_node[node]) far[node].insert(owner);
    }
    bool sees_foreign_marker(Index<3> const& cell) const
    {
        bool any = false;
        each_cell_around(cell, grid_, [&](Index<3> const& c) { any = any || parts_.halo(1).bins().find(c) >= 0; });
        return any;
    }
    /// \param sees  set if lists of targets in the cell may hold any of the source
    std::int64_t pairs_of(int s, int q, std::size_t k, bool& sees)
    {
        auto const& at = bins_[std::size_t(s)];
        auto const& halo = parts_.halo(q);
        const auto per_cell = Skins<3>::patches_of_cell(grid_);
        const auto own = Places<3, T>::of(particles(q)), foreign = halo.places();
        const auto targets = Places<3, T>::of(particles(s));
        const auto reach2 = T(load_.reach() * load_.reach());
        std::int64_t n = 0;
        for (std::size_t p = 0; p < per_cell; ++p) {
            const auto here = Skins<3>::particles_of(at, k * per_cell + p, grid_);
            if (here.empty()) continue;
            each_around<3>(patch_at(at.cell(k), p, grid_), grid_, [&](Index<3> const& cell, std::size_t local) {
                auto const* bins = &bins_[std::size_t(q)];
                auto const* places = &own;
                auto found = bins->find(cell);
                if (found < 0) bins = &halo.bins(), places = &foreign, found = bins->find(cell);
                if (found < 0) return;
                const auto there = Skins<3>::particles_of(*bins, std::size_t(found) * per_cell + local, grid_);
                sees = sees || !there.empty();
                T const *x = places->x[0], *y = places->x[1], *z = places->x[2];
                for (auto i = here.first; i < here.last; ++i) {
                    const T xi = targets.x[0][i], yi = targets.x[1][i], zi = targets.x[2][i];
                    std::int32_t near = 0;
                    for (auto j = there.first; j < there.last; ++j) {
                        const T a = x[j] - xi, b = y[j] - yi, c = z[j] - zi;
                        near += a * a + b * b + c * c < reach2 ? 1 : 0;
                    }
                    n += near;
                }
            });
            if (s == q) n -= here.last - here.first; // itself
        }
        return n;
    }
    void describe(Row& row) const
    {
        std::set<Index<3>> cells;
        for (int s = 0; s < 2; ++s) {
            const auto k = std::size_t(s);
            row.particles += std::int64_t(particles(s).size());
            for (std::size_t c = 0; c < bins_[k].cells(); ++c) cells.insert(bins_[k].cell(c));
            auto const& h = parts_.halo(s);
            row.out[k] = std::int64_t(h.out().size()), row.in[k] = std::int64_t(h.in().size());
            for (auto const& l : h.out()) row.out_particles[k] += std::int64_t(l.particle.size());
            for (auto const& l : h.in()) row.in_particles[k] += std::int64_t(l.particle.size());
            for (auto const& l : h.out())
                for (std::size_t n = 0; n < 2; ++n)
                    if (l.rank / a_node[n] != ranks_.rank() / a_node[n]) {
                        row.far[n] += std::int64_t(l.particle.size() * values[k]);
                        ++row.links[n];
                    }
            row.bytes += std::int64_t(h.bytes());
            if (s == 0)
                for (auto const& l : h.out()) row.patches += std::int64_t(l.patch.size());
        }
        row.cells = std::int64_t(cells.size());
        row.wall_cells = std::int64_t(bins_[1].cells());
    }
    /// Values of an evaluation, sent and landed for nothing: what the copying costs. As in the engine the compiler knows how
    /// many values a particle has.
    void exchange(Row& row) { exchange<0>(row), exchange<1>(row); }
    template <int s>
    void exchange(Row& row)
    {
        constexpr std::size_t v = values[s], stride = 8;
        std::vector<double> records((particles(s).size() + parts_.halo(s).ids().size()) * stride, 1);
        double* const data = records.data();
        double* const beyond = data + particles(s).size() * stride;
        double least = 1;
        for (int round = 0; round < 3; ++round) { // buffers persist: the first round makes them
            const double begin = own();
            parts_.send(
                s, v,
                [&](std::int32_t i, double* to) {
                    for (std::size_t k = 0; k < v; ++k) to[k] = data[std::size_t(i) * stride + k];
                },
                [=](std::int32_t i, double const* from) {
                    for (std::size_t k = 0; k < v; ++k) beyond[std::size_t(i) * stride + k] = from[k];
                });
            parts_.finish(s);
            least = std::min(least, own() - begin);
        }
        row.copy += least;
    }
    P& particles(int s) { return particles_[std::size_t(s)]; }
    P const& particles(int s) const { return particles_[std::size_t(s)]; }

    [[nodiscard]] double own() const { return cpu() - time_.inside(); }

    Timed time_;
    R ranks_;
    Load const& load_;
    Options const& o_;
    Decomposition<3, T, double, 2, R> parts_;
    Grid<3> grid_;
    std::array<P, 2> particles_;
    std::array<Binning<3>, 2> bins_;
    std::vector<CellCost> cost_;
    std::int64_t inner_ = 0, reach_ = 0;
    std::array<std::array<std::int64_t, 6>, 2> free_{};
    std::array<std::int64_t, 2> late_{}, walls_{};
};

void write(std::vector<Row> const& rows, std::string const& file)
{
    std::ofstream to(file);
    to << "particles,cells,pairs,inner,by_number,later,out_0,out_1,in_0,in_1,out_particles_0,out_particles_1,in_particles_0,"
          "in_particles_1,first_0,first_1,far_12,far_36,links_12,links_36,reach,patches,late_12,late_36,walls_12,walls_36,"
          "free_12_0,free_12_1,free_12_2,free_12_3,free_12_4,free_12_5,free_36_0,free_36_1,free_36_2,free_36_3,free_36_4,free_36_5,wall_cells,moved,bytes,meet,cut,copy,start_reductions,start_wide,start_scatters,start_parcels,start_sent,"
          "meet_scatters,meet_parcels,meet_sent,cut_reductions,cut_wide,cut_bytes\n";
    for (auto const& r : rows) {
        to << r.particles << ',' << r.cells << ',' << r.pairs << ',' << r.inner << ',' << r.by_number << ',' << r.later;
        for (auto const* a : {&r.out, &r.in, &r.out_particles, &r.in_particles, &r.first, &r.far, &r.links})
            to << ',' << (*a)[0] << ',' << (*a)[1];
        to << ',' << r.reach << ',' << r.patches;
        for (auto const* a : {&r.late, &r.walls}) to << ',' << (*a)[0] << ',' << (*a)[1];
        for (auto const& of_node : r.free)
            for (auto const n : of_node) to << ',' << n;
        to << ',' << r.wall_cells;
        to << ',' << r.moved << ',' << r.bytes << ',' << r.meet << ',' << r.cut << ',' << r.copy;
        to << ',' << r.start.reductions << ',' << r.start.wide << ',' << r.start.scatters << ',' << r.start.parcels
           << ',' << r.start.sent;
        to << ',' << r.meeting.scatters << ',' << r.meeting.parcels << ',' << r.meeting.sent;
        to << ',' << r.cutting.reductions << ',' << r.cutting.wide << ',' << r.cutting.widely << '\n';
    }
}

template <class T>
void count(Options const& o)
{
    const Load load(o.state, o.finer);
    std::vector<Row> rows(std::size_t(o.ranks), Row{});
    VirtualRanks(o.ranks).run([&](auto rank) {
        OneRank<T> one(rank, load, o);
        rows[std::size_t(rank.rank())] = one.run();
        if (rank.rank() == 0 && !o.shares.empty()) {
            std::ofstream to(o.shares);
            for (auto const key : one.shares().first()) to << key << '\n';
        }
    });
    write(rows, o.table);
}

} // namespace

/// count RANKS FINER CELL LOOK STATE TABLE [SHARES]
int main(int argc, char** argv)
{
    if (argc < 7) {
        std::cerr << "usage: count RANKS FINER CELL LOOK STATE TABLE [SHARES]\n";
        return 2;
    }
    // A thread for each rank: one heap for all, or there are more mappings than a process may have.
    mallopt(M_ARENA_MAX, 1), mallopt(M_MMAP_THRESHOLD, 1 << 30);
    Options o;
    o.ranks = std::stoi(argv[1]), o.finer = std::stoi(argv[2]), o.cell = std::stoi(argv[3]),
    o.look = std::stod(argv[4]);
    o.state = argv[5], o.table = argv[6];
    if (argc > 7) o.shares = argv[7];
    try {
        if (o.finer > 4) count<float>(o); // memory
        else count<double>(o);
    }
    catch (std::exception const& e) {
        std::cerr << "count: " << e.what() << '\n';
        return 1;
    }
}
