// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Many processes by MPI, each with workers of its own. Not part of spate.hpp, since it needs MPI.
#pragma once

#include "spate/backend/balance.hpp"
#include "spate/backend/serial.hpp"
#include "spate/core/errors.hpp"
#include "spate/core/ranks.hpp"
#include "spate/physics/migration.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include <mpi.h>

namespace spate {

/// The processes that mpirun has started: a model of Ranks. The first one initialises MPI, unless the program has; then
/// the end of the program ends MPI. Calls are made by one thread of a process.
class MpiRanks {
public:
    static constexpr bool alone = false;
    static constexpr const char* name = "mpi";

    MpiRanks() : rank_(session().rank), count_(session().count) {}
    [[nodiscard]] int rank() const { return rank_; }
    [[nodiscard]] int count() const { return count_; }
    /// By its Fortran handle, for libraries that know MPI.
    [[nodiscard]] int communicator() const { return MPI_Comm_c2f(session().world); }

    template <class T, class Merge>
    [[nodiscard]] T all(T mine, Merge const& merge) const
    {
        std::span<T, 1> one(&mine, 1);
        each(one, merge);
        return mine;
    }
    template <class Merge>
    void each(auto& values, Merge const&) const
    {
        const std::span mine(values);
        using T = std::remove_reference_t<decltype(mine[0])>;
        static_assert(std::is_trivially_copyable_v<T> && std::is_empty_v<Merge>);
        static const Operation<T, Merge> operation;
        MPI_Allreduce(MPI_IN_PLACE, mine.data(), int(mine.size()), operation.type, operation.op, session().world);
    }
    /// Who sends to whom is known to senders alone: each waits until its messages are being received, then all agree that
    /// they have arrived (Hoefler, Siebert & Lumsdaine 2010, NBX). Rounds follow each other with another tag.
    [[nodiscard]] std::vector<Parcel> scatter(std::vector<Parcel> parcels) const
    {
        auto const world = session().world;
        const int tag = scattered_tag + int(session().rounds++ % 2);
        std::vector<MPI_Request> sent(parcels.size());
        for (std::size_t k = 0; k < parcels.size(); ++k) {
            auto const& bytes = parcels[k].message.bytes();
            MPI_Issend(bytes.data(), length(bytes.size()), MPI_BYTE, parcels[k].rank, tag, world, &sent[k]);
        }
        std::vector<Parcel> mine;
        MPI_Request barrier = MPI_REQUEST_NULL;
        for (bool all_sent = false, all_done = false; !all_done;) {
            int there = 0;
            MPI_Status status;
            MPI_Iprobe(MPI_ANY_SOURCE, tag, world, &there, &status);
            if (there != 0) {
                int n = 0;
                MPI_Get_count(&status, MPI_BYTE, &n);
                std::vector<std::byte> bytes(std::size_t(n), std::byte{});
                MPI_Recv(bytes.data(), n, MPI_BYTE, status.MPI_SOURCE, tag, world, MPI_STATUS_IGNORE);
                mine.push_back({status.MPI_SOURCE, Message(std::move(bytes))});
            }
            int flag = 0;
            if (all_sent) {
                MPI_Test(&barrier, &flag, MPI_STATUS_IGNORE);
                all_done = flag != 0;
            }
            else {
                MPI_Testall(int(sent.size()), sent.data(), &flag, MPI_STATUSES_IGNORE);
                if (flag != 0) all_sent = true, MPI_Ibarrier(world, &barrier);
            }
        }
        std::sort(mine.begin(), mine.end(), [](Parcel const& a, Parcel const& b) { return a.rank < b.rank; });
        return mine;
    }
    class Flown {
    public:
        Flown(std::span<Packet const> out, std::span<Packet const> in, int tag)
            : request_(in.size() + out.size()), arrived_(in.size()), received_(in.size()), left_(in.size())
        {
            auto const world = session().world;
            for (std::size_t k = 0; k < in.size(); ++k)
                MPI_Irecv(in[k].bytes.data(), length(in[k].bytes.size()), MPI_BYTE, in[k].rank, tag, world,
                          &request_[k]);
            for (std::size_t k = 0; k < out.size(); ++k)
                MPI_Isend(out[k].bytes.data(), length(out[k].bytes.size()), MPI_BYTE, out[k].rank, tag, world,
                          &request_[in.size() + k]);
        }
        int next() { return named(MPI_Waitsome); }
        int poll() { return named(MPI_Testsome); }

    private:
        int named(auto const& some)
        {
            if (known_ == 0 && left_ > 0) {
                some(int(received_), request_.data(), &known_, arrived_.data(), MPI_STATUSES_IGNORE);
                if (known_ == MPI_UNDEFINED) known_ = 0;
                left_ -= std::size_t(known_);
            }
            if (known_ > 0) return arrived_[std::size_t(--known_)];
            if (left_ == 0)
                MPI_Waitall(int(request_.size() - received_), request_.data() + received_, MPI_STATUSES_IGNORE);
            return -1;
        }
        std::vector<MPI_Request> request_; // received ones, then sent ones
        std::vector<int> arrived_;
        std::size_t received_, left_;
        int known_ = 0; // arrived, but not named yet
    };
    [[nodiscard]] Flown exchange(std::span<Packet const> out, std::span<Packet const> in, int tag) const
    {
        return {out, in, tag};
    }
    /// The end of a program, with its exit code. One that ends with an error while others go on would keep them waiting for
    /// ever: if they do not come here within so many seconds it ends them too, and says so.
    [[gnu::cold]] void leave(int code, double patience = 10) const
    {
        MPI_Request all = MPI_REQUEST_NULL;
        MPI_Ibarrier(session().leaving, &all);
        const auto start = std::chrono::steady_clock::now();
        for (int here = 0;; std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
            MPI_Test(&all, &here, MPI_STATUS_IGNORE);
            if (here != 0) return;
            const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
            if (code == 0 || waited.count() < patience) continue;
            std::fprintf(stderr, "spate: rank %d has ended alone, with exit code %d; the other ranks are ended\n",
                         rank_, code);
            MPI_Abort(session().world, code);
        }
    }

private:
    static constexpr int scattered_tag = 1000;

    /// MPI for the time of the program, on a communicator of our own.
    struct Session {
        MPI_Comm world = MPI_COMM_NULL, leaving = MPI_COMM_NULL;
        int rank = 0, count = 1;
        std::uint64_t rounds = 0;
        bool ours = false;

        Session()
        {
            int is_up = 0, level = MPI_THREAD_SINGLE;
            MPI_Initialized(&is_up);
            if (is_up == 0) {
                MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
                ours = true;
            }
            else MPI_Query_thread(&level);
            if (level < MPI_THREAD_FUNNELED)
                throw BadInput("the thread level of MPI", std::to_string(level),
                               "at least MPI_THREAD_FUNNELED, " + std::to_string(MPI_THREAD_FUNNELED) +
                                   ": ask for it in MPI_Init_thread");
            MPI_Comm_dup(MPI_COMM_WORLD, &world);
            MPI_Comm_dup(MPI_COMM_WORLD, &leaving);
            MPI_Comm_rank(world, &rank);
            MPI_Comm_size(world, &count);
        }
        ~Session()
        {
            int is_down = 0;
            MPI_Finalized(&is_down);
            if (ours && is_down == 0) MPI_Finalize();
        }
        Session(Session const&) = delete;
        Session& operator=(Session const&) = delete;
    };
    static Session& session()
    {
        static Session s;
        return s;
    }
    template <class T, class Merge>
    struct Operation {
        MPI_Datatype type = MPI_DATATYPE_NULL;
        MPI_Op op = MPI_OP_NULL;
        Operation()
        {
            MPI_Type_contiguous(int(sizeof(T)), MPI_BYTE, &type);
            MPI_Type_commit(&type);
            MPI_Op_create(
                [](void* in, void* inout, int* n, MPI_Datatype*) {
                    for (int k = 0; k < *n; ++k) Merge{}(static_cast<T*>(inout)[k], static_cast<T const*>(in)[k]);
                },
                1, &op);
        }
    };
    static int length(std::size_t bytes)
    {
        if (bytes > std::size_t(std::numeric_limits<int>::max()))
            throw BadInput("a message between ranks [bytes]", std::to_string(bytes),
                           "at most 2147483647: use more processes");
        return int(bytes);
    }

    int rank_, count_;
};

/// The backend: `Mpi{}` is one thread a process, `Mpi{.local = Threads{4}}` four.
template <class Local = Serial>
struct Mpi {
    Local local = {};
    int cell = 0; ///< ranges along a cell's edge; 0: by dimension
    Balance balance = {};
    MpiRanks on = {};

    static constexpr const char* name = "mpi";
    [[nodiscard]] MpiRanks const& ranks() const { return on; }
    [[nodiscard]] int threads() const { return local.threads(); }
    void check() const { local.check(), balance.check(); }
    void for_each(std::size_t tasks, auto const& run) const { local.for_each(tasks, run); }
};
Mpi()->Mpi<>;
template <class Local>
Mpi(Local) -> Mpi<Local>;
template <class Local>
Mpi(Local, int) -> Mpi<Local>;
template <class Local>
Mpi(Local, int, Balance) -> Mpi<Local>;

} // namespace spate
