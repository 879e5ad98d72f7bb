// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A transport that counts what is asked of it, and hands it on to another.
#pragma once

#include <spate/cells/skins.hpp>
#include <spate/core/ranks.hpp>

#include <array>
#include <memory>

namespace bench {

using namespace spate;

/// What a rank has asked of its transport.
struct Asked {
    std::int64_t reductions = 0, reduced = 0;                     ///< of one value or a few; their bytes
    std::int64_t wide = 0, widely = 0;                            ///< of a value for each rank (new cuts); their bytes
    std::int64_t scatters = 0, parcels = 0, sent = 0;             ///< messages to whom it may concern; bytes
    std::array<std::int64_t, 4> exchanges{}, messages{}, bytes{}; ///< by tag: a species each, then boxes of patches

    friend Asked operator-(Asked a, Asked const& b)
    {
        a.reductions -= b.reductions, a.reduced -= b.reduced, a.wide -= b.wide, a.widely -= b.widely;
        a.scatters -= b.scatters, a.parcels -= b.parcels, a.sent -= b.sent;
        for (std::size_t t = 0; t < 4; ++t)
            a.exchanges[t] -= b.exchanges[t], a.messages[t] -= b.messages[t], a.bytes[t] -= b.bytes[t];
        return a;
    }
};

/// Particles of a source, here or of others, that the task of a cell may read: those in its patches and in those around. That they
/// are many is what a small cell costs beside its pairs.
template <int Dim>
std::int64_t in_reach(Index<Dim> const& cell, Binning<Dim> const& own, Binning<Dim> const& foreign,
                      Grid<Dim> const& grid)
{
    const int M = grid.cell();
    std::int64_t n = 0;
    std::array<std::int32_t, std::size_t(Dim)> period, edge;
    std::size_t all = 1;
    for (int c = 0; c < Dim; ++c) {
        const auto k = std::size_t(c);
        period[k] = grid.bins(c) / grid.per_range(c);
        edge[k] = period[k] > 0 ? std::min(M + 2, period[k]) : M + 2;
        all *= std::size_t(edge[k]);
    }
    for (std::size_t q = 0; q < all; ++q) {
        Index<Dim> patch;
        std::size_t rest = q;
        for (std::size_t k = 0; k < std::size_t(Dim); rest /= std::size_t(edge[k]), ++k) {
            patch[k] = cell[k] * M - 1 + std::int32_t(rest % std::size_t(edge[k]));
            if (period[k] > 0) patch[k] = (patch[k] % period[k] + period[k]) % period[k];
        }
        for (auto const* bins : {&own, &foreign})
            if (bins->find(cell_of_patch(patch, grid)) >= 0) {
                const auto there = Skins<Dim>::particles_of(*bins, number_of_patch(patch, *bins, grid), grid);
                n += there.last - there.first;
            }
    }
    return n;
}

/// \tparam R  a model of Ranks
template <class R>
class Counting {
public:
    static constexpr bool alone = false;
    static constexpr const char* name = R::name;

    explicit Counting(R on) : on_(std::move(on)) {}
    [[nodiscard]] Asked const& asked() const { return *asked_; }

    [[nodiscard]] int rank() const { return on_.rank(); }
    [[nodiscard]] int count() const { return on_.count(); }
    template <class T, class Merge>
    [[nodiscard]] T all(T mine, Merge const& merge) const
    {
        ++asked_->reductions, asked_->reduced += std::int64_t(sizeof(T));
        return on_.all(std::move(mine), merge);
    }
    template <class Merge>
    void each(auto& values, Merge const& merge) const
    {
        const std::span some(values);
        const bool is_wide = some.size() == std::size_t(count());
        ++(is_wide ? asked_->wide : asked_->reductions);
        (is_wide ? asked_->widely : asked_->reduced) += std::int64_t(some.size_bytes());
        on_.each(values, merge);
    }
    [[nodiscard]] std::vector<Parcel> scatter(std::vector<Parcel> parcels) const
    {
        ++asked_->scatters;
        for (auto const& p : parcels)
            if (p.rank != rank()) ++asked_->parcels, asked_->sent += std::int64_t(p.message.bytes().size());
        return on_.scatter(std::move(parcels));
    }
    [[nodiscard]] auto exchange(std::span<Packet const> out, std::span<Packet const> in, int tag) const
    {
        const auto t = std::size_t(tag);
        ++asked_->exchanges[t], asked_->messages[t] += std::int64_t(out.size());
        for (auto const& p : out) asked_->bytes[t] += std::int64_t(p.bytes.size());
        return on_.exchange(out, in, tag);
    }

private:
    R on_;
    std::shared_ptr<Asked> asked_ = std::make_shared<Asked>();
};

} // namespace bench
