// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The particles of a scene and what an integrator may ask of them: rates of a set of fields, and to advance
/// fields by their rates. Knows no integrator, no file, no clock.
#pragma once

#include "spate/cells/pair_memory.hpp"
#include "spate/core/precision.hpp"
#include "spate/core/reduction.hpp"
#include "spate/physics/extremes.hpp"
#include "spate/physics/model.hpp"
#include "spate/physics/sweep.hpp"

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>

namespace spate {

template <class P, class B, class Workers, class Precision>
class System {
public:
    using M = Model<P, B>;
    using T = typename Precision::real;
    using V = typename Precision::value;
    static constexpr int dim = M::dim;
    static constexpr int species_count = M::species;
    static constexpr std::size_t task = 2048; ///< particles in a task of a pass; a multiple of every pack

    /// Whether walls reflect what has gone through them.
    static constexpr bool reflects = requires(B const b, Vec<dim, double> x) { b.reflect(x, x, 0.0); };

    /// Whether any term looks at neighbours.
    static constexpr bool any_pairs =
        M::planner.meet(0, 0) || (species_count == 2 && (M::planner.meet(0, 1) || M::planner.meet(1, 0)));

    template <int s>
    using ParticlesOf = Particles<dim, T, Set<M::template stored<s>()>, Set<M::template uniform<s>()>>;
    template <int s>
    struct Species {
        ParticlesOf<s> particles;
        Binning<dim> bins;
        Packed<dim, T, Set<M::template record<s>()>> packed;
        Particles<dim, T, Set<M::template evolving<s>()>, Fields<>> start; ///< of the step, for integrators that save
    };

    /// \param saves  whether the integrator needs the start of the step
    System(P physics, B boundary, Workers backend, Neighbours neighbours, bool saves)
        : physics_(std::move(physics)), boundary_(std::move(boundary)), backend_(backend), neighbours_(neighbours),
          saves_(saves), grid_({}, Edges<dim>(Edge::open), 1, 1, 1), terms_(M::terms_of(physics_, boundary_))
    {
        for_each(P::uniform, [&](auto f) { mobile().value(f) = physics_.uniforms[f]; });
    }

    // ---- the particles
    template <int s>
    auto& species()
    {
        return std::get<s>(species_);
    }
    template <int s>
    auto const& species() const
    {
        return std::get<s>(species_);
    }
    auto& mobile() { return species<0>().particles; }
    auto const& mobile() const { return species<0>().particles; }
    /// f(integral constant s) for each species.
    void each_species(auto&& f) const
    {
        [&]<int... s>(std::integer_sequence<int, s...>) { (f(std::integral_constant<int, s>{}), ...); }
        (std::make_integer_sequence<int, species_count>{});
    }
    [[nodiscard]] std::size_t total() const
    {
        std::size_t n = 0;
        each_species([&](auto s) { n += species<s()>().particles.size(); });
        return n;
    }
    P const& physics() const { return physics_; }
    /// What the physics left open is known now: before the first evaluation.
    void complete(P physics)
    {
        physics_ = std::move(physics);
        terms_ = M::terms_of(physics_, boundary_);
    }
    /// Parameters of the terms may change between steps; the same types, so no plan changes.
    auto& terms() { return terms_; }
    auto const& terms() const { return terms_; }
    B const& boundary() const { return boundary_; }
    B& boundary() { return boundary_; }
    Workers const& backend() const { return backend_; }
    Grid<dim> const& grid() const { return grid_; }
    Neighbours const& neighbours() const { return neighbours_; }
    template <int s, int q>
    auto const& lists() const
    {
        return lists_[std::size_t(s * species_count + q)];
    }

    template <int s>
    Skins<dim> const& skins() const
    {
        return skins_.of(s);
    }

    // ---- neighbours
    /// Wraps positions, sorts, and builds all lists from the positions of now.
    /// \param wide  with the whole skin everywhere
    void rebuild(bool wide = false)
    {
        wrap();
        set_aside();
        each_species([&](auto s) {
            auto& x = species<s()>();
            if (s() != 0 && sorted_markers_ && !M::moves) return;
            x.bins.sort(x.particles, grid_);
            if constexpr (ParticlesOf<s()>::template has<BuildPosition>)
                for (int c = 0; c < dim; ++c)
                    x.particles.column(build_position)[std::size_t(c)] = x.particles.column(position)[std::size_t(c)];
        });
        sorted_markers_ = true;
        choose_skins(wide);
        const double range = physics_.interaction.range(), beyond = neighbours_.skin - neighbours_.closed_in();
        each_species([&](auto s) {
            auto build = [&](auto... sources) {
                const std::array<typename Lists<dim>::template From<T>, sizeof...(sources)> from{sources...};
                Lists<dim>::build(places<s()>(), species<s()>().bins, grid_, width<V>, neighbours_.window, range,
                                  skins_.of(s()), beyond, backend_, from);
            };
            constexpr bool meets_0 = M::planner.meet(s(), 0), meets_1 = species_count == 2 && M::planner.meet(s(), 1);
            if constexpr (meets_0 && meets_1) build(from<s(), 0>(), from<s(), 1>());
            else if constexpr (meets_0) build(from<s(), 0>());
            else if constexpr (meets_1) build(from<s(), 1>());
        });
        each_memory([&](auto s, auto q, auto& aside, auto& memory) {
            aside.give(lists<s(), q()>(), memory, species<s()>().particles, species<s()>().bins,
                       species<q()>().particles, species<q()>().bins, width<V>, backend_);
            aside.clear(); // it would be old news to lists to come
        });
        have_lists_ = true;
        ++rebuilds_;
    }
    /// Takes what terms keep of pairs out of lists that are about to go; to call before particles come, go or change places.
    void set_aside()
    {
        if (!have_lists_ || !lists_know_all()) return;
        each_memory([&](auto s, auto q, auto& aside, auto& memory) {
            aside.take(lists<s(), q()>(), memory, species<s()>().particles, species<s()>().bins,
                       species<q()>().particles, species<q()>().bins, width<V>, backend_);
        });
        have_lists_ = false;
    }
    /// Only mobile particles order[0], order[1], ... remain; what was kept of pairs with the others is forgotten.
    [[gnu::cold]] void keep(std::vector<std::int32_t> const& order)
    {
        set_aside();
        mobile().keep(order);
        std::vector<std::uint32_t> ids = mobile().id();
        std::sort(ids.begin(), ids.end());
        each_memory([&](auto s, auto q, auto& aside, auto&) {
            const auto gone = [&](int species, std::uint32_t id) {
                return species == 0 && !std::binary_search(ids.begin(), ids.end(), id);
            };
            aside.forget([&](std::uint32_t i, std::uint32_t j) { return gone(s(), i) || gone(q(), j); });
        });
        resized();
    }
    /// Whether lists may miss a pair of positions up to x + v t + a t2. Two mobile particles close in by no more than the
    /// diagonal of the box of all displacements, one on a marker by no more than the largest of them.
    [[nodiscard]] bool stale(Extremes const& e, double t, double t2) const
    {
        if (!any_pairs || !have_lists_) return !have_lists_;
        const double range = physics_.interaction.range(), most = closing(e, t, t2);
        if (most <= skins_.least() * range) return false;
        if (!neighbours_.local || !std::isfinite(most)) return true;
        return outrun(t, 2 * t2 * e.acceleration);
    }
    /// The most by which a pair may have closed in at positions up to x + v t + a t2 [m].
    [[nodiscard]] double closing(Extremes const& e, double t, double t2) const
    {
        double diagonal2 = 0;
        for (std::size_t c = 0; c < std::size_t(dim); ++c) {
            if (e.most_velocity[c] < e.least_velocity[c]) continue; // no particles
            const double side = e.most_move[c] - e.least_move[c] + t * (e.most_velocity[c] - e.least_velocity[c]);
            diagonal2 += side * side;
        }
        double apart = std::sqrt(diagonal2);
        if constexpr (!M::markers) apart = std::min(apart, 2 * (e.moved + t * e.speed)); // two that meet head-on
        const double pair = apart + 2 * t2 * e.acceleration;
        double marker = M::markers ? e.moved + t * e.speed + t2 * e.acceleration : 0;
        if constexpr (M::moves) marker += e.wall_moved + t * e.wall_speed;
        return pair > marker ? pair : marker;
    }
    void forget_lists()
    {
        set_aside();
        have_lists_ = false, sorted_markers_ = false, kick_rates_ = false;
    }
    /// Whether the kick rates are those of the present state: an integrator may begin with them.
    [[nodiscard]] bool kick_rates_current() const { return kick_rates_; }
    void keep_kick_rates() { kick_rates_ = true; }
    void forget_kick_rates() { kick_rates_ = false; }
    [[nodiscard]] std::int64_t rebuilds() const { return rebuilds_; }
    /// Directed pairs within range when the lists were built.
    [[nodiscard]] std::int64_t pairs() const
    {
        std::int64_t n = 0;
        for (auto const& l : lists_) n += l.pairs();
        return n;
    }
    [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }
    [[nodiscard]] std::int64_t pairs_evaluated() const { return pairs_evaluated_; }

    // ---- rates
    /// Brings the rates of the asked fields up to date in every species that has them. What terms keep of pairs comes along
    /// to where the positions are; but not between save() and advance_saved(), where a state is only tried.
    template <class... F>
    void rates(Fields<F...> asked)
    {
        evaluate(asked, Carry{due_, !trial_, 1});
    }
    /// The rates with which a step of dt from the saved state is made: what terms keep of pairs comes along to its end.
    template <class... F>
    void rates(Fields<F...> asked, double dt)
    {
        evaluate(asked, Carry{due_, true, due_ > 0 ? dt / due_ : 1});
    }
    /// Brings what terms derive from the state (pressure, ...) up to date.
    void refresh()
    {
        static constexpr auto plan = M::refresh_plan();
        run<plan>();
    }
    /// Runs the terms of a phase that are due at this step; `current` brings the lists up to date before a sweep.
    template <When w>
    void phase(std::int64_t step, auto const& current)
    {
        [&]<std::size_t... k>(std::index_sequence<k...>) { (phase_term<w, int(k)>(step, current), ...); }
        (std::make_index_sequence<std::size_t(M::terms)>{});
    }
    /// Fields that evolve, of one kind: all that an integrator advances.
    template <Kind kind>
    static constexpr auto of_kind()
    {
        constexpr auto first = spate::of_kind<kind>(M::template evolving<0>());
        if constexpr (species_count == 2) return first | spate::of_kind<kind>(M::template evolving<1>());
        else return first;
    }
    static constexpr auto drifting = of_kind<Kind::drift>();
    static constexpr auto kicked = of_kind<Kind::kick>();
    static constexpr auto all = drifting | kicked;
    /// Drifting fields whose rate needs an evaluation (density), and those whose rate is at hand (position).
    static constexpr auto driven = []<class... F>(Fields<F...>) {
        auto one = []<class G>(G) {
            constexpr Mask made = M::template made<0>;
            constexpr bool by_terms = [] {
                Mask m = 0;
                if constexpr (Set<M::template stored<0>()>::template contains<G>)
                    m |= M::mask(rate_in<G>(M::template stored<0>())) & made;
                if constexpr (species_count == 2)
                    if constexpr (Set<M::template stored<1>()>::template contains<G>)
                        m |= M::mask(rate_in<G>(M::template stored<1>())) & M::template made<1>;
                return m != 0;
            }();
            return detail::kept<by_terms>(G{});
        };
        return (Fields<>{} | ... | one(F{}));
    }(drifting);
    static constexpr auto free = drifting - driven;

    // ---- advancing
    /// y += dt * rate for each of the fields that evolves in a species; of two sets the second sees the first advanced.
    template <class... F>
    void advance(Fields<F...> set, double dt)
    {
        advance_from<false>(dt, set);
        if (Fields<F...>::template contains<Position>) due_ += dt, moved_ += dt;
    }
    template <class... F, class... G>
    void advance(Fields<F...> first, Fields<G...> then, double dt)
    {
        advance_from<false>(dt, first, then);
        if (Fields<F..., G...>::template contains<Position>) due_ += dt, moved_ += dt;
    }
    /// Remembers all evolving fields as the start of the step.
    void save()
    {
        trial_ = true, moved_ = 0;
        each_species([&](auto s) {
            auto& x = species<s()>();
            for_each(M::template evolving<s()>(), [&](auto f) {
                for (std::size_t c = 0; c < std::size(x.particles.column(f)); ++c)
                    x.start.column(f)[c] = x.particles.column(f)[c];
            });
        });
    }
    /// y = y at the start of the step + dt * rate.
    template <class... F, class... G>
    void advance_saved(Fields<F...> first, Fields<G...> then, double dt)
    {
        advance_from<true>(dt, first, then);
        due_ += dt - moved_, trial_ = false;
    }
    /// The time by which positions are ahead of what terms keep of pairs [s].
    [[nodiscard]] double memory_age() const { return due_; }

    // ---- measures
    /// \tparam with_acceleration  whether anyone asks for max |a|
    template <bool with_acceleration = true>
    [[nodiscard]] Extremes extremes() const
    {
        Extremes e;
        std::mutex lock;
        auto const& p = mobile();
        const std::size_t n = p.size();
        backend_.for_each((n + task - 1) / task, [&](std::size_t k) {
            const Extremes mine =
                extremes_of<V, with_acceleration>(p, k * task, std::min(n, (k + 1) * task), M::template evolving<0>());
            const std::lock_guard hold(lock);
            e |= mine;
        });
        if constexpr (M::moves) e |= wall_extremes();
        return e;
    }
    /// Of markers that move: how far since the lists were built, and how fast.
    [[nodiscard]] Extremes wall_extremes() const
    {
        Extremes e;
        std::mutex lock;
        auto const& w = species<1>().particles;
        backend_.for_each((w.size() + task - 1) / task, [&](std::size_t k) {
            double moved2 = 0, speed2 = 0;
            for (std::size_t i = k * task, end = std::min(w.size(), (k + 1) * task); i < end; ++i) {
                moved2 = std::max(moved2, (w.at(position, i) - w.at(build_position, i)).squaredNorm());
                speed2 = std::max(speed2, w.at(velocity, i).squaredNorm());
            }
            const std::lock_guard hold(lock);
            e.wall_moved = std::max(e.wall_moved, std::sqrt(moved2));
            e.wall_speed = std::max(e.wall_speed, std::sqrt(speed2));
        });
        return e;
    }
    /// The exact sum of f(i) over the mobile particles, whoever adds.
    double sum(auto const& f) const
    {
        return sum_of([&](std::size_t first, std::size_t last, double* to) {
            for (std::size_t i = first; i < last; ++i) *to++ = f(i);
        });
    }
    /// Half the sum over directed pairs of what the terms of contact store, energy(ij) or energy(i, j, ij) [J]; lists must be
    /// current.
    [[nodiscard]] double pair_energy() const
    {
        return pair_energy([](std::size_t, std::size_t) { return 0.5; });
    }
    /// The same with the share of the directed pair of particles i, j that counts; an image counts as its particle.
    [[nodiscard]] double pair_energy([[maybe_unused]] auto const& share) const
    {
        ExactSum total;
        if constexpr (M::planner.meet(0, 0) && has_pair_energy) {
            std::mutex lock;
            backend_.for_each(species<0>().bins.cells(), [&](std::size_t cell) {
                const ExactSum mine = pair_energy_of(cell, share);
                const std::lock_guard hold(lock);
                total += mine;
            });
        }
        return total.value();
    }
    /// The sum of what visit(sum, i, j, x, ij, force) makes of each directed contact i <- j of mobile particles: x = x_i - x_j
    /// [m], ij what terms see, force on i [N]. Lists must be current. Cells come in any order, so a Sum must not depend on it.
    template <class Sum>
    [[nodiscard]] Sum over_contacts(auto const& visit) const
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
    /// The sum of what the mobile particles store in walls that they touch, wall_energy(i) of a term [J].
    [[nodiscard]] double wall_energy() const
    {
        return wall_energy([](std::size_t) { return true; });
    }
    /// The same of the particles that count.
    [[nodiscard]] double wall_energy([[maybe_unused]] auto const& counts) const
    {
        constexpr bool any = []<class... X>(std::tuple<X...> const*) {
            return (false || ... || requires { X::pushes; });
        }(static_cast<typename M::Terms const*>(nullptr));
        if constexpr (any)
            return sum([&](std::size_t i) {
                double e = 0;
                if (!counts(i)) return e;
                detail::each_in(terms_, [&](auto const& t) {
                    if constexpr (requires { t.wall_energy(AsDouble{mobile(), i}); })
                        e += t.wall_energy(AsDouble{mobile(), i});
                });
                return e;
            });
        else return 0;
    }
    /// What terms of a boundary without markers do to the particles: f(i, sums) with all that they add to particle i.
    void wall_sums(auto const& f) const
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
    /// Sends back what has gone through elastic walls. Returns whether any has.
    bool reflect() requires(reflects)
    {
        auto& p = mobile();
        std::atomic<bool> any = false, lost = false;
        stretches<0>([&](std::size_t first, std::size_t last) {
            constexpr auto W = std::size_t(width<V>);
            for (std::size_t k = first; k < last; k += W) {
                if (!boundary_.any_beyond(p.template load_at<V>(position, k), radius_at<V>(k))) continue;
                for (std::size_t i = k; i < std::min(last, k + W); ++i) {
                    Vec<dim, double> x = p.at(position, i), v = p.at(velocity, i);
                    const auto bounce = boundary_.reflect(x, v, radius_at<double>(i));
                    if (bounce == B::Bounce::none) continue;
                    p.put(position, i, x), p.put(velocity, i, v);
                    any = true;
                    if (bounce == B::Bounce::too_many) lost = true;
                }
            }
        });
        lost_ = lost_ || lost;
        return any;
    }
    /// Whether a particle bounced too often within one step.
    [[nodiscard]] bool lost() const { return lost_; }
    /// Bytes of all that is kept for the particles: columns, records, lists, bins.
    [[nodiscard, gnu::cold]] std::size_t bytes() const
    {
        std::size_t b = 0;
        each_species([&](auto s) {
            auto const& x = species<s()>();
            b += x.particles.bytes() + x.start.bytes() + x.bins.bytes() + x.packed.data.capacity() * sizeof(T);
        });
        for (auto const& l : lists_) b += l.bytes();
        for (auto const& of_species : memory_)
            for (auto const& of_cell : of_species) b += of_cell.capacity() * sizeof(T);
        std::apply([&](auto const&... aside) { ((b += aside.bytes()), ...); }, aside_);
        b += skins_.bytes();
        return b;
    }
    /// Sum modulo 2^64 over all particles of a hash of (species, id, bits of the evolving fields), and over all pairs of
    /// (ids, bits of what terms keep of them).
    [[nodiscard, gnu::cold]] std::uint64_t state_hash() const
    {
        std::uint64_t total = 0;
        each_species([&](auto s) {
            auto const& p = species<s()>().particles;
            for (std::size_t i = 0; i < p.size(); ++i) {
                std::uint64_t h = mix(mix(std::uint64_t(s()) + 1) + p.id()[i]);
                for_each(M::template evolving<s()>(), [&](auto f) {
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
                        std::uint64_t h =
                            mix(mix(mix(std::uint64_t(s() * species_count + q()) + 17) + pair.i) + pair.j);
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
        return total;
    }
    /// What terms keep of the directed pairs s <- q, in the order of their ids; pairs of which it is zero are not there.
    template <int s, int q>
    [[nodiscard, gnu::cold]] auto kept_of_pairs() const
    {
        auto now = std::get<std::size_t(s * species_count + q)>(aside_);
        if (have_lists_)
            now.take(lists<s, q>(), memory_[std::size_t(s * species_count + q)], species<s>().particles,
                     species<s>().bins, species<q>().particles, species<q>().bins, width<V>, backend_);
        return now.pairs();
    }
    /// Makes room for the particles that have been added since.
    [[gnu::cold]] void resized()
    {
        each_species([&](auto s) {
            auto& x = species<s()>();
            if (saves_) x.start.resize(x.particles.size());
            x.particles.pad();
        });
        forget_lists();
    }
    /// The grid of bins and cells; before the first evaluation.
    void use(Grid<dim> grid)
    {
        grid_ = std::move(grid);
        forget_lists();
    }
    /// The sums of chosen terms on the mobile particles over one source only, without touching the rates: the force of a
    /// wall. `finish(i, sums)` is called for each particle with the sums as double.
    template <int source>
    void partial_sums(auto const& finish)
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
        for (std::size_t i = 0; i < p.size(); ++i) finish(i, p);
        for_each(sums, [&](auto f) {
            for (std::size_t c = 0; c < std::size(p.column(f)); ++c) p.column(f)[c] = kept.column(f)[c];
        });
    }

private:
    using Interaction = typename M::Interaction;
    /// Whether there are as many particles as when the lists were built.
    [[nodiscard]] bool lists_know_all() const
    {
        bool all = true;
        each_species([&](auto s) {
            auto const& x = species<s()>();
            const std::size_t cells = x.bins.cells();
            all = all && x.particles.size() == (cells > 0 ? std::size_t(x.bins.end(cells - 1)) : 0);
        });
        return all;
    }
    static constexpr bool has_pair_energy = []<class... X>(std::tuple<X...> const*) {
        return (false || ... || stores_energy<X>);
    }(static_cast<typename M::Terms const*>(nullptr));
    /// Of the targets in a cell: what is out of range is passed over.
    [[nodiscard]] ExactSum pair_energy_of(std::size_t cell, auto const& share) const
    {
        auto const& p = mobile();
        auto const& bins = species<0>().bins;
        auto const& images = bins.images();
        auto const& lists = this->template lists<0, 0>().of_cell(cell);
        constexpr auto W = std::size_t(width<V>);
        constexpr auto stride = std::uint32_t(Layout<dim, Set<M::template record<0>()>>::stride);
        const std::size_t n = p.size(), first = std::size_t(bins.begin(cell));
        const double range2 = physics_.interaction.range() * physics_.interaction.range();
        ExactSum sum;
        for (std::size_t block = 0; block + 1 < lists.begin.size(); ++block)
            for (auto row = std::size_t(lists.begin[block]); row < std::size_t(lists.begin[block + 1]); ++row)
                for (std::size_t lane = 0; lane < W; ++lane) {
                    const std::size_t j = std::uint32_t(lists.index[row * W + lane]) / stride;
                    if (j == n) continue;
                    const std::size_t i = first + std::size_t(lists.target[block * W + lane]);
                    const std::size_t of = j < n ? j : std::size_t(images.of[j - n - 1]);
                    Vec<dim, double> x = p.at(position, i) - p.at(position, of);
                    if (j > n) x -= shift_of(images.code[j - n - 1], grid_);
                    if (x.squaredNorm() > range2 * (1 + 1e-6)) continue;
                    const double part = share(i, of);
                    if (part > 0)
                        add_pair_energy(sum, part, cell, row, lane, i, of, j > n ? images.code[j - n - 1] : 0);
                }
        return sum;
    }
    /// The exact sum of what `fill` writes, a stretch of particles at a time; compiled once for all that is summed.
    double sum_of(std::function<void(std::size_t, std::size_t, double*)> const& fill) const
    {
        ExactSum total;
        std::mutex lock;
        const std::size_t n = mobile().size();
        backend_.for_each((n + task - 1) / task, [&](std::size_t k) {
            std::array<double, task> addend;
            const std::size_t first = k * task, last = std::min(n, first + task);
            fill(first, last, addend.data());
            ExactSum mine;
            for (std::size_t i = 0; i < last - first; ++i) mine.add(addend[i]);
            const std::lock_guard hold(lock);
            total += mine;
        });
        return total.value();
    }
    /// Terms of an evaluation that act on the mobile particles from a source.
    static constexpr Mask pair_terms_from(int source)
    {
        Mask m = 0;
        for (int t = 0; t < M::terms; ++t)
            if (M::planner.on(t, 0) && M::planner.from(t, 0, source) &&
                M::planner.term[std::size_t(t)].when == When::evaluation)
                m |= Mask(1) << t;
        return m;
    }
    /// f(i, j, x, ij, force) for the contacts of one cell's particles, by the terms in double; memory is shown, not kept.
    void each_contact(std::size_t cell, auto const& f) const
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
        const auto first = std::size_t(species<0>().bins.begin(cell)), n = p.size(), W = std::size_t(width<V>);
        for (std::size_t b = 0; b + 1 < lists.begin.size(); ++b)
            for (auto row = std::size_t(lists.begin[b]); row < std::size_t(lists.begin[b + 1]); ++row)
                for (std::size_t lane = 0; lane < W; ++lane) {
                    const std::size_t entry = all.number(lists.index[row * W + lane]);
                    if (entry == n) continue;
                    const std::size_t i = first + std::size_t(lists.target[b * W + lane]);
                    const std::size_t j = entry < n ? entry : std::size_t(images.of[entry - n - 1]);
                    Ri ri = record_in_double<Ri>(p, i);
                    Rj rj = record_in_double<Rj>(p, j);
                    if (entry > n) rj[position] += shift_of(images.code[entry - n - 1], grid_);
                    const auto ij = detail::pair_of<Interaction, double>(physics_.interaction, ri, u, rj, u);
                    if (!ij.mask) continue;
                    typename detail::Kept<dim, double, K>::Seen seen;
                    seen.elapsed = due_;
                    remembered<K>(seen, memory_[0], cell, row, lane);
                    Record<dim, double, Set<M::template fields<added(terms)>()>> sums;
                    clear(sums);
                    detail::apply_all<terms>(terms_, ri, u, rj, u, sums, ij,
                                             std::make_index_sequence<std::size_t(M::terms)>{}, &seen);
                    f(i, j, ri[position] - rj[position], ij, p.at(mass, i) * sums[acceleration]);
                }
    }
    /// What is kept of the pair at a place of the lists.
    template <class K>
    static void remembered(auto& to, auto const& memory, std::size_t cell, std::size_t row, std::size_t lane)
    {
        if constexpr (K::size > 0) {
            using L = Layout<dim, K>;
            constexpr int W = width<V>;
            const auto value = [&](int k) {
                return double(memory[cell][PairMemory<T, L::count>::place(row, k, W) + lane]);
            };
            for_each(K{}, [&]<class F>(F field) {
                if constexpr (F::rank == 0) to[field] = value(L::template offset<F>);
                else
                    for (int c = 0; c < components<F, dim>; ++c) to[field][c] = value(L::template offset<F> + c);
            });
        }
    }
    template <class R>
    static R record_in_double(auto const& p, std::size_t i)
    {
        R r;
        for_each(R::fields, [&](auto f) { r[f] = p.at(f, i); });
        return r;
    }
    /// What the terms that store energy read of a pair, or keep.
    static constexpr auto read_for_energy()
    {
        return []<class... X>(std::tuple<X...> const*) {
            auto one = []<class Y>(Y const*) {
                if constexpr (stores_energy<Y>) return reads_i<Y>() | reads_j<Y>();
                else return Fields<>{};
            };
            return (Interaction::reads | ... | one(static_cast<X const*>(nullptr)));
        }(static_cast<typename M::Terms const*>(nullptr));
    }
    /// Tells terms that keep something of contacts with walls what a sweep does with it.
    static void carry_at_walls(typename M::Terms& terms, Carry const& carry)
    {
        auto one = [&](auto& t) {
            if constexpr (requires { t.carry(0.0, true, 1.0); }) t.carry(carry.elapsed, carry.keep, carry.reach);
        };
        std::apply([&](auto&... t) { (one(t), ...); }, terms);
    }
    template <class X>
    [[nodiscard]] X radius_at(std::size_t i) const
    {
        if constexpr (!ParticlesOf<0>::template has<Radius>) return X(0);
        else if constexpr (std::same_as<X, double>) return mobile().at(radius, i);
        else return mobile().template load_at<X>(radius, i);
    }
    /// A particle as a term that computes in double reads it.
    struct AsDouble {
        ParticlesOf<0> const& particles;
        std::size_t i;
        auto operator[](auto f) const { return particles.at(f, i); }
    };
    /// The same, with sums of its own to add to.
    template <class Sums>
    struct Pushing {
        static constexpr bool only_shown = true;
        AsDouble particle;
        Sums& sums;
        template <Field F>
        decltype(auto) operator[](F f) const
        {
            if constexpr (Sums::template has<F>) return (sums[f]);
            else return particle[f];
        }
    };
    static auto double_record(auto const& p, std::size_t i)
    {
        Record<dim, double, Set<(read_for_energy() & ParticlesOf<0>::fields)>> r;
        for_each(r.fields, [&](auto f) { r[f] = p.at(f, i); });
        return r;
    }
    void add_pair_energy(ExactSum& sum, double part, std::size_t cell, std::size_t row, std::size_t lane, std::size_t i,
                         std::size_t j, int code) const
    {
        auto const& p = mobile();
        const auto u = p.template uniforms<double>();
        auto ri = double_record(p, i), rj = double_record(p, j);
        if (code != 0) rj[position] += shift_of(code, grid_);
        const auto ij = detail::pair_of<Interaction, double>(physics_.interaction, ri, u, rj, u);
        if constexpr (requires { ij.mask; })
            if (!ij.mask) return;
        using Seen = typename detail::Kept<dim, double, Set<kept<0, 0>()>>::Seen;
        Seen seen;
        seen.elapsed = due_;
        remembered<Set<kept<0, 0>()>>(seen, memory_[0], cell, row, lane);
        detail::each_in(terms_, [&]<class X>(X const& t) {
            if constexpr (requires { t.energy(ij); }) sum.add(part * t.energy(ij));
            else if constexpr (stores_energy<X>) {
                Record<dim, double, Set<adds<X>()>> sums;
                clear(sums);
                detail::apply(t, ri, u, rj, u, sums, ij, &seen); // what it keeps comes along to where the positions are
                detail::with_views<X>(ri, u, rj, u, sums, ij, &seen,
                                      [&](auto const& a, auto const& b) { sum.add(part * t.energy(a, b, ij)); });
            }
        });
    }
    static std::uint64_t mix(std::uint64_t z) // splitmix64 (Steele, Lea & Flood 2014)
    {
        z += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    static constexpr Mask added(Mask terms)
    {
        Mask m = 0;
        for (int t = 0; t < M::terms; ++t)
            if (((terms >> t) & 1) != 0) m |= M::planner.term[std::size_t(t)].adds;
        return m;
    }
    static constexpr Mask written(Mask terms)
    {
        Mask m = 0;
        for (int t = 0; t < M::terms; ++t)
            if (((terms >> t) & 1) != 0) m |= M::planner.term[std::size_t(t)].writes;
        return m;
    }
    static constexpr Mask read_of_target(Mask terms, int s)
    {
        Mask m = M::planner.interaction;
        for (int t = 0; t < M::terms; ++t)
            if (((terms >> t) & 1) != 0) m |= M::planner.term[std::size_t(t)].reads_i;
        return m & ~M::planner.species[std::size_t(s)].uniform;
    }
    static constexpr Mask reading(Mask terms, int s, int q)
    {
        Mask m = 0;
        for (int t = 0; t < M::terms; ++t)
            if (((terms >> t) & 1) != 0 && M::planner.from(t, s, q)) m |= Mask(1) << t;
        return m;
    }

    template <When w, int k>
    void phase_term(std::int64_t step, auto const& current)
    {
        if constexpr (M::planner.term[std::size_t(k)].when == w) {
            static constexpr auto plan = M::template phase_plan<w, k>();
            auto const& term = std::get<std::size_t(k)>(terms_);
            if constexpr (requires { term.every; })
                if (step % term.every != 0) return;
            if constexpr (plan.sweeps() > 0) current();
            run<plan>();
            constexpr auto& facts = M::planner.term[std::size_t(k)];
            if constexpr (((facts.writes | facts.adds) & M::mask(M::template evolving<0>())) != 0) kick_rates_ = false;
        }
    }
    /// Whether a plan runs terms that keep something of pairs.
    static constexpr bool keeps_something(auto const& plan)
    {
        Mask terms = 0;
        for (int k = 0; k < plan.count; ++k)
            if (plan.stage[std::size_t(k)].action == Action::sweep) terms |= plan.stage[std::size_t(k)].terms;
        return [&]<class... X, std::size_t... t>(std::tuple<X...> const*, std::index_sequence<t...>) {
            return (false || ... || (((terms >> t) & 1) != 0 && decltype(keeps<X>())::size > 0));
        }(static_cast<typename M::Terms const*>(nullptr), std::make_index_sequence<std::size_t(M::terms)>{});
    }
    template <class... F>
    void evaluate(Fields<F...>, [[maybe_unused]] Carry carry)
    {
        static constexpr auto plan = M::template rates_plan<Fields<F...>>();
        if constexpr (keeps_something(plan)) {
            carry_ = carry;
            run<plan>();
            carry_.reset();
            if (carry.keep) due_ = carry.elapsed * (1 - carry.reach); // exact: reach is 1, or 2 at half a step
        }
        else run<plan>();
        if constexpr (plan.sweeps() > 0) ++evaluations_, pairs_evaluated_ += pairs();
    }
    template <auto const& plan>
    void run()
    {
        static_assert(plan.complete,
                      "spate: terms wait for each other's fields; let one of them write a field of its own");
        [&]<std::size_t... k>(std::index_sequence<k...>) { (stage<plan.stage[k]>(), ...); }
        (std::make_index_sequence<std::size_t(plan.count)>{});
    }
    template <Stage st>
    void stage()
    {
        if constexpr (st.action == Action::pass) pass<st.species, st.terms, st.fields>();
        else if constexpr (st.action == Action::pack) pack<st.species, st.fields>();
        else sweep<st.species, st.terms, ~Mask(0)>();
    }
    /// f(first, last) over stretches of the padded columns of a species.
    template <int s>
    void stretches(auto const& f) const
    {
        const std::size_t n = species<s>().particles.size();
        backend_.for_each((n + task - 1) / task, [&](std::size_t k) {
            const std::size_t end = std::min(n, (k + 1) * task);
            f(k * task, end);
        });
    }
    template <int s, Mask terms, Mask cleared>
    void pass()
    {
        stretches<s>([&](std::size_t first, std::size_t last) __attribute__((flatten)) {
            auto& p = species<s>().particles;
            for (std::size_t i = first; i < last; i += std::size_t(width<V>)) {
                for_each(M::template fields<cleared>(), [&](auto f) {
                    using X = Value<decltype(f), dim, V>;
                    X zero;
                    if constexpr (decltype(f)::rank == 0) zero = V(0);
                    else
                        for (int c = 0; c < components<decltype(f), dim>; ++c) zero[c] = V(0);
                    p.template store_at<V>(f, i, zero);
                });
                detail_pass<terms>(p, i, std::make_index_sequence<std::size_t(M::terms)>{});
            }
        });
    }
    template <Mask terms, std::size_t... t>
    [[gnu::always_inline]] void detail_pass(auto& p, std::size_t i, std::index_sequence<t...>) const
    {
        auto one = [&]<std::size_t k>(std::integral_constant<std::size_t, k>) __attribute__((always_inline))
        {
            if constexpr (((terms >> k) & 1) != 0) {
                auto const& term = std::get<k>(terms_);
                using Q = std::remove_cvref_t<decltype(p)>;
                ParticleView<V, std::remove_cvref_t<decltype(term)>, Q> view{p, i};
                term(view);
            }
        };
        (one(std::integral_constant<std::size_t, t>{}), ...);
    }
    /// Not inlined: compiled once, not for each component of each field.
    template <std::size_t stride>
    [[gnu::noinline]] static void pack_column(T const* from, T* to, std::size_t first, std::size_t last)
    {
        for (std::size_t i = first; i < last; ++i) to[i * stride] = from[i];
    }
    /// Copies fields of a species into its records; then the sentinel and the images.
    template <int s, Mask copied>
    void pack()
    {
        auto& x = species<s>();
        using L = typename std::remove_cvref_t<decltype(x.packed)>::L;
        auto const& images = x.bins.images();
        const std::size_t n = x.particles.size(), records = n + 1 + images.of.size();
        constexpr auto stride = std::size_t(L::stride);
        if (x.packed.data.size() != records * stride) x.packed.data.assign(records * stride, T(1));
        T* const data = x.packed.data.data();
        stretches<s>([&](std::size_t first, std::size_t end) {
            constexpr std::size_t in_cache = 256; // records that stay in the first-level cache over all their fields
            for (std::size_t last; first < end; first = last) {
                last = std::min(end, first + in_cache);
                for_each(M::template fields<copied>(), [&]<class F>(F f) {
                    for (int c = 0; c < components<F, dim>; ++c) {
                        T const* from = x.particles.column(f)[std::size_t(c)].data();
                        pack_column<stride>(from, data + std::size_t(L::template offset<F> + c), first, last);
                    }
                });
            }
        });
        constexpr auto at = std::size_t(L::template offset<Position>);
        for (std::size_t f = 0; f < stride && n > 0; ++f) data[n * stride + f] = data[f];
        for (std::size_t c = 0; c < std::size_t(dim); ++c)
            data[n * stride + at + c] = x.packed.far; // beyond every range
        if (images.of.empty()) return;
        backend_.for_each((images.of.size() + task - 1) / task, [&](std::size_t k) {
            for (std::size_t g = k * task, end = std::min(images.of.size(), (k + 1) * task); g < end; ++g) {
                T* const to = data + (n + 1 + g) * stride;
                std::copy_n(data + std::size_t(images.of[g]) * stride, stride, to);
                const Vec<dim, double> shift = shift_of(images.code[g], grid_);
                for (int c = 0; c < dim; ++c) to[at + std::size_t(c)] += T(shift[c]);
            }
        });
    }
    template <int s, Mask terms, Mask allowed>
    void sweep()
    {
        if constexpr (s == 0 && (allowed & ~Mask(3)) != 0) carry_at_walls(terms_, carry_.value_or(Carry{due_}));
        constexpr Mask from_0 = (allowed & 1) != 0 ? reading(terms, s, 0) : 0;
        constexpr Mask from_1 = species_count == 2 && (allowed & 2) != 0 ? reading(terms, s, 1) : 0;
        auto run_with = [&](auto const&... source) {
            auto& x = species<s>();
            using Sums = decltype(M::template fields<added(terms) | written(terms)>());
            using Target = decltype(M::template fields<read_of_target(terms, s)>());
            constexpr Mask itself = (allowed >> s) & 1 ? terms : Mask(0);
            backend_.for_each(x.bins.cells(), [&](std::size_t cell) {
                sweep_cell<V, itself, Sums, Target>(physics_.interaction, terms_, x.particles, x.bins, cell, source...);
            });
        };
        if constexpr (from_0 != 0 && from_1 != 0) run_with(source<s, 0, from_0>(), source<s, 1, from_1>());
        else if constexpr (from_0 != 0) run_with(source<s, 0, from_0>());
        else if constexpr (from_1 != 0) run_with(source<s, 1, from_1>());
        else run_with();
    }
    /// What the terms of s <- q keep of a pair.
    template <int s, int q>
    static constexpr auto kept()
    {
        return []<class... X, std::size_t... t>(std::tuple<X...> const*, std::index_sequence<t...>) {
            return (Fields<>{} | ... | kept_of < X, M::planner.on(int(t), s) && M::planner.from(int(t), s, q) > ());
        }(static_cast<typename M::Terms const*>(nullptr), std::make_index_sequence<std::size_t(M::terms)>{});
    }
    template <class X, bool meets>
    static constexpr auto kept_of()
    {
        if constexpr (meets) return keeps<X>();
        else return Fields<>{};
    }
    template <int s, int q>
    static constexpr int kept_values = Layout<dim, Set<kept<s, q>()>>::count;
    /// f(s, q, memory set aside, memory by cell) for each pair of species of which something is kept.
    void each_memory(auto const& f)
    {
        each_species([&](auto s) {
            each_species([&](auto q) {
                constexpr int values = kept_values<s(), q()>;
                if constexpr (values > 0) {
                    auto& aside = std::get<std::size_t(s() * species_count + q())>(aside_);
                    f(s, q, aside, memory_[std::size_t(s() * species_count + q())]);
                }
            });
        });
    }
    template <int s, int q>
    auto from()
    {
        auto const& x = species<q>();
        return typename Lists<dim>::template From<T>{lists_[std::size_t(s * species_count + q)], places<q>(), x.bins,
                                                     Layout<dim, Set<M::template record<q>()>>::stride, s == q};
    }
    template <int s>
    auto places() const
    {
        return Places<dim, T>::of(species<s>().particles);
    }
    template <int s, int q, Mask terms>
    auto source()
    {
        auto const& x = species<q>();
        auto& memory = memory_[std::size_t(s * species_count + q)];
        return Source<terms, Set<kept<s, q>()>, ParticlesOf<q>, std::remove_cvref_t<decltype(x.packed)>>{
            x.particles, x.packed, lists<s, q>(), s == q, &memory, carry_.value_or(Carry{due_})};
    }
    /// The sets one after the other, a stretch of particles at a time: it is in the cache for the second set.
    template <bool from_start, class... Sets>
    void advance_from(double dt, Sets...)
    {
        each_species([&](auto s) {
            if constexpr (decltype((Fields<>{} | ... | (M::template evolving<s()>() & Sets{})))::size > 0)
                stretches<s()>([&](std::size_t first, std::size_t last) {
                    auto one = [&](auto set) {
                        for_each(M::template evolving<s()>() & set, [&](auto f) {
                            for (int c = 0; c < components<decltype(f), dim>; ++c)
                                advance_field<from_start, s()>(species<s()>(), f, std::size_t(c), first, last, T(dt));
                        });
                    };
                    (one(Sets{}), ...);
                });
        });
    }
    template <bool from_start, int s, Field F>
    static void advance_field(auto& x, F f, std::size_t c, std::size_t first, std::size_t last, T dt)
    {
        constexpr auto rate = []<class G>(Fields<G>) { return G{}; }(rate_in<F>(M::template stored<s>()));
        T* const y = x.particles.column(f)[c].data();
        T const* const r = x.particles.column(rate)[c].data();
        if constexpr (from_start) advance_column(y, x.start.column(f)[c].data(), r, first, last, dt);
        else advance_column(y, y, r, first, last, dt);
    }
    /// Not inlined: compiled once, not for each component of each field.
    [[gnu::noinline]] static void advance_column(T* y, T const* y0, T const* rate, std::size_t first, std::size_t last,
                                                 T dt)
    {
        for (std::size_t i = first; i < last; i += std::size_t(width<V>))
            store(y + i, V(load<V>(y0 + i) + V(dt) * load<V>(rate + i)));
    }
    /// Where velocities differ lists reach far; see Skins.
    void choose_skins(bool wide)
    {
        skins_.use(neighbours_.closed_in());
        if (!neighbours_.local || !any_pairs) return;
        if constexpr (M::markers) skins_.look_around(grid_, species<0>().bins, &species<1>().bins);
        else skins_.look_around(grid_, species<0>().bins, nullptr);
        if (wide) return;
        skins_.use(neighbours_.closed_in(), spreads([](auto& box, auto const& p, std::size_t i) {
                       for (int c = 0; c < dim; ++c) box.add(c, double(p.column(velocity)[std::size_t(c)][i]));
                   }));
    }
    /// Whether a pair of any patch may have closed in by more than its skin at positions up to x + v t and `more` [m].
    [[nodiscard]] bool outrun(double t, double more) const
    {
        const auto spread = spreads([t](auto& box, auto const& p, std::size_t i) {
            for (int c = 0; c < dim; ++c) {
                const auto k = std::size_t(c);
                const double moved = double(p.column(position)[k][i]) - double(p.column(build_position)[k][i]);
                box.add(c, moved), box.add(c, moved + t * double(p.column(velocity)[k][i]));
                if constexpr (std::remove_cvref_t<decltype(p)>::template has<TransportVelocity>)
                    box.add(c, moved + t * double(p.column(transport_velocity)[k][i]));
            }
        });
        return skins_.outrun(spread, physics_.interaction.range(), more, backend_);
    }
    /// The boxes of vectors; add(box, particles, i) adds those of a particle.
    [[nodiscard]] Spreads<dim> spreads(auto const& add) const
    {
        Spread<dim> markers;
        if constexpr (M::moves) {
            auto const& p = species<1>().particles;
            for (std::size_t i = 0; i < p.size(); ++i) add(markers, p, i);
        }
        else
            for (int c = 0; c < dim; ++c) markers.add(c, 0); // they stand still
        return skins_.spreads(
            grid_, species<0>().bins, markers, [&](auto& box, std::size_t i) { add(box, mobile(), i); }, backend_);
    }
    void wrap()
    {
        if (!grid_.any_periodic()) return;
        wrap(mobile());
        if constexpr (M::moves) wrap(species<1>().particles);
    }
    void wrap(auto& particles)
    {
        auto& x = particles.column(position);
        for (int c = 0; c < dim; ++c)
            if (grid_.periodic(c))
                for (std::size_t i = 0; i < particles.size(); ++i) {
                    auto& value = x[std::size_t(c)][i];
                    value = T(grid_.wrapped(c, double(value)));
                    if (!(double(value) < grid_.box().hi[c])) value = T(grid_.box().lo[c]); // rounded up in T
                }
    }
    P physics_;
    B boundary_;
    Workers backend_;
    Neighbours neighbours_;
    bool saves_;
    Grid<dim> grid_;
    typename M::Terms terms_;
    template <class S>
    struct All;
    template <int... s>
    struct All<std::integer_sequence<int, s...>> {
        using type = std::tuple<Species<s>...>;
    };
    typename All<std::make_integer_sequence<int, species_count>>::type species_;
    std::array<Lists<dim>, std::size_t(species_count* species_count)> lists_;
    template <class S>
    struct AllMemory;
    template <int... k>
    struct AllMemory<std::integer_sequence<int, k...>> {
        using type = std::tuple<PairMemory<T, kept_values<k / species_count, k % species_count>>...>;
    };
    typename AllMemory<std::make_integer_sequence<int, species_count * species_count>>::type aside_;
    std::array<std::vector<Array<T>>, std::size_t(species_count* species_count)> memory_; ///< of pairs, by cell
    LocalSkins<dim, species_count> skins_;
    bool have_lists_ = false, sorted_markers_ = false, kick_rates_ = false, lost_ = false;
    std::optional<Carry> carry_; ///< of sweeps for rates; to others what is kept of pairs is only shown
    double due_ = 0, moved_ = 0; ///< time since what is kept of pairs was kept, since the step was saved [s]
    bool trial_ = false;         ///< between save() and advance_saved()
    std::int64_t rebuilds_ = 0, evaluations_ = 0, pairs_evaluated_ = 0;
};

} // namespace spate
