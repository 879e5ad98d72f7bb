// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What a System does because it is cut over ranks: particles, and what is kept of their pairs, go home; cells are cut
/// by number or by cost. Included by backends of many ranks.
#pragma once

#include "spate/physics/decomposition.hpp"
#include "spate/physics/measures.hpp"

#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace spate {

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::redistribute(Shares<dim> shares)
{
    set_aside();
    parts_.use(std::move(shares));
    count_moved_cells();
    OfParticles skin;
    each_species([&](auto s) { skin[std::size_t(s())] = skins_by_particle<s()>(); });
    build_again(!skins_.uniform(), std::move(skin));
}

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::build_again(bool local, OfParticles skin)
{
    OfParticles of_patch;
    go_home(true, &skin);
    each_species([&](auto s) {
        auto& x = species<s()>();
        const auto patch = patches<s()>();
        x.bins.sort(x.particles, grid_, InParts{backend_}, built<s()>);
        if (!local) return;
        auto& mine = of_patch[std::size_t(s())];
        mine.assign(x.bins.cells() * Skins<dim>::patches_of_cell(grid_), neighbours_.closed_in());
        for (std::size_t i = 0; i < patch.size(); ++i)
            mine[number_of_patch(patch[i], x.bins, grid_)] = skin[std::size_t(s())][i];
    });
    skins_.use(neighbours_.closed_in());
    if (local) skins_.use(neighbours_.closed_in(), std::move(of_patch), ranks());
    sorted_markers_ = true;
    meet_others();
    if (neighbours_.local && any_pairs) look_around();
    build_lists();
}

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::restore_lists(bool local, OfParticles skin,
                                                     std::vector<std::pair<Index<dim>, std::int64_t>> const& cost,
                                                     auto const& pairs_of)
{
    make_room();
    each_memory([&]<class Aside>(auto s, auto q, Aside& aside, auto&) {
        aside.put(pairs_of(s, q, std::type_identity<typename Aside::Pair>{}));
    });
    if (ranks().rank() != 0) pairs_evaluated_ = 0; // those of then rank 0 has
    std::vector<CellCost> of_cell;
    for (auto const& [place, c] : cost) of_cell.push_back({along_curve<dim>(cell_of_patch(place, grid_)), c});
    if (ranks().all(!of_cell.empty(), agree::Or{})) parts_.use(Shares<dim>::of_like_cost(std::move(of_cell), ranks()));
    else cut_by_number();
    if (have_lists_) build_again(local, std::move(skin));
    else go_home(false);
}

template <class P, class B, class Workers, class Precision>
auto System<P, B, Workers, Precision>::others() const -> std::vector<Near>
{
    auto const& p = mobile();
    auto const& halo = parts_.halo(0);
    std::vector<Parcel> parcels;
    for (auto const& link : halo.out()) {
        std::vector<Near> ours;
        for (const auto k : link.particle) {
            const auto i = std::size_t(k);
            ours.push_back({p.at(position, i), radius_at<double>(i), p.id()[i]});
        }
        parcels.push_back({link.rank, {}});
        parcels.back().message.put(ours);
    }
    std::vector<Near> all(halo.ids().size());
    for (auto& parcel : ranks().scatter(std::move(parcels)))
        for (auto const& link : halo.in())
            if (link.rank == parcel.rank) {
                const auto theirs = parcel.message.template take_all<Near>();
                for (std::size_t k = 0; k < theirs.size(); ++k) all[std::size_t(link.particle[k])] = theirs[k];
            }
    return all;
}

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::each_cost(auto const& f) const
{
    if (!have_lists_ || !any_pairs) return;
    const std::size_t per_cell = Skins<dim>::patches_of_cell(grid_);
    each_species([&](auto s) {
        auto const& bins = species<s()>().bins;
        for (std::size_t k = 0; k < bins.cells(); ++k) {
            const auto cost = this->template cost_of_cell<s()>(k), n = std::int64_t(bins.end(k) - bins.begin(k));
            for (std::size_t p = k * per_cell; p < (k + 1) * per_cell; ++p)
                if (const auto here = Skins<dim>::particles_of(bins, p, grid_); !here.empty())
                    f(s(), Skins<dim>::place(bins, p, grid_), cost * (here.last - here.first) / n);
        }
    });
}

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::distribute(bool cut)
{
    if (cut) cut_by_number();
    go_home(false);
    if (cut) check_cells();
}

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::wander(std::int64_t step)
{
    if (backend_.balance.forced == 0 || step % backend_.balance.forced != 0 || !have_lists_) return;
    std::vector<CellCost> cost;
    each_species([&](auto s) {
        auto const& bins = species<s()>().bins;
        for (std::size_t k = 0; k < bins.cells(); ++k) {
            const auto key = along_curve<dim>(bins.cell(k));
            cost.push_back({key, std::int64_t(1 + mix(key + std::uint64_t(step)) % 8)});
        }
    });
    redistribute(Shares<dim>::of_like_cost(std::move(cost), ranks()));
}

template <class P, class B, class Workers, class Precision>
auto System<P, B, Workers, Precision>::cell_at(auto const& p, auto field, std::size_t i) const -> Index<dim>
{
    Index<dim> cell;
    for (int c = 0; c < dim; ++c)
        cell[std::size_t(c)] =
            grid_.cell_of(c, grid_.bin(c, grid_.wrapped(c, double(p.column(field)[std::size_t(c)][i]))));
    return cell;
}

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::go_home(bool as_built, OfParticles* extra)
{
    OfParticles nothing;
    if (!extra) extra = &nothing;
    std::map<int, Message> to;
    std::array<std::map<std::uint32_t, int>, std::size_t(species_count)> away;
    bool markers_moved = false;
    each_species([&](auto s) {
        auto& p = species<s()>().particles;
        std::vector<int> home(p.size());
        Index<dim> last{};
        for (std::size_t i = 0; i < home.size(); ++i) {
            const Index<dim> cell = as_built ? cell_at(p, built<s()>, i) : cell_at(p, position, i);
            home[i] = i > 0 && cell == last ? home[i - 1] : parts_.owner(cell);
            last = cell;
            if (home[i] != ranks().rank()) {
                if (i < parts_.owned(s())) away[std::size_t(s())][p.id()[i]] = home[i];
                if (s() == 1) markers_moved = true;
            }
        }
        parts_.leave(s(), p, home, (*extra)[std::size_t(s())], to);
    });
    each_memory([&](auto s, auto q, auto& aside, auto&) {
        using Pair = typename std::remove_cvref_t<decltype(aside)>::Pair;
        std::map<int, std::vector<Pair>> gone;
        auto const& of = away[std::size_t(s())];
        aside.part([&](Pair const& pair) {
            const auto it = of.find(pair.i);
            if (it == of.end()) return false;
            gone[it->second].push_back(pair);
            return true;
        });
        for (auto const& [rank, pairs] : gone) {
            to[rank].put(species_count + s() * species_count + q());
            to[rank].put(pairs);
        }
    });
    std::vector<Parcel> parcels;
    for (auto& [rank, message] : to) parcels.push_back({rank, std::move(message)});
    for (auto& parcel : ranks().scatter(std::move(parcels)))
        while (!parcel.message.empty()) {
            const int what = parcel.message.template take<int>();
            each_species([&](auto s) {
                if (s() != what) return;
                parts_.arrive(s(), species<s()>().particles, (*extra)[std::size_t(s())], parcel.message);
                if (s() == 1) markers_moved = true;
            });
            each_memory([&](auto s, auto q, auto& aside, auto&) {
                using Pair = typename std::remove_cvref_t<decltype(aside)>::Pair;
                if (what == species_count + s() * species_count + q())
                    aside.join(parcel.message.template take_all<Pair>());
            });
        }
    if (markers_moved) sorted_markers_ = false;
    each_species([&](auto s) {
        auto& x = species<s()>();
        if (saves_) x.start.resize(x.particles.size());
        x.particles.pad();
    });
}

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::meet_others()
{
    each_species([&](auto q) {
        auto& x = species<q()>();
        parts_.finish(q());
        auto with = [&](auto... targets) {
            parts_.halo(q()).meet({&species<targets()>().bins...}, x.bins, places<q()>(), x.particles.id(), grid_,
                                  parts_.shares(), ranks());
        };
        constexpr std::integral_constant<int, 0> mobiles{};
        if constexpr (species_count == 2 && q() == 0) with(mobiles, std::integral_constant<int, 1>{});
        else with(mobiles); // markers do not meet
        parts_.place(q(), x.particles.size() + 1 + x.bins.images().of.size());
    });
    each_species(
        [&](auto s) { each_species([&](auto q) { parts_.look_around(s(), q(), species<s()>().bins, grid_); }); });
    if constexpr (species_count > 1) parts_.look_inside(species<1>().bins, species<0>().bins, grid_);
}

template <class P, class B, class Workers, class Precision>
template <int s>
auto System<P, B, Workers, Precision>::patches() const -> std::vector<Index<dim>>
{
    auto const& p = species<s>().particles;
    std::vector<Index<dim>> patch(p.size());
    for (std::size_t i = 0; i < patch.size(); ++i)
        for (int c = 0; c < dim; ++c) {
            const auto k = std::size_t(c);
            const std::int32_t bin = grid_.bin(c, double(p.column(built<s>)[k][i])), n = grid_.per_range(c);
            patch[i][k] = bin >= 0 ? bin / n : -((-bin + n - 1) / n);
        }
    return patch;
}

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::check_cells() const
{
    std::set<Index<dim>> here;
    each_species([&](auto s) {
        auto const& p = species<s()>().particles;
        for (std::size_t i = 0; i < p.size(); ++i) here.insert(cell_at(p, position, i));
    });
    const auto cells = ranks().all(std::int64_t(here.size()), agree::Sum{});
    if (cells > 0 && cells < ranks().count())
        throw BadInput("the number of ranks", std::to_string(ranks().count()),
                       "at most that of occupied cells, " + std::to_string(cells) + "; smaller cells are more");
}

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::cut_by_number()
{
    std::map<std::uint64_t, std::int64_t> in_cell;
    each_species([&](auto s) {
        Index<dim> last{};
        std::int64_t* count = nullptr;
        for (std::size_t i = 0; i < counted<s()>(); ++i) {
            const auto cell = cell_at(species<s()>().particles, position, i);
            if (!count || cell != last) count = &in_cell[along_curve<dim>(cell)], last = cell;
            ++*count;
        }
    });
    std::vector<CellCost> cost;
    for (auto const& [key, n] : in_cell) cost.push_back({key, n});
    parts_.use(Shares<dim>::of_like_cost(std::move(cost), ranks()));
}

template <class P, class B, class Workers, class Precision>
template <int s>
std::int64_t System<P, B, Workers, Precision>::pairs_of_cell(std::size_t k) const
{
    std::int64_t n = 0;
    each_species([&](auto q) {
        if constexpr (M::planner.meet(s, q())) n += this->template lists<s, q()>().of_cell(k).pairs;
    });
    return n;
}

template <class P, class B, class Workers, class Precision>
template <int s>
std::int64_t System<P, B, Workers, Precision>::cost_of_cell(std::size_t k) const
{
    return backend_.balance.by_pairs ? pairs_of_cell<s>(k) : parts_.cost(s)[k];
}

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::cut_by_cost()
{
    auto const& balance = backend_.balance;
    double a_pair = balance.pace; // here [ns], or a unit
    if (!balance.by_pairs) {
        std::int64_t ns = 0;
        each_species([&](auto s) { ns = std::accumulate(parts_.cost(s).begin(), parts_.cost(s).end(), ns); });
        a_pair = double(ranks().all(ns, agree::Sum{})) / std::max(1.0, double(pairs()));
    }
    std::vector<CellCost> cost;
    each_species([&](auto s) {
        auto const& bins = species<s()>().bins;
        for (std::size_t k = 0; k < bins.cells(); ++k) {
            const double tasks = (balance.by_pairs ? a_pair : 1) * double(this->template cost_of_cell<s()>(k));
            const double rest = a_pair * balance.a_particle * double(bins.end(k) - bins.begin(k));
            cost.push_back({along_curve<dim>(bins.cell(k)), std::llround(tasks + rest)});
        }
    });
    parts_.cut_by_cost(std::move(cost), backend_.balance.tolerated);
    count_moved_cells();
}

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::count_moved_cells()
{
    std::set<Index<dim>> moved;
    each_species([&](auto s) {
        auto const& bins = species<s()>().bins;
        for (std::size_t k = 0; k < bins.cells(); ++k)
            if (parts_.owner(bins.cell(k)) != ranks().rank()) moved.insert(bins.cell(k));
    });
    parts_.report().moved_cells += std::int64_t(moved.size());
}

template <class P, class B, class Workers, class Precision>
template <int s>
std::vector<double> System<P, B, Workers, Precision>::skins_by_particle() const
{
    auto const& skins = skins_.of(s);
    auto const& x = species<s>();
    std::vector<double> skin;
    if (skins_.uniform()) return skin;
    skin.resize(x.particles.size());
    for (std::size_t p = 0; p < skins.patches(); ++p) {
        const auto here = Skins<dim>::particles_of(x.bins, p, grid_);
        for (auto i = here.first; i < here.last; ++i) skin[std::size_t(i)] = skins.of(p);
    }
    return skin;
}

} // namespace spate
