// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief history.csv: energies, momentum, extremes and whatever is measured, one row at even times.
///        Not the state of the particles: those are snapshots.
#pragma once

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/core/together.hpp"
#include "spate/io/detail/every.hpp"
#include "spate/io/detail/replace_file.hpp"
#include "spate/io/output_error.hpp"

namespace spate::io {

namespace detail {

/// A matrix of fixed size, such as Eigen's: what a measure of stress returns.
template <class M>
concept Tensor = requires(M const& m)
{
    M::RowsAtCompileTime, M::ColsAtCompileTime;
    double(m(0, 0));
};

/// One line of a table, its cells separated by commas; numbers as the shortest decimal that reads back as the same.
class Row {
public:
    [[gnu::cold]] void add(std::string_view word) { (text_ += text_.empty() ? "" : ",") += word; }
    [[gnu::cold]] void add(double value)
    {
        std::array<char, 32> cell{};
        add(std::string_view(cell.data(), std::to_chars(cell.data(), cell.data() + cell.size(), value).ptr));
    }
    [[gnu::cold]] void add(std::int64_t value) { add(std::string_view(std::to_string(value))); }
    template <int Dim>
    void add(Vec<Dim, double> const& value)
    {
        for (int c = 0; c < Dim; ++c) add(value[c]);
    }
    void add(Tensor auto const& value)
    {
        for (int a = 0; a < value.RowsAtCompileTime; ++a)
            for (int b = 0; b < value.ColsAtCompileTime; ++b) add(double(value(a, b)));
    }
    std::string const& text() const { return text_; }

private:
    std::string text_;
};

/// "front" for a number, "force_x", "force_y", ... for a vector, "stress_xx", "stress_xy", ... for a tensor.
inline std::vector<std::string> headings(std::string const& name, double) { return {name}; }
template <int Dim>
[[gnu::cold]] std::vector<std::string> headings(std::string const& name, Vec<Dim, double>)
{
    std::vector<std::string> all;
    for (int c = 0; c < Dim; ++c) all.push_back(name + "_" + "xyz"[c]);
    return all;
}

[[gnu::cold]] std::vector<std::string> headings(std::string const& name, Tensor auto const& value)
{
    std::vector<std::string> all;
    for (int a = 0; a < value.RowsAtCompileTime; ++a)
        for (int b = 0; b < value.ColsAtCompileTime; ++b) all.push_back(name + "_" + "xyz"[a] + "xyz"[b]);
    return all;
}

} // namespace detail

/// History{directory, 0.001, Front{...}, Probe{...}}: an output of Simulation::run. A column is anything with a name that,
/// called with the scene, returns a number, a vector or a tensor, or a range of such columns. Rows grow in
/// history.csv.tmp and are history.csv when the run ends. A run that goes on keeps the rows that it had.
template <class... Column>
class History {
public:
    /// \param every  interval between two rows [s]; 0: a row each step
    [[gnu::cold]] History(std::filesystem::path const& directory, double every, Column... columns)
        : file_(directory / "history.csv"), tmp_(file_.string() + ".tmp"), every_(every),
          columns_(std::move(columns)...)
    {
        require_non_negative("History.every", every, "s");
    }
    History(History const&) = delete;
    History& operator=(History const&) = delete;
    ~History()
    {
        if (out_.is_open()) out_.close(); // cut short: the rows stay in the temporary file
    }

    [[gnu::cold]] void begin(auto& scene)
    {
        const std::string head = heading(scene);
        const bool goes_on = so_far_.written >= 0;
        by_one(party_of(scene), [&] {
            if (goes_on) keep_rows(head);
            errno = 0;
            out_.open(tmp_, goes_on ? std::ios::app : std::ios::trunc);
            if (!goes_on) line(head);
        });
        if (goes_on) return;
        write(scene);
        every_.due(scene.time());
    }
    void step(auto& scene)
    {
        if (every_.due(scene.time())) write(scene);
    }
    [[gnu::cold]] void end(auto& scene)
    {
        const SoFar even = so_far_;
        if (!scene.stopped() && so_far_.written != scene.steps()) write(scene);
        so_far_ = even; // a run that goes on would not have had the row of the end
        by_one(party_of(scene), [&] {
            out_.close();
            if (!out_) throw OutputError(file_, errno);
            std::error_code error;
            std::filesystem::rename(tmp_, file_, error);
            if (error) throw OutputError(file_, error.value());
            detail::sync_directory(file_);
        });
    }
    std::filesystem::path const& file() const { return file_; }
    /// What a restart needs: f(name, number).
    void notes(auto const& f)
    {
        every_.notes("history", f);
        f("history_since", so_far_.since), f("history_at", so_far_.at), f("history_start", so_far_.start);
        f("history_moment", so_far_.moment);
        f("history_written", so_far_.written);
        for (std::size_t c = 0; c < so_far_.wall.size(); ++c) {
            const std::string axis = std::to_string(c);
            f("history_wall_force_" + axis, so_far_.wall[c][0]), f("history_wall_impulse_" + axis, so_far_.wall[c][1]);
        }
    }

private:
    /// What the next row depends on.
    struct SoFar {
        double since = 0, at = 0;                    ///< times of the first and the last row [s]
        std::array<std::array<double, 2>, 3> wall{}; ///< by axis: force of the walls at the last row [N], impulse [N s]
        double start = 0;          ///< total energy of the first row, less what had come in before [J]
        double moment = 0;         ///< of mass that had entered before the first row [kg s]
        std::int64_t written = -1; ///< step of the last row
    };
    /// The rows of this run up to the last one of which so_far_ knows, if they are there; else none.
    [[gnu::cold]] void keep_rows(std::string const& head) const
    {
        std::ifstream in(std::filesystem::exists(tmp_) ? tmp_ : file_);
        std::string row, kept = head + "\n";
        if (std::getline(in, row) && row == head)
            while (std::getline(in, row) && !in.eof()) { // a row that was cut off has no end
                std::int64_t step = -1;
                std::from_chars(row.data(), row.data() + row.size(), step);
                if (step < 0 || step > so_far_.written) break;
                kept += row + "\n";
            }
        in.close();
        detail::replace_file(tmp_, kept);
    }
    template <class Scene>
    static constexpr bool has_density =
        std::remove_cvref_t<decltype(std::declval<Scene&>().particles())>::template has<Density>;

    template <class Scene>
    static constexpr bool has_markers = requires(Scene& s)
    {
        s.wall_force();
    };
    /// What the walls have given to the particles since the first row: the trapezoidal rule over the rows [N s].
    template <class Scene>
    [[gnu::cold]] auto wall_impulse(Scene& scene)
    {
        auto impulse = scene.wall_force(); // on the walls
        for (int c = 0; c < Scene::dim; ++c) {
            const double now = -impulse[c];
            auto& [before, sum] = so_far_.wall[std::size_t(c)];
            if (so_far_.written >= 0) sum += 0.5 * (before + now) * (scene.time() - so_far_.at);
            before = now, impulse[c] = sum;
        }
        so_far_.at = scene.time();
        return impulse;
    }
    template <class Scene>
    [[gnu::cold]] std::string heading(Scene& scene) const
    {
        detail::Row row;
        std::vector<std::string> taken;
        auto add = [&](std::string const& name) {
            if (name.empty() || name.find_first_of(",\"\n\r") != std::string::npos)
                throw BadInput("the name of a column of history.csv", "\"" + name + "\"",
                               "a word without commas and quotes");
            if (std::find(taken.begin(), taken.end(), name) != taken.end())
                throw BadInput("the name of a column of history.csv", "\"" + name + "\" twice",
                               "a name of its own for each");
            taken.push_back(name);
            row.add(name);
        };
        for (auto* name : {"step", "t", "dt", "dt_criterion", "kinetic", "potential"}) add(name);
        add(has_density<Scene> ? "compressive" : "elastic");
        add(scene.driven() ? "dissipated_less_work" : "dissipated"); // the work of walls and forces is not known apart
        if constexpr (Scene::writes_energy)
            add("reinitialised"); // what re-initialisation gave: part of what is not dissipated
        for (auto const& name : detail::headings("momentum", scene.momentum())) add(name);
        if constexpr (has_density<Scene>) add("volume");
        for (auto const& name : detail::headings("gravity_impulse", scene.momentum())) add(name);
        if constexpr (has_markers<Scene>)
            for (auto const& name : detail::headings("wall_impulse", scene.momentum())) add(name);
        add("max_speed");
        if constexpr (has_density<Scene>) add("density_min"), add("density_max");
        each_column([&](auto const& c) { each_of(detail::headings(c.name, decltype(c(scene)){}), add); });
        return row.text();
    }
    [[gnu::cold]] static void each_of(std::vector<std::string> const& names, auto const& f)
    {
        for (auto const& name : names) f(name);
    }
    template <class C>
    static void each_in(C const& c, auto const& f)
    {
        if constexpr (requires { c.name; }) f(c);
        else
            for (auto const& one : c) each_in(one, f);
    }
    void each_column(auto const& f) const
    {
        std::apply([&](auto const&... c) { (each_in(c, f), ...); }, columns_);
    }
    template <class Scene>
    [[gnu::cold]] void write(Scene& scene) // seldom: small and quick to compile
    {
        scene.refresh();
        const auto e = scene.energy();
        const auto came = scene.exchanged(); // with particles that entered and left
        if (so_far_.written < 0) {
            so_far_.start = e.total() - came.energy(), so_far_.since = scene.time();
            so_far_.moment = came.moment - came.mass() * so_far_.since;
        }
        const auto extremes = scene.system().extremes();
        detail::Row row;
        row.add(scene.steps());
        row.add(scene.time());
        row.add(scene.dt());
        row.add(scene.criterion());
        for (double part : {e.kinetic, e.potential, e.internal, so_far_.start - (e.total() - came.energy())})
            row.add(part);
        if constexpr (Scene::writes_energy) row.add(scene.written_energy());
        row.add(scene.momentum());
        if constexpr (has_density<Scene>) row.add(scene.volume());
        const double changed = // 0 where the mass has always been the same
            came.moment - came.mass() * so_far_.since - so_far_.moment;
        row.add((scene.total_mass() * (scene.time() - so_far_.since) - changed) * scene.gravity());
        if constexpr (has_markers<Scene>) row.add(wall_impulse(scene));
        row.add(extremes.speed);
        if constexpr (has_density<Scene>) row.add(extremes.least_density), row.add(extremes.most_density);
        each_column([&](auto const& c) { row.add(c(scene)); });
        by_one(party_of(scene), [&] { line(row.text()); });
        so_far_.written = scene.steps();
    }
    [[gnu::cold]] void line(std::string const& text)
    {
        out_ << text << '\n' << std::flush;
        if (!out_) throw OutputError(file_, errno);
    }

    std::filesystem::path file_, tmp_;
    detail::Every every_;
    std::tuple<Column...> columns_;
    std::ofstream out_;
    SoFar so_far_;
};

} // namespace spate::io
