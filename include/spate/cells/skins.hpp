// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A skin for each place: lists reach far beyond the range only where particles move against each other. A patch
/// is a cube of bins of about one range; its skin covers by how much any pair with a target in it may close in.
#pragma once

#include "spate/cells/binning.hpp"
#include "spate/core/ranks.hpp"

#include <atomic>
#include <span>

namespace spate {

/// By how much vectors differ: the box of them, as largest (v, -v).
template <int Dim>
struct alignas(32) Spread {
    static constexpr float nothing = std::numeric_limits<float>::lowest();
    std::array<float, 8> most{nothing, nothing, nothing, nothing, nothing, nothing, nothing, nothing};

    void add(int c, double v)
    {
        auto &hi = most[std::size_t(c)], &lo = most[std::size_t(c) + 4];
        hi = std::max(hi, float(v)), lo = std::max(lo, -float(v));
    }
    Spread& operator|=(Spread const& b)
    {
        for (std::size_t k = 0; k < 8; ++k) most[k] = most[k] < b.most[k] ? b.most[k] : most[k];
        return *this;
    }
    /// The largest difference of two of them, or a little more: floats are rounded.
    [[nodiscard]] double diagonal() const
    {
        if (most[0] == nothing) return 0;
        double d2 = 0;
        for (std::size_t c = 0; c < std::size_t(Dim); ++c) {
            const double side = double(most[c]) + double(most[c + 4]);
            d2 += side * side;
        }
        return std::sqrt(d2) * (1 + 1e-6);
    }
};

/// f(cell, patch in the cell) for a patch and all around it, wrapped into the period.
template <int Dim>
void each_around(Index<Dim> const& patch, Grid<Dim> const& grid, auto const& f)
{
    const int M = grid.cell();
    constexpr int around = Dim == 1 ? 3 : Dim == 2 ? 9 : 27;
    for (int q = 0; q < around; ++q) {
        Index<Dim> cell;
        std::size_t local = 0, stride = 1;
        int rest = q;
        for (int c = 0; c < Dim; ++c, rest /= 3) {
            std::int32_t at = patch[std::size_t(c)] + rest % 3 - 1;
            if (grid.periodic(c)) {
                const std::int32_t n = grid.bins(c) / grid.per_range(c);
                at = (at % n + n) % n;
            }
            cell[std::size_t(c)] = grid.cell_of(c, at * grid.per_range(c));
            local += stride * std::size_t(at - cell[std::size_t(c)] * M);
            stride *= std::size_t(M);
        }
        f(cell, local);
    }
}
/// The place of a patch, by its number in a cell.
template <int Dim>
[[nodiscard]] Index<Dim> patch_at(Index<Dim> const& cell, std::size_t local, Grid<Dim> const& grid)
{
    const int M = grid.cell();
    Index<Dim> patch;
    auto rest = std::int32_t(local);
    for (int c = 0; c < Dim; ++c, rest /= M) patch[std::size_t(c)] = cell[std::size_t(c)] * M + rest % M;
    return patch;
}

template <int Dim>
[[nodiscard]] Index<Dim> cell_of_patch(Index<Dim> const& patch, Grid<Dim> const& grid)
{
    Index<Dim> cell;
    for (int c = 0; c < Dim; ++c) cell[std::size_t(c)] = grid.cell_of(c, patch[std::size_t(c)] * grid.per_range(c));
    return cell;
}
/// The number of a patch in an occupied cell.
template <int Dim>
[[nodiscard]] std::size_t number_of_patch(Index<Dim> const& patch, Binning<Dim> const& bins, Grid<Dim> const& grid)
{
    const Index<Dim> cell = cell_of_patch(patch, grid);
    std::size_t local = 0;
    for (int c = Dim - 1; c >= 0; --c) {
        const auto k = std::size_t(c);
        local = local * std::size_t(grid.cell()) + std::size_t(patch[k] - cell[k] * grid.cell());
    }
    return std::size_t(bins.find(cell)) * std::size_t(grid.bins_of_cell() / grid.finer()) + local;
}

/// The skins of the lists of one target, by patch: numbered cell by cell, like bins.
template <int Dim>
class Skins {
public:
    /// The same skin everywhere.
    void use(double skin)
    {
        skin_.clear();
        least_ = uniform_ = skin;
    }
    /// Which patches of the mobile particles are near each patch of the target.
    /// \param foreign  mobile particles that others own; their patches are numbered after the own ones
    void look_around(Binning<Dim> const& at, Binning<Dim> const& mobile, Grid<Dim> const& grid,
                     Binning<Dim> const* foreign = nullptr)
    {
        const std::size_t per_cell = patches_of_cell(grid);
        begin_.assign(1, 0);
        near_.clear();
        for (std::size_t k = 0; k < at.cells(); ++k) {
            const Index<Dim> cell = at.cell(k);
            for (std::size_t p = 0; p < per_cell; ++p) {
                if (!particles_of(at, k * per_cell + p, grid).empty())
                    near_patches(patch_at(cell, p, grid), mobile, grid, foreign);
                begin_.push_back(std::int32_t(near_.size()));
            }
        }
    }
    /// What is near a patch, as numbers of patches of the mobile particles.
    [[nodiscard]] std::span<const std::int32_t> near(std::size_t patch) const
    {
        return {near_.data() + begin_[patch], near_.data() + begin_[patch + 1]};
    }
    [[nodiscard]] std::size_t patches() const { return begin_.size() - 1; }
    /// A skin in proportion to how far apart velocities are, the largest where that is `fastest`. Where all move alike
    /// a little is left for what they will do. \param speed  of each patch [m/s]
    void use(double skin, std::vector<double> const& speed, double fastest)
    {
        constexpr double at_rest = 0.1;
        uniform_ = least_ = skin;
        skin_.resize(speed.size());
        for (std::size_t p = 0; p < speed.size(); ++p) {
            skin_[p] = fastest > 0 && !near(p).empty() ? skin * (at_rest + (1 - at_rest) * (speed[p] / fastest)) : skin;
            least_ = std::min(least_, skin_[p]);
        }
    }
    /// The skins of another time. \param skin  where all are the same, and of patches without pairs
    void use(double skin, std::vector<double> of_patch)
    {
        uniform_ = least_ = skin;
        skin_ = std::move(of_patch);
        for (double s : skin_) least_ = std::min(least_, s);
    }
    /// Where a patch lies, counted in patches along each axis: the same for every size of cells.
    static Index<Dim> place(Binning<Dim> const& at, std::size_t patch, Grid<Dim> const& grid)
    {
        const std::size_t per_cell = patches_of_cell(grid);
        Index<Dim> place = at.cell(patch / per_cell);
        auto rest = std::int32_t(patch % per_cell);
        for (int c = 0; c < Dim; ++c, rest /= grid.cell())
            place[std::size_t(c)] = place[std::size_t(c)] * grid.cell() + rest % grid.cell();
        return place;
    }
    /// The place of the patch that holds x: the bins of a range.
    static Index<Dim> place(Vec<Dim, double> const& x, Grid<Dim> const& grid)
    {
        Index<Dim> place;
        for (int c = 0; c < Dim; ++c) {
            const std::int32_t bin = grid.bin(c, x[c]), n = grid.per_range(c);
            place[std::size_t(c)] = bin >= 0 ? bin / n : -((n - 1 - bin) / n);
        }
        return place;
    }
    /// Fraction of the range by which pairs of a patch may close in.
    [[nodiscard]] double of(std::size_t patch) const { return skin_.empty() ? uniform_ : skin_[patch]; }
    [[nodiscard]] double least() const { return least_; }
    [[nodiscard]] bool uniform() const { return skin_.empty(); }
    [[nodiscard]] std::size_t bytes() const
    {
        return 4 * (begin_.capacity() + near_.capacity()) + 8 * skin_.capacity();
    }

    static std::size_t patches_of_cell(Grid<Dim> const& grid)
    {
        return std::size_t(grid.bins_of_cell() / grid.finer());
    }
    /// The particles of a patch: one after the other, since bins run along x first.
    struct Stretch {
        std::int32_t first, last;
        [[nodiscard]] bool empty() const { return first == last; }
    };
    static Stretch particles_of(Binning<Dim> const& at, std::size_t patch, Grid<Dim> const& grid)
    {
        const auto finer = std::size_t(grid.finer());
        return {at.first(patch * finer), at.first((patch + 1) * finer)};
    }

private:
    void near_patches(Index<Dim> const& patch, Binning<Dim> const& mobile, Grid<Dim> const& grid,
                      Binning<Dim> const* foreign)
    {
        const std::size_t per_cell = patches_of_cell(grid);
        Index<Dim> last{};
        std::int32_t found = -2;
        Binning<Dim> const* of = &mobile;
        each_around<Dim>(patch, grid, [&](Index<Dim> const& cell, std::size_t local) {
            if (found == -2 || cell != last) {
                of = &mobile, found = mobile.find(cell), last = cell;
                if (found < 0 && foreign) of = foreign, found = foreign->find(cell);
            }
            if (found < 0) return;
            const std::size_t number = std::size_t(found) * per_cell + local;
            if (particles_of(*of, number, grid).empty()) return;
            near_.push_back(std::int32_t(of == &mobile ? number : number + mobile.cells() * per_cell));
        });
    }

    std::vector<std::int32_t> begin_{0}, near_;
    std::vector<double> skin_;
    double uniform_ = 0, least_ = 0;
};

/// Boxes of vectors: in each patch of the mobile particles, and of all markers.
template <int Dim>
struct Spreads {
    std::vector<Spread<Dim>> mobile;
    Spread<Dim> markers;
};

/// The skins of all targets: species 0 moves, species 1 is its markers, which meet it and not each other.
template <int Dim, int Species>
class LocalSkins {
public:
    [[nodiscard]] Skins<Dim> const& of(int species) const { return skins_[std::size_t(species)]; }
    [[nodiscard]] double least() const { return least_; }
    [[nodiscard]] bool uniform() const { return uniform_; }
    /// The same skin everywhere.
    void use(double skin)
    {
        for (auto& skins : skins_) skins.use(skin);
        least_ = skin, uniform_ = true;
    }
    /// The skins of another time, by target and patch.
    void use(double skin, std::array<std::vector<double>, std::size_t(Species)> of_patch, auto const& ranks)
    {
        double least = skin;
        for (std::size_t s = 0; s < skins_.size(); ++s) {
            skins_[s].use(skin, std::move(of_patch[s]));
            least = std::min(least, skins_[s].least());
        }
        least_ = ranks.all(least, agree::Least{}), uniform_ = false;
    }
    /// Who is near whom, once particles are sorted. \param markers  null: there are none
    /// \param foreign_mobile, foreign_markers  those near that others own
    void look_around(Grid<Dim> const& grid, Binning<Dim> const& mobile, [[maybe_unused]] Binning<Dim> const* markers,
                     Binning<Dim> const* foreign_mobile = nullptr,
                     [[maybe_unused]] Binning<Dim> const* foreign_markers = nullptr)
    {
        skins_[0].look_around(mobile, mobile, grid, foreign_mobile);
        foreign_ = foreign_mobile ? foreign_mobile->cells() * Skins<Dim>::patches_of_cell(grid) : 0;
        by_marker_.assign(skins_[0].patches(), 0);
        if constexpr (Species == 2) {
            skins_[1].look_around(*markers, mobile, grid, foreign_mobile);
            mark(skins_[1]);
            if (!foreign_markers) return;
            Skins<Dim> of_others;
            of_others.look_around(*foreign_markers, mobile, grid);
            mark(of_others);
        }
    }
    /// add(box, i) adds the vectors of mobile particle i to the box of its patch.
    [[nodiscard]] Spreads<Dim> spreads(Grid<Dim> const& grid, Binning<Dim> const& mobile, Spread<Dim> const& markers,
                                       auto const& add, auto const& backend) const
    {
        Spreads<Dim> of{std::vector<Spread<Dim>>(skins_[0].patches() + foreign_), markers};
        in_tasks(skins_[0].patches(), backend, [&](std::size_t p) {
            const auto here = Skins<Dim>::particles_of(mobile, p, grid);
            for (auto i = here.first; i < here.last; ++i) add(of.mobile[p], std::size_t(i));
        });
        return of;
    }
    /// Skins in proportion to how far apart velocities are, the whole one where that is most.
    void use(double skin, Spreads<Dim> const& velocities, auto const& ranks)
    {
        std::array<std::vector<double>, std::size_t(Species)> speed;
        double fastest = 0;
        for (std::size_t s = 0; s < speed.size(); ++s) {
            speed[s].resize(skins_[s].patches());
            for (std::size_t p = 0; p < speed[s].size(); ++p) {
                speed[s][p] = differ(s, p, velocities);
                fastest = std::max(fastest, speed[s][p]);
            }
        }
        fastest = ranks.all(fastest, agree::Most{});
        double least = skin;
        for (std::size_t s = 0; s < speed.size(); ++s) {
            skins_[s].use(skin, speed[s], fastest);
            least = std::min(least, skins_[s].least());
        }
        least_ = ranks.all(least, agree::Least{}), uniform_ = false;
    }
    /// Whether in any patch displacements differ by more than its skin, `more` [m] left for what is to come.
    [[nodiscard]] bool outrun(Spreads<Dim> const& displacements, double range, double more, auto const& backend) const
    {
        std::atomic<bool> any = false;
        for (std::size_t s = 0; s < skins_.size(); ++s)
            in_tasks(skins_[s].patches(), backend, [&](std::size_t p) {
                if (any || skins_[s].near(p).empty()) return; // no pairs
                if (!(differ(s, p, displacements) + more <= skins_[s].of(p) * range)) any = true;
            });
        return any;
    }
    [[nodiscard]] std::size_t bytes() const
    {
        std::size_t b = by_marker_.capacity();
        for (auto const& skins : skins_) b += skins.bytes();
        return b;
    }

private:
    static void in_tasks(std::size_t patches, auto const& backend, auto const& f)
    {
        constexpr std::size_t some = 512; // patches in a task
        backend.for_each((patches + some - 1) / some, [&](std::size_t task) {
            for (std::size_t p = task * some, end = std::min(patches, p + some); p < end; ++p) f(p);
        });
    }
    /// By how much the vectors of pairs with a target in a patch may differ.
    [[nodiscard]] double differ(std::size_t s, std::size_t patch, Spreads<Dim> const& spread) const
    {
        Spread<Dim> all;
        for (auto const g : skins_[s].near(patch)) all |= spread.mobile[std::size_t(g)];
        if (s == 1 ? !skins_[s].near(patch).empty() : by_marker_[patch] != 0) all |= spread.markers;
        return all.diagonal();
    }

    void mark(Skins<Dim> const& markers)
    {
        for (std::size_t p = 0; p < markers.patches(); ++p)
            for (auto const g : markers.near(p))
                if (std::size_t(g) < by_marker_.size()) by_marker_[std::size_t(g)] = 1;
    }

    std::array<Skins<Dim>, std::size_t(Species)> skins_;
    std::vector<char> by_marker_; ///< of each patch of the mobile particles: whether markers are near
    std::size_t foreign_ = 0;     ///< patches of mobile particles of others
    double least_ = 0;            ///< of all skins, on all ranks
    bool uniform_ = true;
};

} // namespace spate
