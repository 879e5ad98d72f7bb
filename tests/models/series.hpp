// SPDX-License-Identifier: BSD-3-Clause
// Curves over time, of a run or of an experiment, and what is compared of them.
#pragma once

#include "oracle/table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

namespace models {

struct Series {
    std::vector<double> t, y;

    void add(double time, double value) { t.push_back(time), y.push_back(value); }
    [[nodiscard]] double at(double time) const // linear between points
    {
        const auto k = std::size_t(std::clamp(std::upper_bound(t.begin(), t.end(), time) - t.begin(), std::ptrdiff_t(1),
                                              std::ptrdiff_t(t.size()) - 1));
        return y[k - 1] + (y[k] - y[k - 1]) * (time - t[k - 1]) / (t[k] - t[k - 1]);
    }
    /// The first time at which the curve is above a level.
    [[nodiscard]] double above(double level) const
    {
        for (std::size_t k = 0; k < t.size(); ++k)
            if (y[k] > level) return t[k];
        return std::numeric_limits<double>::infinity();
    }
    /// By trapezoids; the ends between points.
    [[nodiscard]] double integral(double from, double to) const
    {
        double sum = 0, s = from;
        for (double time : t) {
            if (time <= from || time >= to) continue;
            sum += 0.5 * (at(s) + at(time)) * (time - s), s = time;
        }
        return sum + 0.5 * (at(s) + at(to)) * (to - s);
    }
    [[nodiscard]] double mean(double from, double to) const { return integral(from, to) / (to - from); }
    [[nodiscard]] double peak() const { return *std::max_element(y.begin(), y.end()); }
};

/// Of a straight line through the points from a time on, by least squares.
inline double slope(Series const& c, double from)
{
    double n = 0, st = 0, sy = 0, stt = 0, sty = 0;
    for (std::size_t k = 0; k < c.t.size(); ++k) {
        if (c.t[k] < from) continue;
        n += 1, st += c.t[k], sy += c.y[k], stt += c.t[k] * c.t[k], sty += c.t[k] * c.y[k];
    }
    return (n * sty - st * sy) / (n * stt - st * st);
}

/// Two columns of a table of tests/data.
/// \param last  rows of later times are left out
inline Series column_of(std::string const& file, std::string const& time, std::string const& value,
                        double last = std::numeric_limits<double>::infinity())
{
    Series c;
    for (auto const& row : spate::oracle::table(file))
        if (std::stod(row.at(time)) <= last) c.add(std::stod(row.at(time)), std::stod(row.at(value)));
    return c;
}

/// A front at the data's times, started late by a shift: the gate of the experiment takes a moment to open.
inline Series shifted(Series const& front, Series const& data, double shift)
{
    Series c;
    for (double t : data.t) c.add(t, front.at(t - shift));
    return c;
}
/// rms of c/data - 1 over the data's points.
inline double relative_error(Series const& c, Series const& data)
{
    double sum = 0;
    for (std::size_t k = 0; k < data.t.size(); ++k) sum += std::pow(c.y[k] / data.y[k] - 1, 2);
    return std::sqrt(sum / double(data.t.size()));
}
/// The shift of time, of those from `first` to 0.30, that makes the relative error least, and that error.
struct BestShift {
    double shift = 0, error = std::numeric_limits<double>::infinity();
};
inline BestShift best_shift(Series const& front, Series const& data, double first = 0.05)
{
    BestShift best;
    for (double shift = first; shift < 0.3005; shift += 0.001) {
        const double e = relative_error(shifted(front, data, shift), data);
        if (e < best.error) best = {shift, e};
    }
    return best;
}

/// An output of Simulation::run: what each measure reads, at even times; NaN (a sensor that is dry) is 0.
template <class... Measure>
struct Recorder {
    double every; ///< [s]
    std::vector<Series>& into;
    std::tuple<Measure const&...> measures;
    double next = 0;

    void begin(auto& scene) { step(scene); }
    void step(auto& scene)
    {
        if (scene.time() < next) return;
        next = scene.time() + every;
        scene.refresh();
        std::size_t k = 0;
        auto read = [&](auto const& measure) {
            for (auto const& one : measure) {
                if (into.size() <= k) into.emplace_back();
                const double value = one(scene);
                into[k++].add(scene.time(), std::isnan(value) ? 0 : value);
            }
        };
        std::apply([&](auto const&... m) { (read(m), ...); }, measures);
    }
    void end(auto&) {}
};

} // namespace models
