// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Many ranks in one process: each is a thread with its own scene, one runs at a time, in an order that is always
/// the same. For tests, debuggers and sanitizers, and for ranks beyond the machine; not for speed.
#pragma once

#include "spate/backend/balance.hpp"
#include "spate/backend/serial.hpp"
#include "spate/core/errors.hpp"
#include "spate/core/ranks.hpp"
#include "spate/physics/migration.hpp"

#include <algorithm>
#include <cstring>
#include <deque>
#include <exception>
#include <memory>
#include <semaphore>
#include <thread>

namespace spate {

class VirtualRanks {
public:
    /// What a rank knows of the world: a model of Ranks.
    class Rank;

    explicit VirtualRanks(int count)
    {
        require(count >= 1 && count <= 65536, "VirtualRanks.count", count, "1 to 65536");
        for (int r = 0; r < count; ++r) rank_.push_back(std::make_unique<State>());
    }
    [[nodiscard]] int count() const { return int(rank_.size()); }

    /// Calls program(rank) on each rank and waits for all. Throws what the first of them has thrown; that ends the others
    /// where they wait for it. Ranks that all wait for each other end with an error.
    template <class Program>
    void run(Program const& program);

private:
    struct Abandoned {}; // unwinds a rank whose partner is gone
    struct State {
        std::binary_semaphore go{0};
        bool ready = true, finished = false;
        std::exception_ptr thrown;
        std::deque<Parcel> box[2];                              // scattered, by parity of the round
        std::vector<std::deque<std::vector<std::byte>>> letter; // by sender and tag, grown as they come
        std::vector<std::pair<int, int>> sender;
        void* mine = nullptr; // in a reduction
        std::uint64_t scattered = 0;
    };
    struct Flown {
        VirtualRanks* world;
        int me, tag;
        std::vector<Packet> left; // rank -1: has been named
        int poll()
        {
            auto& state = world->of(me);
            for (std::size_t k = 0; k < left.size(); ++k) {
                if (left[k].rank < 0) continue;
                auto& letters = state.letter[std::size_t(slot(state, left[k].rank, tag))];
                if (letters.empty()) continue;
                if (letters.front().size() != left[k].bytes.size())
                    throw std::logic_error("spate: a message of another length than agreed");
                if (!left[k].bytes.empty())
                    std::memcpy(left[k].bytes.data(), letters.front().data(), left[k].bytes.size());
                letters.pop_front();
                left[k].rank = -1;
                return int(k);
            }
            return -1;
        }
        int next()
        {
            if (std::all_of(left.begin(), left.end(), [](Packet const& p) { return p.rank < 0; })) return -1;
            int k = -1;
            world->wait(me, [&] { return (k = poll()) >= 0; });
            return k;
        }
    };

    State& of(int r) { return *rank_[std::size_t(r)]; }
    static int slot(State& state, int sender, int tag)
    {
        const std::pair from(sender, tag);
        const auto it = std::find(state.sender.begin(), state.sender.end(), from);
        if (it != state.sender.end()) return int(it - state.sender.begin());
        state.sender.push_back(from);
        state.letter.emplace_back();
        return int(state.sender.size()) - 1;
    }
    /// Gives the baton to the next rank that can run, and takes it back when it comes.
    void pass(int me)
    {
        const int n = count();
        int next = -1;
        for (int k = 1; k <= n && next < 0; ++k)
            if (of((me + k) % n).ready && !of((me + k) % n).finished) next = (me + k) % n;
        if (next < 0) { // nobody can: either all are done, or all wait
            const bool done = std::all_of(rank_.begin(), rank_.end(), [](auto const& r) { return r->finished; });
            if (done) {
                all_done_.release();
                return;
            }
            stuck_ = stuck_ || !failed_;
            failed_ = true;
            for (int r = 0; r < n; ++r) of(r).ready = true;
            return pass(me);
        }
        if (next == me) return;
        of(next).go.release();
        if (!of(me).finished) of(me).go.acquire();
    }
    template <class Condition>
    void wait(int me, Condition const& holds)
    {
        while (!holds()) {
            if (failed_) throw Abandoned{};
            of(me).ready = false;
            pass(me);
            of(me).ready = true;
        }
    }
    void wake_all()
    {
        for (auto& r : rank_) r->ready = true;
    }
    /// Merges what all have brought; the last to come does it, in the order of the ranks.
    template <class Merge>
    void meet(int me, void* mine, Merge const& merge)
    {
        of(me).mine = mine;
        const auto round = rounds_;
        if (++met_ == count()) {
            met_ = 0, ++rounds_;
            merge();
            wake_all();
        }
        wait(me, [&] { return rounds_ != round; });
    }

    std::vector<std::unique_ptr<State>> rank_;
    std::binary_semaphore all_done_{0};
    int met_ = 0;
    std::uint64_t rounds_ = 0;
    bool failed_ = false, stuck_ = false;
};

class VirtualRanks::Rank {
public:
    static constexpr bool alone = false;
    static constexpr const char* name = "virtual";

    [[nodiscard]] int rank() const { return me_; }
    [[nodiscard]] int count() const { return world_->count(); }
    template <class T, class Merge>
    [[nodiscard]] T all(T mine, Merge const& merge) const
    {
        std::span<T, 1> one(&mine, 1);
        each(one, merge);
        return mine;
    }
    template <class Merge>
    void each(auto& values, Merge const& merge) const
    {
        const std::span mine(values);
        using T = std::remove_reference_t<decltype(mine[0])>;
        world_->meet(me_, mine.data(), [&] {
            auto* const sum = mine.data(); // the caller is one of them, so all else are merged into it
            for (int r = 0; r < count(); ++r)
                for (std::size_t k = 0; k < mine.size() && r != me_; ++k)
                    merge(sum[k], static_cast<T const*>(world_->of(r).mine)[k]);
            for (int r = 0; r < count(); ++r)
                if (r != me_) std::copy_n(sum, mine.size(), static_cast<T*>(world_->of(r).mine));
        });
    }
    [[nodiscard]] std::vector<Parcel> scatter(std::vector<Parcel> parcels) const
    {
        const std::size_t parity = world_->of(me_).scattered++ % 2;
        for (auto& p : parcels) world_->of(p.rank).box[parity].push_back({me_, Message(p.message.bytes())});
        world_->meet(me_, nullptr, [] {});
        auto& box = world_->of(me_).box[parity];
        std::vector<Parcel> mine(std::make_move_iterator(box.begin()), std::make_move_iterator(box.end()));
        box.clear();
        std::sort(mine.begin(), mine.end(), [](Parcel const& a, Parcel const& b) { return a.rank < b.rank; });
        return mine;
    }
    [[nodiscard]] Flown exchange(std::span<Packet const> out, std::span<Packet const> in, int tag) const
    {
        for (auto const& p : out) {
            auto& to = world_->of(p.rank);
            to.letter[std::size_t(slot(to, me_, tag))].emplace_back(p.bytes.begin(), p.bytes.end());
            to.ready = true;
        }
        return {world_, me_, tag, {in.begin(), in.end()}};
    }

private:
    friend VirtualRanks;
    Rank(VirtualRanks* world, int me) : world_(world), me_(me) {}
    VirtualRanks* world_;
    int me_;
};

template <class Program>
void VirtualRanks::run(Program const& program)
{
    failed_ = stuck_ = false, met_ = 0;
    std::vector<std::thread> threads;
    for (int r = 0; r < count(); ++r) {
        rank_[std::size_t(r)] = std::make_unique<State>();
        threads.emplace_back([this, r, &program] {
            of(r).go.acquire();
            try {
                program(Rank(this, r));
            }
            catch (Abandoned const&) {
            }
            catch (...) {
                of(r).thrown = std::current_exception();
                failed_ = true;
                wake_all();
            }
            of(r).finished = true;
            pass(r);
        });
    }
    of(0).go.release();
    all_done_.acquire();
    for (auto& t : threads) t.join();
    for (auto const& r : rank_)
        if (r->thrown) std::rethrow_exception(r->thrown);
    if (stuck_) throw std::logic_error("spate: all ranks wait for each other");
}

/// The backend of one virtual rank: `VirtualRanks(5).run([](auto rank) { Simulation sim(..., OnRank{rank}); ... })`.
template <class R = VirtualRanks::Rank, class Local = Serial>
struct OnRank {
    R rank;
    Local local = {};
    int cell = 0; ///< ranges along a cell's edge; 0: by dimension
    Balance balance = {};

    static constexpr const char* name = R::name;
    [[nodiscard]] R const& ranks() const { return rank; }
    [[nodiscard]] int threads() const { return local.threads(); }
    void check() const { local.check(), balance.check(); }
    void for_each(std::size_t tasks, auto const& run) const { local.for_each(tasks, run); }
};
template <class R>
OnRank(R) -> OnRank<R>;
template <class R, class Local>
OnRank(R, Local) -> OnRank<R, Local>;
template <class R, class Local>
OnRank(R, Local, int) -> OnRank<R, Local>;
template <class R, class Local>
OnRank(R, Local, int, Balance) -> OnRank<R, Local>;

} // namespace spate
