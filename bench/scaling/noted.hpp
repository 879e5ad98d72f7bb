// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A transport and workers that keep a diary: when a rank worked, sent, received and waited. The transport can be
/// made patient (it waits for all messages when they are asked for: no overlap) and slow (messages come later).
#pragma once

#include <spate/core/ranks.hpp>

#include <chrono>
#include <deque>

namespace bench {

using namespace spate;

struct Diary {
    enum Kind { work, sent, came, waited };
    struct Entry {
        Kind kind;
        int tag;           ///< of the message, -1: none
        double begin, end; ///< [s]
    };
    std::vector<Entry> entries;
    bool open = false;

    static double now()
    {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    }
    void note(Kind kind, int tag, double begin)
    {
        if (open) entries.push_back({kind, tag, begin, now()});
    }
};

/// \tparam R  a model of Ranks
template <class R>
class Noted {
public:
    static constexpr bool alone = false;
    static constexpr const char* name = R::name;

    R on;
    Diary* diary;
    bool patient = false;
    double delay = 0; ///< from sending one's own to receiving others' messages, at least [s]

    [[nodiscard]] int rank() const { return on.rank(); }
    [[nodiscard]] int count() const { return on.count(); }
    template <class T, class Merge>
    [[nodiscard]] T all(T mine, Merge const& merge) const
    {
        const double begin = Diary::now();
        T merged = on.all(std::move(mine), merge);
        diary->note(Diary::waited, -1, begin);
        return merged;
    }
    template <class Merge>
    void each(auto& values, Merge const& merge) const
    {
        const double begin = Diary::now();
        on.each(values, merge);
        diary->note(Diary::waited, -1, begin);
    }
    [[nodiscard]] std::vector<Parcel> scatter(std::vector<Parcel> parcels) const
    {
        const double begin = Diary::now();
        auto came = on.scatter(std::move(parcels));
        diary->note(Diary::waited, -1, begin);
        return came;
    }
    using Inner = std::remove_cvref_t<decltype(std::declval<R const&>().exchange({}, {}, 0))>;
    class Flown {
    public:
        Flown(Inner inner, Diary* diary, int tag, bool patient, double from)
            : inner_(std::move(inner)), diary_(diary), tag_(tag), from_(from)
        {
            if (!patient) return;
            const double begin = Diary::now();
            wait_for_delay();
            for (int k; (k = inner_.next()) >= 0;) named(k), known_.push_back(k);
            diary_->note(Diary::waited, tag_, begin);
            done_ = true;
        }
        int poll()
        {
            if (!known_.empty()) return take();
            if (done_ || Diary::now() < from_) return -1;
            return named(inner_.poll());
        }
        int next()
        {
            if (!known_.empty()) return take();
            if (done_) return -1;
            const double begin = Diary::now();
            wait_for_delay();
            const int k = inner_.next();
            if (k >= 0) diary_->note(Diary::waited, tag_, begin);
            return named(k);
        }

    private:
        void wait_for_delay() const
        {
            while (Diary::now() < from_) {}
        }
        int take()
        {
            const int k = known_.front();
            known_.pop_front();
            return k;
        }
        int named(int k)
        {
            if (k >= 0) diary_->note(Diary::came, tag_, Diary::now());
            return k;
        }
        Inner inner_;
        Diary* diary_;
        int tag_;
        double from_; ///< the time at which messages may have come
        std::deque<int> known_;
        bool done_ = false;
    };
    [[nodiscard]] Flown exchange(std::span<Packet const> out, std::span<Packet const> in, int tag) const
    {
        const double begin = Diary::now();
        auto inner = on.exchange(out, in, tag);
        diary->note(Diary::sent, tag, begin);
        return {std::move(inner), diary, tag, patient, begin + delay};
    }
};

/// Workers whose tasks are written down, a batch at a time.
template <class Local>
struct Watched {
    Local local;
    Diary* diary;

    static constexpr const char* name = Local::name;
    [[nodiscard]] int threads() const { return local.threads(); }
    void check() const { local.check(); }
    void for_each(std::size_t tasks, auto const& run) const
    {
        const double begin = Diary::now();
        local.for_each(tasks, run);
        diary->note(Diary::work, -1, begin);
    }
};

} // namespace bench
