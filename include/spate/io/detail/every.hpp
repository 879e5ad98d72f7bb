// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief When an output at even intervals is due; it never asks a run to change its steps.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

namespace spate::io::detail {

/// Due at the first step at or after each multiple of an interval, at most once a step; with interval 0 at each step.
class Every {
public:
    explicit Every(double interval) : interval_(interval) {}

    bool due(double time)
    {
        if (interval_ <= 0) return true;
        const double n = std::floor(time / interval_ * (1 + 1e-12)); // 3 * 0.1 is a multiple of 0.1
        if (n < next_) return false;
        next_ = n + 1;
        return true;
    }

    /// What a restart needs: f(name, number). Of another interval only when the last one was due.
    void notes(std::string const& name, auto const& f)
    {
        double interval = interval_, next = next_;
        f(name + "_interval", interval), f(name + "_next", next);
        if (interval == interval_) next_ = next;
        else if (interval_ > 0) next_ = std::floor((next - 1) * interval / interval_ * (1 + 1e-12)) + 1;
    }

private:
    double interval_; ///< [s]
    double next_ = 0; ///< multiple of the interval that is waited for
};

} // namespace spate::io::detail
