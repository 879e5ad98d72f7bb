// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief How far a run is and how long it will take, on standard error.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <limits>
#include <string>

#include <unistd.h>

namespace spate::io {

/// In a terminal a line that is renewed a few times a second; else a line each tenth of the run; or nothing.
class Progress {
public:
    enum class Shown { live, tenths, nothing };

    /// \param until  end time [s]    \param steps  of the run at most
    Progress(double until, std::int64_t steps, Shown shown, std::ostream& out = std::cerr)
        : until_(until), steps_(steps), shown_(shown), out_(&out)
    {}
    static Shown usual(bool quiet)
    {
        return quiet ? Shown::nothing : ::isatty(STDERR_FILENO) != 0 ? Shown::live : Shown::tenths;
    }

    void begin(auto const& scene)
    {
        start_ = shown_at_ = Clock::now();
        time_ = scene.time(), step_ = scene.steps();
        tenths_ = 0;
    }
    void step(auto const& scene) { look(scene.time(), scene.steps(), false); }
    void end(auto const& scene)
    {
        if (shown_ != Shown::live) return;
        look(scene.time(), scene.steps(), true);
        *out_ << '\n' << std::flush;
    }

private:
    using Clock = std::chrono::steady_clock;

    void look(double time, std::int64_t step, bool last)
    {
        if (shown_ == Shown::nothing) return;
        const double by_time = until_ > time_ ? (time - time_) / (until_ - time_) : 1;
        const double by_steps = steps_ > 0 ? double(step - step_) / double(steps_) : 1;
        const double done = std::clamp(std::max(by_time, by_steps), 0.0, 1.0);
        const auto now = Clock::now();
        if (shown_ == Shown::tenths) {
            const int tenths = int(10 * done + 1e-9);
            if (tenths <= tenths_) return;
            tenths_ = tenths;
        }
        else if (!last && now - shown_at_ < std::chrono::milliseconds(200)) return;
        shown_at_ = now;
        show(time, step, done, std::chrono::duration<double>(now - start_).count());
    }
    [[gnu::cold]] void show(double time, std::int64_t step, double done, double spent) const
    {
        std::string text(120, '\0');
        const int n =
            std::snprintf(text.data(), text.size(), "%3.0f %%  t = %.4g s  step %lld  %s left", 100 * done, time,
                          static_cast<long long>(step), duration(done > 0 ? spent * (1 - done) / done : 0).c_str());
        text.resize(std::size_t(std::clamp(n, 0, int(text.size()) - 1)));
        if (shown_ == Shown::live) *out_ << '\r' << text << "   " << std::flush;
        else *out_ << text << '\n' << std::flush;
    }
    /// "1 h 02 min", "3 min 20 s", "45 s".
    [[gnu::cold]] static std::string duration(double seconds)
    {
        const auto s = static_cast<long long>(std::min(seconds, 1e9) + 0.5);
        const auto two = [](long long n) { return std::to_string(n / 10) + std::to_string(n % 10); }; // n < 60
        if (s >= 3600) return std::to_string(s / 3600) + " h " + two(s / 60 % 60) + " min";
        if (s >= 60) return std::to_string(s / 60) + " min " + two(s % 60) + " s";
        return std::to_string(s) + " s";
    }

    double until_;
    std::int64_t steps_;
    Shown shown_;
    std::ostream* out_;
    Clock::time_point start_, shown_at_;
    double time_ = 0;
    std::int64_t step_ = 0;
    int tenths_ = 0;
};

} // namespace spate::io
