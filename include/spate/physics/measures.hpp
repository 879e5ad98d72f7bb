// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What a System tells of its state without changing it: what pairs and walls store and do, what is kept of pairs, its
/// hash and its size.
#pragma once

#include "spate/physics/system.hpp"

namespace spate {

template <class P, class B, class Workers, class Precision>
double System<P, B, Workers, Precision>::pair_energy([[maybe_unused]] auto const& share) const
{
    ExactSum total;
    std::mutex lock;
    if constexpr (M::planner.meet(0, 0) && has_pair_energy) {
        if (alone && species<0>().bins.cells() > 0 && !lists_know_all())
            throw std::logic_error("spate: particles came or went since the lists were built; call "
                                   "make_lists_current() before energy()");
        bring_records<0, M::mask(read_for_energy()) & M::planner.record(0)>();
        backend_.for_each(species<0>().bins.cells(), [&](std::size_t cell) {
            const ExactSum mine = pair_energy_of(cell, share);
            const std::lock_guard hold(lock);
            total += mine;
        });
    }
    return ranks().all(total, agree::Sum{}).value();
}

template <class P, class B, class Workers, class Precision>
std::vector<char> System<P, B, Workers, Precision>::with_foreign(std::vector<char> is) const
{
    if constexpr (!alone) {
        auto& parts = const_cast<Parts&>(parts_); // messages are no state
        const std::size_t n = is.size();
        is.resize(n + 1 + parts_.foreign(0).places.size, 0);
        parts.send(
            0, 1, [&](std::int32_t i, PairT* to) { *to = PairT(is[std::size_t(i)]); },
            [&is, n](std::int32_t i, PairT const* from) { is[n + 1 + std::size_t(i)] = char(*from); });
        parts.finish(0);
    }
    return is;
}

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::wall_sums(auto const& f) const
{
    using Sums = Record<dim, double, Set<(Fields<>{} | M::wall_adds)>>;
    auto terms = terms_;
    carry_at_walls(terms, Carry{due_});
    for (std::size_t i = 0; i < mobile().size(); ++i) {
        Sums sums;
        clear(sums);
        Pushing<Sums> view{{mobile(), i}, sums};
        detail::each_in(terms, [&]<class X>(X const& t) {
            if constexpr (requires { X::pushes; }) t(view);
        });
        f(i, sums);
    }
}

template <class P, class B, class Workers, class Precision>
template <class Sum>
Sum System<P, B, Workers, Precision>::over_contacts(auto const& visit) const
{
    static_assert(M::planner.meet(0, 0), "spate: contacts need a pair term, such as LinearSpring");
    Sum total{};
    std::mutex lock;
    backend_.for_each(species<0>().bins.cells(), [&](std::size_t cell) {
        Sum mine{};
        each_contact(cell, [&](auto const&... what) { visit(mine, what...); });
        const std::lock_guard hold(lock);
        total += mine;
    });
    return total;
}

template <class P, class B, class Workers, class Precision>
auto System<P, B, Workers, Precision>::near(std::size_t j, [[maybe_unused]] std::vector<Near> const& others) const
    -> Near
{
    auto const& p = mobile();
    const std::size_t n = p.size();
    auto moved = [&](Near one, auto const& images, std::size_t image) {
        one.x += shift_of(images.code[image], grid_);
        return one;
    };
    if constexpr (!alone) {
        const auto foreign = parts_.foreign(0);
        if (j >= std::size_t(foreign.first)) {
            const std::size_t k = foreign.number_of(j), record = j - std::size_t(foreign.first);
            return record == k ? others[k] : moved(others[k], foreign.bins.images(), record - foreign.places.size);
        }
    }
    auto const& images = species<0>().bins.images();
    const std::size_t i = j < n ? j : std::size_t(images.of[j - n - 1]);
    const Near one{p.at(position, i), radius_at<double>(i), p.id()[i]};
    return j < n ? one : moved(one, images, j - n - 1);
}

template <class P, class B, class Workers, class Precision>
std::size_t System<P, B, Workers, Precision>::bytes() const
{
    std::size_t b = 0;
    each_species([&](auto s) {
        auto const& x = species<s()>();
        b += x.particles.bytes() + x.start.bytes() + x.bins.bytes() + x.packed.data.capacity() * sizeof(PairT);
    });
    for (auto const& l : lists_) b += l.bytes();
    std::apply(
        [&](auto const&... of_species) {
            auto one = [&](auto const& cells) {
                if constexpr (requires { cells.size(); })
                    for (auto const& of_cell : cells) b += of_cell.bytes();
            };
            (one(of_species), ...);
        },
        memory_);
    std::apply([&](auto const&... aside) { ((b += aside.bytes()), ...); }, aside_);
    b += skins_.bytes();
    return b;
}

template <class P, class B, class Workers, class Precision>
std::uint64_t System<P, B, Workers, Precision>::state_hash() const
{
    std::uint64_t total = 0;
    each_species([&](auto s) {
        auto const& p = species<s()>().particles;
        for (std::size_t i = 0; i < counted<s()>(); ++i) {
            std::uint64_t h = mix(mix(std::uint64_t(s()) + 1) + p.id()[i]);
            for_each(M::template evolving<s()>() | M::template remembered<s()>(), [&](auto f) {
                for (auto const& column : p.column(f)) {
                    std::uint64_t bits = 0;
                    std::memcpy(&bits, &column[i], sizeof(T));
                    h = mix(h ^ bits);
                }
            });
            total += h;
        }
    });
    each_species([&](auto s) {
        each_species([&](auto q) {
            constexpr int values = kept_values<s(), q()>;
            if constexpr (values > 0) {
                for (auto const& pair : kept_of_pairs<s(), q()>()) {
                    std::uint64_t h = mix(mix(mix(std::uint64_t(s() * species_count + q()) + 17) + pair.i) + pair.j);
                    for (T value : pair.value) {
                        std::uint64_t bits = 0;
                        std::memcpy(&bits, &value, sizeof(T));
                        h = mix(h ^ bits);
                    }
                    total += h;
                }
            }
        });
    });
    if constexpr (M::floats)
        if (ranks().rank() == 0) total += hash_of_bodies();
    return ranks().all(total, agree::Sum{});
}

template <class P, class B, class Workers, class Precision>
template <int s, int q>
auto System<P, B, Workers, Precision>::kept_of_pairs() const
{
    auto now = std::get<std::size_t(s * species_count + q)>(aside_);
    if (have_lists_)
        now.take(lists<s, q>(), std::get<std::size_t(s * species_count + q)>(memory_), species<s>().particles,
                 species<s>().bins, species<q>().particles, species<q>().bins, width<PairV>, backend_, foreign<q>());
    return now.pairs();
}

template <class P, class B, class Workers, class Precision>
ExactSum System<P, B, Workers, Precision>::pair_energy_of(std::size_t cell, auto const& share) const
{
    auto const& p = mobile();
    auto const& lists = this->template lists<0, 0>().of_cell(cell);
    auto const& packed = species<0>().packed;
    using L = typename std::remove_cvref_t<decltype(packed)>::L;
    constexpr auto W = std::size_t(width<PairV>);
    PairT const* const base = packed.data.data();
    const auto u = p.template uniforms<PairV>();
    const std::size_t n = p.size(), first = std::size_t(species<0>().bins.begin(cell));
    const auto most2 = PairT(physics_.interaction.range() * physics_.interaction.range() * (1 + 1e-5));
    ExactSum sum;
    for (std::size_t block = 0; block + 1 < lists.begin.size(); ++block) {
        std::array<std::int32_t, W> at;
        for (std::size_t lane = 0; lane < W; ++lane)
            at[lane] = (std::int32_t(first) + lists.target_of(block * W + lane)) * L::stride;
        const auto ri = gathered<PairV>(base, at.data(), L{});
        for (auto row = std::size_t(lists.begin[block]); row < std::size_t(lists.begin[block + 1]); ++row) {
            const auto rj = gathered<PairV>(base, lists.index.data() + row * W, L{});
            const auto x =
                detail::seen_by<Interaction>(ri, u)[position] - detail::seen_by<Interaction>(rj, u)[position];
            for (unsigned near = bits(x.squaredNorm() < PairV(most2)); near != 0; near &= near - 1) {
                const auto lane = std::size_t(std::countr_zero(near));
                const std::size_t j = std::uint32_t(lists.index[row * W + lane]) / std::uint32_t(L::stride);
                const std::size_t i = std::size_t(at[lane]) / std::size_t(L::stride);
                if (j <= i || j == n) continue;
                const std::size_t of = particle_of(j);
                const double part = share(i, of) + (j < n ? share(j, i) : 0);
                if (part != 0)
                    add_pair_energy(sum, part, cell, block, row, lane, record_of_now(i),
                                    j < n ? record_of_now(j) : double_record_of(j));
            }
        }
    }
    return sum;
}

template <class P, class B, class Workers, class Precision>
double System<P, B, Workers, Precision>::sum_of(void (*fill)(void const*, std::size_t, std::size_t, double*),
                                                void const* what) const
{
    ExactSum total;
    std::mutex lock;
    const std::size_t n = counted<0>();
    backend_.for_each((n + task - 1) / task, [&](std::size_t k) {
        std::array<double, task> addend;
        const std::size_t first = k * task, last = std::min(n, first + task);
        fill(what, first, last, addend.data());
        ExactSum mine;
        for (std::size_t i = 0; i < last - first; ++i) mine.add(addend[i]);
        const std::lock_guard hold(lock);
        total += mine;
    });
    return ranks().all(total, agree::Sum{}).value();
}

template <class P, class B, class Workers, class Precision>
auto System<P, B, Workers, Precision>::record_of_now(std::size_t i) const
{
    auto const& p = mobile();
    if constexpr (!std::same_as<PairT, T>) return double_record(p, i);
    else {
        auto r = packed_record(i);
        for_each(r.fields - decltype(species<0>().packed)::L::fields, [&](auto f) { r[f] = p.at(f, i); });
        return r;
    }
}

template <class P, class B, class Workers, class Precision>
auto System<P, B, Workers, Precision>::double_record_of(std::size_t j) const
{
    auto const& p = mobile();
    auto const& images = species<0>().bins.images();
    const std::size_t n = p.size();
    if constexpr (!alone) {
        const auto foreign = parts_.foreign(0);
        if (j >= std::size_t(foreign.first)) {
            const std::size_t k = foreign.number_of(j), image = j - std::size_t(foreign.first);
            auto r = packed_record(std::size_t(foreign.first) + k);
            if (image != k) r[position] += shift_of(foreign.bins.images().code[image - foreign.places.size], grid_);
            return r;
        }
    }
    auto r = double_record(p, j < n ? j : std::size_t(images.of[j - n - 1]));
    if (j > n) r[position] += shift_of(images.code[j - n - 1], grid_);
    return r;
}

template <class P, class B, class Workers, class Precision>
auto System<P, B, Workers, Precision>::packed_record(std::size_t j) const
{
    auto const& packed = species<0>().packed;
    using L = typename std::remove_cvref_t<decltype(packed)>::L;
    Record<dim, double, Set<(read_for_energy() & ParticlesOf<0>::fields)>> r;
    clear(r); // what is read of the target only is in no record
    for_each(r.fields & L::fields, [&]<class F>(F f) {
        T const* at = packed.data.data() + j * std::size_t(L::stride) + L::template offset<F>;
        if constexpr (F::rank == 0) r[f] = double(*at);
        else
            for (int c = 0; c < components<F, dim>; ++c) r[f][c] = double(at[c]);
    });
    return r;
}

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::each_contact(std::size_t cell, auto const& f) const
{
    static constexpr Mask terms = pair_terms_from(0);
    using Ri = Record<dim, double, Set<M::template fields<read_of_target(terms, 0)>()>>;
    using Rj = Record<dim, double, Set<M::template record<0>()>>;
    using K = Set<kept<0, 0>()>;
    auto const& p = mobile();
    auto const& images = species<0>().bins.images();
    auto const& all = this->template lists<0, 0>();
    auto const& lists = all.of_cell(cell);
    const auto u = p.template uniforms<double>();
    const auto first = std::size_t(species<0>().bins.begin(cell)), n = p.size(), W = std::size_t(width<PairV>);
    for (std::size_t b = 0; b + 1 < lists.begin.size(); ++b)
        for (auto row = std::size_t(lists.begin[b]); row < std::size_t(lists.begin[b + 1]); ++row)
            for (std::size_t lane = 0; lane < W; ++lane) {
                const std::size_t entry = all.number(lists.index[row * W + lane]);
                if (entry == n) continue;
                const std::size_t i = first + std::size_t(lists.target_of(b * W + lane));
                const std::size_t j = entry < n ? entry : std::size_t(images.of[entry - n - 1]);
                Ri ri = record_in_double<Ri>(p, i);
                Rj rj = record_in_double<Rj>(p, j);
                if (entry > n) rj[position] += shift_of(images.code[entry - n - 1], grid_);
                const auto ij = detail::pair_of<Interaction, double>(physics_.interaction, ri, u, rj, u);
                if (!ij.mask) continue;
                typename detail::Kept<dim, double, K>::Seen seen;
                seen.elapsed = due_;
                remembered<K>(seen, cell, b, row, lane);
                Record<dim, double, Set<M::template fields<added(terms)>()>> sums;
                clear(sums);
                detail::apply_all<terms>(terms_, ri, u, rj, u, sums, ij,
                                         std::make_index_sequence<std::size_t(M::terms)>{}, &seen);
                f(i, j, ri[position] - rj[position], ij, p.at(mass, i) * sums[acceleration]);
            }
}

template <class P, class B, class Workers, class Precision>
template <class K>
void System<P, B, Workers, Precision>::remembered(auto& to, std::size_t cell, std::size_t block, std::size_t row,
                                                  std::size_t lane) const
{
    if constexpr (K::size > 0) {
        using L = Layout<dim, K>;
        auto const& memory = std::get<0>(memory_)[cell];
        T const* const values = memory.find(this->template lists<0, 0>().of_cell(cell), block, row, lane);
        const auto value = [&](int k) {
            return values == nullptr ? 0 : double(values[std::size_t(k) * memory.count(memory.set[row])]);
        };
        for_each(K{}, [&]<class F>(F field) {
            if constexpr (F::rank == 0) to[field] = value(L::template offset<F>);
            else
                for (int c = 0; c < components<F, dim>; ++c) to[field][c] = value(L::template offset<F> + c);
        });
    }
}

template <class P, class B, class Workers, class Precision>
void System<P, B, Workers, Precision>::add_pair_energy(ExactSum& sum, double part, std::size_t cell, std::size_t block,
                                                       std::size_t row, std::size_t lane, auto const& ri,
                                                       auto const& rj) const
{
    const auto u = mobile().template uniforms<double>();
    const auto ij = detail::pair_of<Interaction, double>(physics_.interaction, ri, u, rj, u);
    if constexpr (requires { ij.mask; })
        if (!ij.mask) return;
    using Seen = typename detail::Kept<dim, double, Set<kept<0, 0>()>>::Seen;
    Seen seen;
    seen.elapsed = due_;
    remembered<Set<kept<0, 0>()>>(seen, cell, block, row, lane);
    detail::each_in(terms_, [&]<class X>(X const& t) {
        if constexpr (requires { t.energy(ij); }) sum.add(part * t.energy(ij));
        else if constexpr (stores_energy<X>) {
            Record<dim, double, Set<adds<X>()>> sums;
            clear(sums);
            if (due_ != 0) detail::apply(t, ri, u, rj, u, sums, ij, &seen); // it comes along to where positions are
            detail::with_views<X>(ri, u, rj, u, sums, ij, &seen,
                                  [&](auto const& a, auto const& b) { sum.add(part * t.energy(a, b, ij)); });
        }
    });
}

template <class P, class B, class Workers, class Precision>
template <int source>
void System<P, B, Workers, Precision>::partial_sums(auto const& finish)
{
    static constexpr Mask pair_terms = pair_terms_from(source);
    auto& p = mobile();
    constexpr auto sums = M::template fields<added(pair_terms)>();
    Particles<dim, T, Set<sums>, Fields<>> kept;
    kept.resize(p.size());
    for_each(sums, [&](auto f) {
        for (std::size_t c = 0; c < std::size(p.column(f)); ++c) kept.column(f)[c] = p.column(f)[c];
    });
    pack<source, M::planner.record(source)>();
    sweep<0, pair_terms, Mask(1) << source>();
    if constexpr (!alone) parts_.finish();
    for (std::size_t i = 0; i < p.size(); ++i) finish(i, p);
    for_each(sums, [&](auto f) {
        for (std::size_t c = 0; c < std::size(p.column(f)); ++c) p.column(f)[c] = kept.column(f)[c];
    });
}

} // namespace spate
