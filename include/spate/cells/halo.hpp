// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What two ranks know of each other's particles of one species: a rank asks the owners for the patches around its
/// targets, once at each rebuild; then values of these particles flow by fixed lists, as often as wanted.
#pragma once

#include "spate/cells/cell_pairs.hpp"
#include "spate/cells/neighbours.hpp"
#include "spate/cells/shares.hpp"

#include <map>

namespace spate {

/// Particles of one species that cross one border between ranks.
struct Link {
    int rank;
    std::vector<std::int32_t> particle; ///< in the order of the messages: own ones, or foreign ones by their number
    std::vector<std::int32_t> patch;    ///< the patches that they are in
};

/// \tparam T  of positions
template <int Dim, class T>
class Halo {
public:
    /// Asks for all patches of a source that targets here may reach, and learns who asks for ours.
    /// \param targets  who is at home here    \param bins, places, ids  of the source, at home here
    template <class R>
    void meet(std::initializer_list<Binning<Dim> const*> targets, Binning<Dim> const& bins,
              Places<Dim, T> const& places, std::vector<std::uint32_t> const& ids, Grid<Dim> const& grid,
              Shares<Dim> const& shares, R const& ranks)
    {
        out_.clear(), in_.clear();
        std::vector<Parcel> parcels;
        std::map<int, std::vector<Index<Dim>>> asked = foreign_around(targets, grid, shares, ranks.rank());
        for (auto const& [rank, patches] : asked) {
            parcels.push_back({rank, {}});
            parcels.back().message.put(patches);
        }
        parcels = ranks.scatter(std::move(parcels));
        for (auto& p : parcels) p = answer(p, bins, places, ids, grid);
        std::erase_if(parcels, [](Parcel const& p) { return p.message.bytes().empty(); });
        take(ranks.scatter(std::move(parcels)), grid);
    }
    /// Those that others own.
    [[nodiscard]] Binning<Dim> const& bins() const { return bins_; }
    [[nodiscard]] Places<Dim, T> places() const
    {
        Places<Dim, T> places{{}, columns_.ids.size()};
        for (std::size_t c = 0; c < std::size_t(Dim); ++c) places.x[c] = columns_.x[c].data();
        return places;
    }
    [[nodiscard]] std::vector<std::uint32_t> const& ids() const { return columns_.ids; }
    [[nodiscard]] std::vector<Link> const& out() const { return out_; }
    [[nodiscard]] std::vector<Link> const& in() const { return in_; }
    [[nodiscard]] std::size_t bytes() const
    {
        std::size_t b = bins_.bytes() + columns_.ids.capacity() * 4;
        for (auto const& x : columns_.x) b += x.capacity() * sizeof(T);
        for (auto const* links : {&out_, &in_})
            for (auto const& l : *links) b += 4 * (l.particle.capacity() + l.patch.capacity());
        return b;
    }

private:
    /// As much of Particles as a Binning sorts.
    struct Columns {
        using real = T;
        std::array<std::vector<T>, std::size_t(Dim)> x;
        std::vector<std::uint32_t> ids;
        std::vector<std::int32_t> order; ///< of the last sort

        [[nodiscard]] std::size_t size() const { return ids.size(); }
        [[nodiscard]] std::vector<std::uint32_t> const& id() const { return ids; }
        [[nodiscard]] auto const& column(Position) const { return x; }
        void permute(std::vector<std::int32_t> const& by, InOnePart)
        {
            order = by;
            reorder(ids);
            for (auto& a : x) reorder(a);
        }
        void reorder(auto& a)
        {
            auto const old = a;
            for (std::size_t k = 0; k < old.size(); ++k) a[k] = old[std::size_t(order[k])];
        }
    };
    struct Patch {
        Index<Dim> at;
        std::uint32_t particles;
    };

    static std::map<int, std::vector<Index<Dim>>> foreign_around(std::initializer_list<Binning<Dim> const*> targets,
                                                                 Grid<Dim> const& grid, Shares<Dim> const& shares,
                                                                 int me)
    {
        struct Around { // a cell near ours
            int owner;
            std::vector<char> asked; // of its patches
        };
        const std::size_t per_cell = Skins<Dim>::patches_of_cell(grid);
        std::map<Index<Dim>, Around> around;
        std::array<Around*, Dim == 1 ? 3 : Dim == 2 ? 9 : 27> beside; // the foreign ones beside a cell, by direction
        auto direction = [](Index<Dim> const& from, Index<Dim> const& to) { // steps of more than one go round a period
            std::size_t d = 0;
            for (std::size_t c = std::size_t(Dim); c-- > 0;) {
                const std::int32_t step = to[c] - from[c];
                d = 3 * d + (step == 0 ? 1 : step == 1 || step < -1 ? 2 : 0);
            }
            return d;
        };
        for (auto const* at : targets)
            for (std::size_t k = 0; k < at->cells(); ++k) {
                const Index<Dim> home = at->cell(k);
                bool any = false;
                beside.fill(nullptr);
                each_cell_around(home, grid, [&](Index<Dim> const& cell) {
                    for (auto const* own : targets)
                        if (own->find(cell) >= 0) return;
                    const auto [it, is_new] = around.try_emplace(cell);
                    if (is_new) it->second.owner = shares.owner(cell);
                    if (it->second.owner == me) return;
                    any = true;
                    beside[direction(home, cell)] = &it->second;
                });
                for (std::size_t p = 0; p < per_cell && any; ++p) {
                    if (Skins<Dim>::particles_of(*at, k * per_cell + p, grid).empty()) continue;
                    each_around<Dim>(patch_at(home, p, grid), grid, [&](Index<Dim> const& cell, std::size_t local) {
                        Around* const it = beside[direction(home, cell)];
                        if (!it) return;
                        it->asked.resize(per_cell);
                        it->asked[local] = 1;
                    });
                }
            }
        std::map<int, std::vector<Index<Dim>>> asked;
        for (auto const& [cell, it] : around)
            for (std::size_t p = 0; p < it.asked.size(); ++p)
                if (it.asked[p] != 0) asked[it.owner].push_back(patch_at(cell, p, grid));
        return asked;
    }
    /// What is in the patches that a rank asks for; empty if nothing is.
    Parcel answer(Parcel& request, Binning<Dim> const& bins, Places<Dim, T> const& places,
                  std::vector<std::uint32_t> const& ids, Grid<Dim> const& grid)
    {
        Link link{request.rank, {}, {}};
        std::vector<Patch> patches;
        std::vector<std::uint32_t> id;
        for (auto const& patch : request.message.template take_all<Index<Dim>>()) {
            if (bins.find(cell_of_patch(patch, grid)) < 0) continue;
            const std::size_t number = number_of_patch(patch, bins, grid);
            const auto here = Skins<Dim>::particles_of(bins, number, grid);
            if (here.empty()) continue;
            patches.push_back({patch, std::uint32_t(here.last - here.first)});
            link.patch.push_back(std::int32_t(number));
            for (auto i = here.first; i < here.last; ++i) link.particle.push_back(i), id.push_back(ids[std::size_t(i)]);
        }
        Parcel reply{request.rank, {}};
        if (patches.empty()) return reply;
        reply.message.put(patches), reply.message.put(id);
        std::vector<T> x(id.size());
        for (std::size_t c = 0; c < std::size_t(Dim); ++c) {
            for (std::size_t k = 0; k < x.size(); ++k) x[k] = places.x[c][link.particle[k]];
            reply.message.put(std::span<T const>(x));
        }
        out_.push_back(std::move(link));
        return reply;
    }
    void take(std::vector<Parcel> replies, Grid<Dim> const& grid)
    {
        columns_ = {};
        std::vector<std::vector<Patch>> patches;
        for (auto& r : replies) {
            patches.push_back(r.message.template take_all<Patch>());
            const auto id = r.message.template take_all<std::uint32_t>();
            Link link{r.rank, {}, {}};
            for (std::size_t k = 0; k < id.size(); ++k)
                link.particle.push_back(std::int32_t(columns_.ids.size() + k)); // until they are sorted
            columns_.ids.insert(columns_.ids.end(), id.begin(), id.end());
            for (auto& x : columns_.x) {
                x.resize(columns_.ids.size());
                r.message.take(std::span<T>(x).last(id.size()));
            }
            in_.push_back(std::move(link));
        }
        bins_.sort(columns_, grid);
        std::vector<std::int32_t> now(columns_.order.size());
        for (std::size_t k = 0; k < now.size(); ++k) now[std::size_t(columns_.order[k])] = std::int32_t(k);
        for (std::size_t l = 0; l < in_.size(); ++l) {
            for (auto& i : in_[l].particle) i = now[std::size_t(i)];
            for (auto const& patch : patches[l])
                in_[l].patch.push_back(std::int32_t(number_of_patch(patch.at, bins_, grid)));
        }
    }

    std::vector<Link> out_, in_;
    Columns columns_;
    Binning<Dim> bins_;
};

} // namespace spate
