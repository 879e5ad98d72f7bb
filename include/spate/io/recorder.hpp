// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Keeps states of a scene of any type, by steps or by the clock, and is the flight recorder: after a Stop the last
///        good state and the failing one are on disk. Not the file: that is File, such as that of io/checkpoint.hpp.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <string>
#include <system_error>
#include <variant>
#include <vector>

#include "spate/core/together.hpp"
#include "spate/io/any_scene.hpp"
#include "spate/io/keep.hpp"
#include "spate/io/output_error.hpp"
#include "spate/io/resume.hpp"
#include "spate/io/state.hpp"
#include "spate/io/state_of.hpp"

namespace spate::io {

/// The last two files that it wrote are kept. A File has write(ranks, path, part of the state) and read(path).
template <class File>
class Recorder {
public:
    [[gnu::cold]] Recorder(File file, std::filesystem::path directory, Keep keep)
        : file_(std::move(file)), directory_(std::move(directory)), keep_(keep)
    {
        keep_.check();
    }
    /// The scene goes on from a file. Throws BadInput, and nothing has changed.
    [[gnu::cold]] void restart(AnyScene& scene, std::filesystem::path const& file)
    {
        State state;
        detail::resume_from(scene, [&]() -> State const& { return state = file_.read(file); });
        std::error_code error;
        if (std::filesystem::equivalent(file.parent_path().empty() ? "." : file.parent_path(), directory_, error))
            written_.push_back(file);
        last_ = file, at_ = scene.facts().step;
    }
    [[gnu::cold]] void begin(AnyScene& scene)
    {
        if (scene.rank() == 0) remove_unfinished();
        wall_ = Clock::now();
        if (keep_.recorder > 0 && at_ != scene.facts().step) remember(scene);
    }
    /// After a step, as this rank sees it.
    [[nodiscard]] Due due(std::int64_t step) const
    {
        if (by_steps(step) || by_clock()) return Due::write;
        return keep_.recorder > 0 && step - at_ >= keep_.recorder ? Due::remember : Due::nothing;
    }
    /// Whether ranks may differ in what is due.
    [[nodiscard]] bool by_the_clock() const { return keep_.wall > 0; }
    [[gnu::cold]] void keep(AnyScene& scene, Due due)
    {
        if (due == Due::write) write(scene);
        else remember(scene);
    }
    [[gnu::cold]] void end(AnyScene& scene)
    {
        const Facts facts = scene.facts();
        if (facts.stopped) return record(scene);
        if (at_ == facts.step && remembered_.empty()) return;
        if (keep_.steps > 0 || keep_.wall > 0 || scene.interrupted()) write(scene);
    }
    /// The last checkpoint on disk, empty if there is none.
    [[nodiscard]] std::filesystem::path const& last() const { return last_; }
    /// The state that a Stop has ended, empty if none has.
    [[nodiscard]] std::filesystem::path const& failing() const { return failing_; }
    /// For the message of a Stop: where the states are.
    [[nodiscard]] std::string const& saved() const { return saved_; }

private:
    using Clock = std::chrono::steady_clock;
    struct Remembered {
        std::int64_t step;
        State part; ///< what of the state is here
    };

    [[nodiscard]] bool by_steps(std::int64_t step) const { return keep_.steps > 0 && step % keep_.steps == 0; }
    [[nodiscard]] bool by_clock() const
    {
        return keep_.wall > 0 && std::chrono::duration<double>(Clock::now() - wall_).count() >= keep_.wall;
    }

    /// A step that was cut to end at a given time is not one of a longer run: nothing goes on from it.
    static bool cut(AnyScene const& scene) { return scene.facts().criterion == "end"; }
    /// Whether a run can go on from it: a NaN of this step is seen by the next.
    [[gnu::cold]] static bool good(State const& state)
    {
        for (auto const& [name, table] : state.tables) {
            const bool finite = std::visit(
                []<class T>(std::vector<T> const& v) {
                    return std::all_of(v.begin(), v.end(), [](T x) { return std::isfinite(double(x)); });
                },
                table.values);
            if (!finite) return false;
        }
        return true;
    }
    [[nodiscard]] std::filesystem::path path(std::string const& what, std::int64_t step) const
    {
        return directory_ / (what + "_" + std::to_string(step) + ".h5");
    }
    [[gnu::cold]] void write(AnyScene& scene)
    {
        if (cut(scene)) return;
        State now = detail::part_of(scene);
        if (scene.any(!good(now))) return;
        write(scene, std::move(now), scene.facts().step);
        remembered_.clear();
    }
    [[gnu::cold]] void write(AnyScene& scene, State part, std::int64_t step)
    {
        const auto file = path("checkpoint", step);
        file_.write(scene, file, std::move(part)); // parts of all ranks become one
        std::error_code error;
        written_.erase(std::remove(written_.begin(), written_.end(), file), written_.end());
        written_.push_back(file);
        for (; written_.size() > 2; written_.pop_front())
            if (scene.rank() == 0) std::filesystem::remove(written_.front(), error);
        last_ = file, at_ = step, wall_ = Clock::now();
    }
    [[gnu::cold]] void remember(AnyScene& scene)
    {
        at_ = scene.facts().step;
        if (cut(scene)) return;
        State now = detail::part_of(scene);
        if (scene.any(!good(now))) return;
        if (remembered_.size() == 2) remembered_.pop_front();
        remembered_.push_back({at_, std::move(now)});
    }
    /// The last two good states, and the one that was found wanting.
    [[gnu::cold]] void record(AnyScene& scene)
    {
        try {
            for (auto& [step, good] : remembered_) write(scene, std::move(good), step);
            remembered_.clear();
            if (!last_.empty()) saved_ = "the last good state is " + last_.string();
            failing_ = path("failing", scene.facts().step);
            file_.write(scene, failing_, detail::part_of(scene));
            saved_ += (saved_.empty() ? "" : ", ") + ("the failing one " + failing_.string());
        }
        catch (OutputError const& e) {
            not_saved(e);
        }
        catch (OtherRankFailed const& e) {
            not_saved(e);
        }
    }
    [[gnu::cold]] void not_saved(std::exception const& e)
    {
        saved_ += (saved_.empty() ? "" : "; ") + ("not all states could be saved: " + std::string(e.what()));
    }
    /// What a run that was killed while it wrote has left.
    [[gnu::cold]] void remove_unfinished() const
    {
        std::error_code error;
        for (auto const& entry : std::filesystem::directory_iterator(directory_, error)) {
            const std::string name = entry.path().filename().string();
            if (name.rfind("checkpoint_", 0) == 0 && name.size() > 7 && name.substr(name.size() - 7) == ".h5.tmp")
                std::filesystem::remove(entry.path(), error);
        }
    }

    File file_;
    std::filesystem::path directory_;
    Keep keep_;
    std::deque<Remembered> remembered_;
    std::deque<std::filesystem::path> written_; ///< by this run, or gone on from
    std::filesystem::path last_, failing_;
    std::string saved_;
    std::int64_t at_ = -1; ///< step of the last state kept, in memory or on disk
    Clock::time_point wall_ = Clock::now();
};

} // namespace spate::io
