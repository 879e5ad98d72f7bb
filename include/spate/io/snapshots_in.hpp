// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Snapshots of a run at even times: which particles and fields go into a series of files.
///        Not the files: those are the series, such as that of io/vtkhdf.hpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include "spate/core/errors.hpp"
#include "spate/core/fields.hpp"
#include "spate/core/ranks.hpp"
#include "spate/io/any_ranks.hpp"
#include "spate/io/cloud.hpp"
#include "spate/io/detail/every.hpp"

namespace spate::io {

namespace detail {

/// What a file shows of a particle's fields: not where lists were built, not rates, and not what is one number for all,
/// but its radius and its velocity.
template <class F, class Particles>
constexpr bool shown =
    !std::same_as<F, Position> && !std::same_as<F, BuildPosition> && std::is_void_v<typename F::rate_of> &&
    (!Set<Particles::uniform>::template contains<F> || std::same_as<F, Radius> || std::same_as<F, Velocity>);

template <class Particles, class... F>
constexpr auto shown_of(Fields<F...>)
{
    return (Fields<>{} | ... | spate::detail::kept<shown<F, Particles>>(F{}));
}

/// The particles of a species in the order of their ids: the same file whoever ran the scene.
[[gnu::cold]] inline std::vector<std::size_t> by_id(std::vector<std::uint32_t> const& id)
{
    std::vector<std::size_t> order(id.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return id[a] < id[b]; });
    return order;
}

template <class Particles, class F>
[[gnu::cold]] void append(Column& column, Particles const& p, std::size_t i, F field)
{
    if constexpr (!Particles::template has<F>)
        for (int c = 0; c < column.components; ++c) column.values.push_back(std::numeric_limits<float>::quiet_NaN());
    else if constexpr (F::rank == 0) column.values.push_back(float(p.at(field, i)));
    else if constexpr (F::axial && Particles::dim < 3) column.values.push_back(float(p.at(field, i)[0]));
    else {
        const auto v = p.at(field, i);
        for (int c = 0; c < 3; ++c) column.values.push_back(c < Particles::dim ? float(v[c]) : 0.0F);
    }
}

} // namespace detail

/// All particles of a scene that are here, with the fields that its mobile particles show, in the order of species and ids.
template <class Scene>
[[gnu::cold]] Cloud cloud_of(Scene const& scene)
{
    using Mobile = std::remove_cvref_t<decltype(scene.particles())>;
    constexpr auto fields = detail::shown_of<Mobile>(Mobile::fields | Mobile::uniform);
    Cloud cloud;
    cloud.time = scene.time();
    cloud.step = scene.steps();
    for_each(fields, [&]<class F>(F) {
        const bool one = F::rank == 0 || (F::axial && Mobile::dim < 3);
        cloud.columns.push_back({std::string(F::name), one ? 1 : 3, {}});
    });
    scene.system().each_species([&](auto s) {
        auto const& p = scene.system().template species<s()>().particles;
        for (const std::size_t i : detail::by_id(p.id())) {
            const auto x = p.at(position, i);
            for (int c = 0; c < 3; ++c) cloud.points.push_back(c < Mobile::dim ? float(x[c]) : 0.0F);
            cloud.id.push_back(p.id()[i]);
            cloud.species.push_back(std::uint8_t(s()));
            std::size_t k = 0;
            for_each(fields, [&](auto f) { detail::append(cloud.columns[k++], p, i, f); });
        }
    });
    return cloud;
}

/// An output of Simulation::run. A series has write(ranks, what of the cloud is here), which returns the file, times() of what
/// it has written, and go_on_from(times): the next one follows these.
template <class Series>
class SnapshotsIn {
public:
    /// \param every  interval between two snapshots [s]; 0: the last state only
    SnapshotsIn(Series series, double every)
        : series_(std::move(series)), interval_(every), every_(every), even_times_(series_.times())
    {
        require_non_negative("Snapshots.every", every, "s");
    }
    void begin(auto& scene)
    {
        series_.go_on_from(even_times_), written_ = even_written_;
        step(scene);
    }
    void step(auto& scene)
    {
        if (interval_ <= 0 || !every_.due(scene.time())) return;
        write(scene);
        even_written_ = written_, even_times_ = series_.times();
    }
    void end(auto& scene)
    {
        if (written_ != scene.steps()) write(scene);
    }
    /// What a restart needs: f(name, numbers).
    void notes(auto const& f)
    {
        every_.notes("snapshots", f);
        f("snapshots_written", even_written_), f("snapshots_times", even_times_);
    }
    std::filesystem::path const& last() const { return last_; }
    std::size_t count() const { return series_.times().size(); }

private:
    [[gnu::cold]] void write(auto& scene) // seldom: small and quick to compile
    {
        scene.refresh();
        last_ = series_.write(TheseRanks(party_of(scene)), cloud_of(scene));
        written_ = scene.steps();
    }

    Series series_;
    double interval_; ///< [s]
    detail::Every every_;
    std::filesystem::path last_;
    std::int64_t written_ = -1, even_written_ = -1; ///< step of the last one; of the last but that of the end
    std::vector<double> even_times_; ///< of all but that of the end, which a run that goes on writes over
};

} // namespace spate::io
