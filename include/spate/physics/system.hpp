// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The particles of a scene and what an integrator may ask of them: rates of a set of fields, and to advance
/// fields by their rates. Knows no integrator, no file, no clock.
#pragma once

#include "spate/cells/pair_memory.hpp"
#include "spate/core/precision.hpp"
#include "spate/core/ranks.hpp"
#include "spate/core/reduction.hpp"
#include "spate/core/together.hpp"
#include "spate/physics/extremes.hpp"
#include "spate/physics/model.hpp"
#include "spate/physics/sweep.hpp"

#include <atomic>
#include <bit>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>

namespace spate {

/// One rank has all: nothing to know.
struct Undivided {
    explicit Undivided(Alone) {}
    static constexpr Alone ranks() { return {}; }
};
// Of scenes that are cut over ranks: physics/migration.hpp.
template <int Dim, class T, class S, int Species, class R>
class Decomposition;
template <int Dim>
class Shares;

/// What it tells of its state is defined in physics/measures.hpp.
template <class P, class B, class Workers, class Precision>
class System {
public:
    using M = Model<P, B>;
    using T = typename Precision::real;
    using V = typename Precision::value;
    using PairV = pair_value<Precision>;
    using PairT = scalar_t<PairV>;
    static constexpr bool mixed = !std::same_as<PairT, T>;
    static constexpr int dim = M::dim;
    static constexpr int species_count = M::species;
    static constexpr std::size_t task = 2048; ///< particles in a task of a pass; a multiple of every pack
    static constexpr std::size_t stretch =
        512; ///< of those, how many stay in the first-level cache over several passes

    /// Whether walls reflect what has gone through them.
    static constexpr bool reflects = requires(B const b, Vec<dim, double> x) { b.reflect(x, x, 0.0); };

    /// Whether any term looks at neighbours.
    static constexpr bool any_pairs =
        M::planner.meet(0, 0) || (species_count == 2 && (M::planner.meet(0, 1) || M::planner.meet(1, 0)));

    /// A record in pairs that compute in less than the state has holds positions in two parts.
    static constexpr auto in_pairs(auto set)
    {
        if constexpr (mixed) return set | Fields{position_tail};
        else return set;
    }
    template <int s>
    using ParticlesOf = Particles<dim, T, Set<M::template stored<s>()>, Set<M::template uniform<s>()>>;
    template <int s>
    struct Species {
        ParticlesOf<s> particles;
        Binning<dim> bins;
        Packed<dim, PairT, Set<in_pairs(M::template record<s>())>> packed;
        Particles<dim, T, Set<M::template evolving<s>()>, Fields<>> start; ///< of the step, for integrators that save
    };

    /// Those who share the scene: the backend's ranks, or nobody.
    using Party = decltype(ranks_of(std::declval<Workers const&>()));
    static constexpr bool alone = Party::alone;
    using Parts = std::conditional_t<alone, Undivided, Decomposition<dim, T, PairT, species_count, Party>>;

    /// \param saves  whether anyone needs the start of a step: an integrator, or the watch
    [[gnu::cold]] System(P physics, B boundary, Workers backend, Neighbours neighbours, bool saves)
        : physics_(std::move(physics)), boundary_(std::move(boundary)), backend_(backend), neighbours_(neighbours),
          saves_(saves), grid_({}, Edges<dim>(Edge::open), 1, 1, 1), terms_(M::terms_of(physics_, boundary_)),
          parts_(parts_of(backend_))
    {
        for_each(P::uniform, [&](auto f) { mobile().value(f) = physics_.uniforms[f]; });
    }
    System(System const&) = default;
    System(System&&) noexcept = default;
    System& operator=(System const&) = default;
    System& operator=(System&&) noexcept = default;
    [[gnu::cold]] ~System() = default; // small, and quick to compile

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
    auto& mobile()
    {
        if (puts_off_) finish();
        return species<0>().particles;
    }
    auto const& mobile() const { return species<0>().particles; }
    /// f(integral constant s) for each species.
    void each_species(auto&& f) const
    {
        [&]<int... s>(std::integer_sequence<int, s...>) { (f(std::integral_constant<int, s>{}), ...); }
        (std::make_integer_sequence<int, species_count>{});
    }
    /// Particles on all ranks.
    [[nodiscard]] std::size_t total() const
    {
        std::size_t n = 0;
        each_species([&](auto s) { n += counted<s()>(); });
        return ranks().all(n, agree::Sum{});
    }
    template <int s>
    [[nodiscard]] std::size_t total_of() const
    {
        return ranks().all(counted<s>(), agree::Sum{});
    }
    /// Of the particles here those that this rank counts where all ranks count: the first so many.
    template <int s>
    [[nodiscard]] std::size_t counted() const
    {
        const std::size_t n = species<s>().particles.size();
        if constexpr (alone) return n;
        else return parts_.counted(s, n);
    }
    /// The ranks that share the scene.
    [[nodiscard]] decltype(auto) ranks() const { return parts_.ranks(); }
    /// How it is cut.
    Parts const& parts() const { return parts_; }

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
        if constexpr (!alone) {
            each_species([&](auto s) { remember_places<s()>(); });
            if (have_lists_ && balance_due()) cut_by_cost();
        }
        set_aside(); // sorting may stop: the lists would be of another order
        if constexpr (!alone) go_home(true);
        together(ranks(), [&] {
            each_species([&](auto s) {
                auto& x = species<s()>();
                if (s() != 0 && sorted_markers_ && !M::moves) return;
                x.bins.sort(x.particles, grid_, InParts{backend_});
                remember_places<s()>();
            });
        });
        sorted_markers_ = true;
        if constexpr (!alone) meet_others();
        choose_skins(wide);
        together(ranks(), [&] { build_lists(); });
        ++rebuilds_;
    }
    /// Gives cells to other ranks by new cuts; lists, their skins, and when they are built anew stay as they are.
    void redistribute(Shares<dim> shares);
    /// Takes what terms keep of pairs out of lists that are about to go; to call before particles come, go or change places.
    void set_aside()
    {
        if (!have_lists_ || !lists_know_all()) return;
        each_memory([&](auto s, auto q, auto& aside, auto& memory) {
            aside.take(lists<s(), q()>(), memory, species<s()>().particles, species<s()>().bins,
                       species<q()>().particles, species<q()>().bins, width<PairV>, backend_, foreign<q()>());
        });
        have_lists_ = false;
    }
    /// Only mobile particles order[0], order[1], ... remain; what was kept of pairs with the others is forgotten.
    [[gnu::cold]] void keep(std::vector<std::int32_t> const& order)
    {
        set_aside();
        std::vector<char> stays(mobile().size(), 0);
        for (const auto i : order) stays[std::size_t(i)] = 1;
        std::vector<std::uint32_t> ids; // of those that leave, on any rank
        for (std::size_t i = 0; i < stays.size(); ++i)
            if (stays[i] == 0) ids.push_back(mobile().id()[i]);
        ids = shared(ranks(), std::move(ids));
        std::sort(ids.begin(), ids.end());
        mobile().keep(order);
        if constexpr (!alone) parts_.own(0, order.size());
        each_memory([&](auto s, auto q, auto& aside, auto&) {
            const auto gone = [&](int species, std::uint32_t id) {
                return species == 0 && std::binary_search(ids.begin(), ids.end(), id);
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
        if (!(e.moved <= wrap_after_)) return true; // together, perhaps, but far from where it is wrapped to
        if (most <= skins_.least() * range) return false;
        if (!neighbours_.local || !std::isfinite(most)) return true;
        double push = e.acceleration;
        if constexpr (M::floats) push = std::max(push, boundary_.body_acceleration());
        return ranks().all(outrun(t, 2 * t2 * push), agree::Or{});
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
        if constexpr (M::floats) marker += t2 * boundary_.body_acceleration();
        return pair > marker ? pair : marker;
    }
    /// Beyond this distance from the origin places are rounded by a hundredth of the length that forces vary over [m].
    [[nodiscard]] double farthest() const
    {
        return 0.02 * physics_.interaction.length() / double(std::numeric_limits<T>::epsilon());
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
    /// Directed pairs within range when the lists were built, on all ranks.
    [[nodiscard]] std::int64_t pairs() const { return ranks().all(pairs_here(), agree::Sum{}); }
    [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }
    [[nodiscard]] std::int64_t pairs_evaluated() const { return ranks().all(pairs_evaluated_, agree::Sum{}); }

    // ---- going on from a checkpoint
    /// f(name, number) for what has been counted, and for what is known of the lists.
    template <class Self>
    static void numbers_of(Self& self, auto const& f)
    {
        f("have_lists", self.have_lists_), f("kick_rates_current", self.kick_rates_);
        f("rebuilds", self.rebuilds_), f("evaluations", self.evaluations_);
        f("pairs_evaluated", self.pairs_evaluated_), f("memory_age", self.due_);
        if constexpr (M::floats) B::numbers_of(self.boundary_, f);
    }
    /// The place of the patch that holds x.
    static Index<dim> place(Vec<dim, double> const& x, Grid<dim> const& grid) { return Skins<dim>::place(x, grid); }
    /// f(s, place of a patch, its skin) for each patch that holds particles, where skins differ by place.
    void each_skin(auto const& f) const
    {
        each_species([&](auto s) {
            auto const& skins = skins_.of(s());
            auto const& bins = species<s()>().bins;
            if (skins.uniform()) return;
            for (std::size_t p = 0; p < skins.patches(); ++p)
                if (!Skins<dim>::particles_of(bins, p, grid_).empty())
                    f(s, Skins<dim>::place(bins, p, grid_), skins.of(p));
        });
    }
    /// On many ranks f(s, place of a patch, its share of what its cell has cost since lists were built), for each that holds
    /// particles.
    void each_cost(auto const& f) const;
    /// f(s, q, pairs) with what is kept of the pairs s <- q, sorted by ids.
    void each_kept(auto const& f) const
    {
        each_species([&](auto s) {
            each_species([&](auto q) {
                constexpr int values = kept_values<s(), q()>;
                if constexpr (values > 0) f(s, q, this->template kept_of_pairs<s(), q()>());
            });
        });
    }
    /// What ranks have counted apart rank 0 goes on counting for all.
    void count_on_one()
    {
        if constexpr (!alone) {
            const auto all = pairs_evaluated();
            pairs_evaluated_ = ranks().rank() == 0 ? all : 0;
        }
    }
    /// Particles of these ids take the place of all that are here. \param next  the id of the next new one
    template <int s>
    void put_ids(std::vector<std::uint32_t> const& ids, std::uint32_t next)
    {
        auto& p = species<s>().particles;
        p.resize(ids.size());
        p.set_ids(ids, next);
        if constexpr (!alone) parts_.own(s, ids.size());
    }
    using OfParticles = std::array<std::vector<double>, std::size_t(species_count)>;
    /// On many ranks: the lists that a checkpoint was written with, of a part of the particles on each; in migration.hpp.
    /// \param skin  of each particle here, where skins differ by place
    /// \param cost  what is known of patches by their place, on one rank: shares are cut by it
    void restore_lists(bool local, OfParticles skin, std::vector<std::pair<Index<dim>, std::int64_t>> const& cost,
                       auto const& pairs_of);
    /// Builds the lists that a checkpoint was written with: from where particles were when those were built, with the
    /// skins of then. Lists built from the positions of now would have their neighbours in another order.
    /// \param local  skins differ by place: skin_of(s, place)
    /// \param pairs_of  (s, q, type of a pair) -> what was kept of the pairs, sorted by ids
    [[gnu::cold]] void restore_lists(bool local, auto const& skin_of, auto const& pairs_of)
    {
        make_room();
        each_memory([&]<class Aside>(auto s, auto q, Aside& aside, auto&) {
            aside.put(pairs_of(s, q, std::type_identity<typename Aside::Pair>{}));
        });
        if (!have_lists_) return;
        each_species([&](auto s) {
            auto& x = species<s()>();
            swap_with_built(x.particles);
            x.bins.sort(x.particles, grid_, InParts{backend_});
        });
        sorted_markers_ = true;
        choose_skins(true);
        if (local) {
            std::array<std::vector<double>, std::size_t(species_count)> of_patch;
            each_species([&](auto s) {
                auto const& bins = species<s()>().bins;
                auto& skin = of_patch[std::size_t(s())];
                skin.assign(skins_.of(s()).patches(), neighbours_.closed_in());
                for (std::size_t p = 0; p < skin.size(); ++p)
                    if (!Skins<dim>::particles_of(bins, p, grid_).empty())
                        skin[p] = skin_of(s, Skins<dim>::place(bins, p, grid_));
            });
            skins_.use(neighbours_.closed_in(), std::move(of_patch), ranks());
        }
        build_lists();
        each_species([&](auto s) { swap_with_built(species<s()>().particles); });
    }

    // ---- passes
    /// Passes over particles, which look at nothing beyond a particle, wait from now on until something does, or somebody
    /// asks for mobile(): then each stretch of particles goes through all of them while it is in the cache.
    void put_off() { puts_off_ = true; }
    /// Nothing waits any longer.
    void finish()
    {
        puts_off_ = false;
        run_waiting();
    }

    // ---- rates
    /// Brings the rates of the asked fields up to date in every species that has them. What terms keep of pairs comes along
    /// to where the positions are; but not between save() and advance_saved(), where a state is only tried.
    template <class... F>
    void rates(Fields<F...> asked)
    {
        evaluate(asked, Carry{due_, !trial_, 1});
        if constexpr (M::floats && Fields<F...>::template contains<Velocity>) push_bodies();
    }
    /// The rates with which a step of dt from the saved state is made: what terms keep of pairs comes along to its end.
    template <class... F>
    void rates(Fields<F...> asked, double dt)
    {
        evaluate(asked, Carry{due_, true, due_ > 0 ? dt / due_ : 1});
        if constexpr (M::floats && Fields<F...>::template contains<Velocity>) push_bodies();
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
    /// Remembers all evolving fields as the start of the step; until advance_saved() a state is only tried.
    void save()
    {
        trial_ = true, moved_ = 0;
        keep();
    }
    /// Remembers all evolving fields, for restore().
    void keep()
    {
        if constexpr (M::floats) boundary_.bodies().keep();
        each_species([&](auto s) {
            if constexpr (decltype(M::template evolving<s()>())::size > 0)
                pass_over<s()>([s](System& me, std::size_t first, std::size_t last) {
                    auto& x = me.template species<s()>();
                    for_each(M::template evolving<s()>(), [&](auto f) {
                        for (std::size_t c = 0; c < std::size(x.particles.column(f)); ++c)
                            copy_column(x.particles.column(f)[c].data(), x.start.column(f)[c].data(), first, last);
                    });
                });
        });
    }
    /// The evolving fields as they were when save() or keep() was called, what derives from them zero; false if the particles
    /// are others now.
    [[gnu::cold]] bool restore()
    {
        bool same = true;
        each_species([&](auto s) {
            auto& x = species<s()>();
            same = same && x.start.size() == x.particles.size();
            if (!same) return;
            for_each(M::template evolving<s()>(), [&](auto f) {
                for (std::size_t c = 0; c < std::size(x.particles.column(f)); ++c)
                    x.particles.column(f)[c] = x.start.column(f)[c];
            });
            for_each(x.particles.fields, [&](auto f) { // of the state of now
                if constexpr (decltype(f)::derived)
                    for (auto& column : x.particles.column(f)) std::fill(column.begin(), column.end(), T(0));
            });
        });
        if constexpr (M::floats) boundary_.bodies().restore(), boundary_.turn_bodies();
        kick_rates_ = false;
        return same;
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
        LaneExtremes<V, dim> seen;
        stretches<0>([&](std::size_t first, std::size_t last) { see<with_acceleration>(seen, first, last); });
        return extremes_in(seen);
    }
    /// The same as a pass; seen() tells them once it has run.
    template <bool with_acceleration = true>
    void look()
    {
        seen_ = {};
        pass_over<0>([](System& me, std::size_t first, std::size_t last) {
            me.template see<with_acceleration>(me.seen_, first, last);
        });
    }
    [[nodiscard]] Extremes seen() const { return extremes_in(seen_); }
    /// Of markers that move: how far since the lists were built, and how fast.
    [[nodiscard]] Extremes wall_extremes() const { return ranks().all(wall_extremes_here(), agree::Join{}); }
    /// The exact sum of f(i) over the mobile particles, whoever adds.
    double sum(auto const& f) const
    {
        using F = std::remove_cvref_t<decltype(f)>;
        return sum_of(
            [](void const* what, std::size_t first, std::size_t last, double* to) {
                for (std::size_t i = first; i < last; ++i) *to++ = (*static_cast<F const*>(what))(i);
            },
            std::addressof(f));
    }
    /// Half the sum over directed pairs of what the terms of contact store, energy(ij) or energy(i, j, ij) [J]; lists must be
    /// current.
    [[nodiscard]] double pair_energy() const
    {
        return pair_energy([](std::size_t, std::size_t) { return 0.5; });
    }
    /// The same with the share of the directed pair of particles i, j that counts; an image counts as its particle.
    [[nodiscard]] double pair_energy([[maybe_unused]] auto const& share) const;
    /// Which of the mobile particles are meant, of others' too: theirs from n + 1. Lists must be current.
    [[nodiscard]] std::vector<char> with_foreign(std::vector<char> is) const;
    /// What a mobile particle stores in walls that it touches, wall_energy(i) of a term [J].
    [[nodiscard]] double wall_energy_of(std::size_t i) const
    {
        double e = 0;
        detail::each_in(terms_, [&](auto const& t) {
            if constexpr (requires { t.wall_energy(AsDouble{mobile(), i}); }) e += t.wall_energy(AsDouble{mobile(), i});
        });
        return e;
    }
    /// The sum of that.
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
        if constexpr (any) return sum([&](std::size_t i) { return counts(i) ? wall_energy_of(i) : 0.0; });
        else return 0;
    }
    /// What terms of a boundary without markers do to the particles: f(i, sums) with all that they add to particle i.
    void wall_sums(auto const& f) const;
    /// Sends back what has gone through elastic walls.
    void reflect() requires(reflects)
    {
        bounced_ = false;
        pass_over<0>([](System& me, std::size_t first, std::size_t last) { me.reflect(first, last); });
    }
    /// Whether the last reflect() has sent any back.
    [[nodiscard]] bool bounced() const { return ranks().all(bounced_, agree::Or{}); }
    /// Whether a particle bounced too often within one step.
    [[nodiscard]] bool lost() const { return ranks().all(lost_, agree::Or{}); }
    /// The sum of what visit(sum, i, j, x, ij, force) makes of each directed contact i <- j of mobile particles: x = x_i - x_j
    /// [m], ij what terms see, force on i [N]. Lists must be current. Cells come in any order, so a Sum must not depend on it.
    template <class Sum>
    [[nodiscard]] Sum over_contacts(auto const& visit) const;
    /// The mobile particle behind a record other than the sentinel; others' particles are numbered from n + 1.
    std::size_t particle_of(std::size_t j) const
    {
        auto const& of = species<0>().bins.images().of;
        const std::size_t n = mobile().size();
        if constexpr (!alone)
            if (j >= std::size_t(parts_.foreign(0).first)) return n + 1 + parts_.foreign(0).number_of(j);
        return j < n ? j : j - n - 1 < of.size() ? std::size_t(of[j - n - 1]) : n;
    }
    /// What a look at pairs asks of a mobile particle.
    struct Near {
        Vec<dim, double> x; ///< [m]
        double radius;      ///< 0 if it has none  [m]
        std::uint32_t id;
    };
    /// Others' particles as they are now, by number; all ranks call it.
    [[nodiscard]] std::vector<Near> others() const;
    /// Who is behind a record other than the sentinel, at the place of the image that meets. \param others  as above
    [[nodiscard, gnu::cold]] Near near(std::size_t j, [[maybe_unused]] std::vector<Near> const& others) const;
    /// Bytes of all that is kept for the particles: columns, records, lists, bins.
    [[nodiscard, gnu::cold]] std::size_t bytes() const;
    /// Sum modulo 2^64 over all particles of a hash of (species, id, bits of the evolving fields and of what is kept at walls),
    /// and over all pairs of (ids, bits of what terms keep of them).
    [[nodiscard, gnu::cold]] std::uint64_t state_hash() const;
    /// What terms keep of the directed pairs s <- q, in the order of their ids; pairs of which it is zero are not there.
    template <int s, int q>
    [[nodiscard, gnu::cold]] auto kept_of_pairs() const;
    /// Makes room for the particles that have been added since.
    [[gnu::cold]] void resized()
    {
        make_room();
        forget_lists();
    }
    /// Whether the k-th of new particles starts here: until shares are known, blocks go from rank to rank.
    [[nodiscard]] bool starts_here([[maybe_unused]] std::size_t k) const
    {
        if constexpr (alone) return true;
        else return k / 256 % std::size_t(ranks().count()) == std::size_t(ranks().rank());
    }
    /// Room for those of `total` new particles that start here; all others are started by other ranks.
    template <int s>
    void adopt(std::vector<std::uint32_t> numbers, std::size_t total)
    {
        auto& p = species<s>().particles;
        for (auto& k : numbers) k += p.next_id();
        p.append(numbers);
        p.skip_ids(total);
        parts_.own(s, p.size());
    }
    /// Whether all particles here are this rank's own.
    template <int s>
    [[nodiscard]] bool owns_all() const
    {
        return parts_.owned(s) == species<s>().particles.size();
    }
    /// Of what all ranks have been given alike each keeps its own. \param cut  by new cuts, of like numbers of particles
    void distribute([[maybe_unused]] bool cut);
    /// Tests move cells at every so many steps: cuts by a cost that has nothing to do with work.
    void wander([[maybe_unused]] std::int64_t step);
    /// The grid of bins and cells; before the first evaluation.
    void use(Grid<dim> grid)
    {
        grid_ = std::move(grid);
        wrap_after_ = std::numeric_limits<double>::infinity();
        for (int c = 0; c < dim; ++c)
            if (grid_.periodic(c)) wrap_after_ = std::min(wrap_after_, grid_.period(c));
        forget_lists();
    }
    /// The sums of chosen terms on the mobile particles over one source only, without touching the rates: the force of a
    /// wall. `finish(i, sums)` is called for each particle with the sums as double.
    template <int source>
    [[gnu::cold]] void partial_sums(auto const& finish);

private:
    using Pass = std::function<void(System&, std::size_t first, std::size_t last)>;
    /// A pass over the padded columns of a species, a stretch at a time. It touches nothing but its particles.
    template <int s>
    void pass_over(Pass pass)
    {
        waiting_[std::size_t(s)].push_back(std::move(pass));
        if (!puts_off_) run_waiting<s>();
    }
    /// The waiting passes over the particles that a sweep has just summed, but for packs that it shares with other cells.
    template <int s>
    void pass_over_cell(std::size_t cell)
    {
        constexpr auto W = std::size_t(width<V>);
        auto const& x = species<s>();
        const std::size_t n = x.particles.size();
        std::size_t first = (std::size_t(x.bins.begin(cell)) + W - 1) / W * W;
        const auto end = std::size_t(x.bins.end(cell)), last = end == n ? n : end / W * W;
        for (; first < last; first += stretch)
            for (auto const& pass : waiting_[std::size_t(s)]) pass(*this, first, std::min(last, first + stretch));
    }
    /// Those packs, once; then nothing waits.
    template <int s>
    void pass_over_shared_packs()
    {
        constexpr auto W = std::size_t(width<V>);
        auto const& x = species<s>();
        auto& waiting = waiting_[std::size_t(s)];
        std::size_t done = 0;
        for (std::size_t cell = 1; cell < x.bins.cells() && !waiting.empty(); ++cell) {
            const auto border = std::size_t(x.bins.begin(cell)), first = border / W * W;
            if (border == first || first < done) continue;
            done = std::min(x.particles.size(), first + W);
            for (auto const& pass : waiting) pass(*this, first, done);
        }
        waiting.clear();
    }
    /// A sweep after which nothing but passes came, with these.
    void run_last_sweep()
    {
        if (last_sweep_ == nullptr) return;
        auto const sweep = last_sweep_;
        last_sweep_ = nullptr;
        sweep(*this);
    }
    template <int s>
    void run_waiting()
    {
        run_last_sweep();
        auto& waiting = waiting_[std::size_t(s)];
        if (waiting.empty()) return;
        stretches<s>([&](std::size_t first, std::size_t last) {
            for (auto const& pass : waiting) pass(*this, first, last);
        });
        waiting.clear();
    }
    void run_waiting()
    {
        run_last_sweep();
        each_species([&](auto s) { run_waiting<s()>(); });
    }
    /// f(first, last) over stretches of the padded columns of a species.
    template <int s>
    void stretches(auto const& f) const
    {
        const std::size_t n = species<s>().particles.size();
        backend_.for_each((n + task - 1) / task, [&](std::size_t k) {
            const std::size_t end = std::min(n, (k + 1) * task);
            for (std::size_t first = k * task; first < end; first += stretch) f(first, std::min(end, first + stretch));
        });
    }
    template <bool with_acceleration>
    void see(LaneExtremes<V, dim>& seen, std::size_t first, std::size_t last) const
    {
        LaneExtremes<V, dim> mine;
        mine.template add<with_acceleration>(species<0>().particles, first, last, M::template evolving<0>());
        const std::lock_guard hold(seeing);
        seen |= mine;
    }
    [[nodiscard]] Extremes extremes_in(LaneExtremes<V, dim> const& seen) const
    {
        Extremes e;
        if (!species<0>().particles.empty()) e = seen.over_lanes();
        if constexpr (M::moves) e |= wall_extremes_here();
        return ranks().all(e, agree::Join{});
    }
    void reflect(std::size_t first, std::size_t last) requires(reflects)
    {
        auto& p = species<0>().particles;
        constexpr auto W = std::size_t(width<V>);
        const auto mirrors = boundary_.template mirrors<V>();
        for (std::size_t k = first; k < last; k += W) {
            if (!mirrors.any_beyond(p.template load_at<V>(position, k), radius_at<V>(k))) continue;
            for (std::size_t i = k; i < std::min(last, k + W); ++i) {
                Vec<dim, double> x = p.at(position, i), v = p.at(velocity, i);
                const auto bounce = boundary_.reflect(x, v, radius_at<double>(i));
                if (bounce == B::Bounce::none) continue;
                p.put(position, i, x), p.put(velocity, i, v);
                std::atomic_ref(bounced_).store(true);
                if (bounce == B::Bounce::too_many) std::atomic_ref(lost_).store(true);
            }
        }
    }
    [[nodiscard]] std::int64_t pairs_here() const
    {
        std::int64_t n = 0;
        for (auto const& l : lists_) n += l.pairs();
        return n;
    }
    [[nodiscard]] Extremes wall_extremes_here() const
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
    /// Sums the forces on bodies that float: their rates.
    void push_bodies()
    {
        run_waiting<1>();
        auto const& p = species<1>().particles;
        using Sums = typename std::remove_cvref_t<decltype(boundary_.bodies())>::Sums;
        Sums total{};
        std::mutex lock;
        const std::size_t n = counted<1>();
        backend_.for_each((n + task - 1) / task, [&](std::size_t k) {
            Sums mine{};
            boundary_.add_push(mine, p, k * task, std::min(n, (k + 1) * task));
            const std::lock_guard hold(lock);
            for (std::size_t c = 0; c < mine.size(); ++c) total[c] += mine[c];
        });
        ranks().each(total, agree::Sum{});
        boundary_.bodies().push(total, gravity_of(physics_));
    }
    /// Bodies by their rates, and their markers with them.
    template <bool from_start, class... Sets>
    void advance_bodies(double dt, Sets... sets)
    {
        run_waiting<1>();
        (boundary_.bodies().template advance<from_start>(sets, dt), ...);
        boundary_.turn_bodies();
        auto nearest = [this](Vec<dim, double> x) {
            for (int c = 0; c < dim; ++c)
                if (grid_.periodic(c)) x[c] -= grid_.period(c) * std::round(x[c] / grid_.period(c));
            return x;
        };
        stretches<1>([&](std::size_t first, std::size_t last) {
            boundary_.carry(species<1>().particles, first, last, nearest);
        });
    }
    [[gnu::cold]] [[nodiscard]] std::uint64_t hash_of_bodies() const
    {
        std::uint64_t h = 0;
        auto copy = boundary_;
        B::numbers_of(copy,
                      [&](std::string const&, double value) { h = mix(h ^ std::bit_cast<std::uint64_t>(value)); });
        return h;
    }
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
    /// Of the targets in a cell, from records of now. Both copies of a pair store the same: one is counted, but for images and
    /// others' particles.
    [[nodiscard]] ExactSum pair_energy_of(std::size_t cell, auto const& share) const;
    /// The exact sum of what fill(what, ...) writes, a stretch of particles at a time; compiled once for all that is summed.
    [[gnu::noinline]] double sum_of(void (*fill)(void const*, std::size_t, std::size_t, double*),
                                    void const* what) const;
    /// Of particle i; from its record, which is current and one place, where that is as exact as its columns.
    auto record_of_now(std::size_t i) const;
    /// Of the mobile particle behind a record other than the sentinel, as it is now.
    auto double_record_of(std::size_t j) const;
    auto packed_record(std::size_t j) const;
    /// Tells terms that keep something of contacts with walls what a sweep does with it.
    static void carry_at_walls(typename M::Terms& terms, Carry const& carry)
    {
        auto one = [&](auto& t) {
            if constexpr (requires { t.carry(0.0, true, 1.0); }) t.carry(carry.elapsed, carry.keep, carry.reach);
        };
        detail::each_in(terms, one);
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
    void each_contact(std::size_t cell, auto const& f) const;
    /// What is kept of the pair at a place of the lists of the mobile particles; zero where it does not touch.
    template <class K>
    void remembered(auto& to, std::size_t cell, std::size_t block, std::size_t row, std::size_t lane) const;
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
    static auto double_record(auto const& p, std::size_t i)
    {
        Record<dim, double, Set<(read_for_energy() & ParticlesOf<0>::fields)>> r;
        for_each(r.fields, [&](auto f) { r[f] = p.at(f, i); });
        return r;
    }
    /// \param part  of the energy of a pair that counts
    void add_pair_energy(ExactSum& sum, double part, std::size_t cell, std::size_t block, std::size_t row,
                         std::size_t lane, auto const& ri, auto const& rj) const;
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
    /// A sweep that ends a plan may wait for the passes after it.
    static constexpr bool may_wait(auto const& plan, int k) { return alone && k + 1 == plan.count; }
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
        if constexpr (plan.sweeps() > 0) ++evaluations_, pairs_evaluated_ += pairs_here();
    }
    template <auto const& plan>
    void run()
    {
        static_assert(plan.complete,
                      "spate: terms wait for each other's fields; let one of them write a field of its own");
        [&]<std::size_t... k>(std::index_sequence<k...>)
        {
            (stage<plan.stage[k], ahead_in(plan, int(k)), is_rest(plan, int(k)), made_by_cells(plan, int(k)),
                   may_wait(plan, int(k))>(),
             ...);
        }
        (std::make_index_sequence<std::size_t(plan.count)>{});
        if constexpr (!alone) parts_.finish(); // what no cell here has waited for
    }
    /// Ranks that wait for others in a sweep of the markers run ahead: cells of the next sweep of the mobile particles that
    /// see no marker of others, if between the two nothing but markers changes. What they see of our own is made cell by
    /// cell: each task of the sweep goes on with the passes and the packing in between.
    static constexpr int next_sweep(auto const& plan, int k)
    {
        if (alone || plan.stage[std::size_t(k)].action != Action::sweep || plan.stage[std::size_t(k)].species != 1)
            return -1;
        for (int n = k + 1; n < plan.count; ++n) {
            auto const& st = plan.stage[std::size_t(n)];
            if (st.species == 0) return st.action == Action::sweep ? n : -1;
            if (st.action == Action::sweep) return -1;
        }
        return -1;
    }
    struct Ahead {
        std::array<Stage, 4> between{};
        int count = 0;
        Stage sweep{}; ///< none of whose terms is none
    };
    static constexpr Ahead ahead_in(auto const& plan, int k)
    {
        Ahead a;
        const int n = next_sweep(plan, k);
        if (n < 0 || n - k - 1 > int(a.between.size())) return a;
        a.sweep = plan.stage[std::size_t(n)];
        for (int m = k + 1; m < n; ++m) a.between[std::size_t(a.count++)] = plan.stage[std::size_t(m)];
        return a;
    }
    static constexpr bool is_rest(auto const& plan, int k)
    {
        for (int n = 0; n < k; ++n)
            if (ahead_in(plan, n).sweep.terms != 0 && next_sweep(plan, n) == k) return true;
        return false;
    }
    static constexpr bool made_by_cells(auto const& plan, int k)
    {
        for (int n = 0; n < k; ++n)
            if (ahead_in(plan, n).sweep.terms != 0 && k < next_sweep(plan, n)) return true;
        return false;
    }
    /// \tparam rest  some cells have run ahead    \tparam made  the tasks of the sweep before have done it
    template <Stage st, Ahead ahead, bool rest, bool made, bool may_wait>
    void stage()
    {
        if constexpr (st.action == Action::pack) pack<st.species, st.fields, made>();
        else if constexpr (st.action == Action::pass) {
            if constexpr (!made) pass<st.species, st.terms, st.fields>();
        }
        else {
            run_waiting();
            if constexpr (may_wait)
                if (puts_off_) {
                    last_carry_ = carry_.value_or(Carry{due_});
                    last_sweep_ = [](System& me) {
                        const auto carry = std::exchange(me.carry_, me.last_carry_);
                        me.template sweep<st.species, st.terms>();
                        me.carry_ = carry;
                        me.template pass_over_shared_packs<st.species>();
                    };
                    return;
                }
            sweep<st.species, st.terms, ~Mask(0), ahead, rest>();
        }
    }
    /// The same for the particles of one cell.
    template <Stage st>
    void stage_of(std::size_t cell)
    {
        auto const& bins = species<st.species>().bins;
        const auto first = std::size_t(bins.begin(cell)), last = std::size_t(bins.end(cell));
        if constexpr (st.action == Action::pack) {
            pack_range<st.species, st.fields>(first, last);
            auto const& images = bins.images();
            if (!images.of.empty())
                pack_images<st.species>(std::size_t(images.first[first]), std::size_t(images.first[last]));
        }
        else { // whole vectors belong to one cell; tasks of two must not write to the same
            constexpr auto W = std::size_t(width<V>);
            std::size_t i = first;
            for (; i < last && i % W != 0; ++i) pass_at<T, st.species, st.terms, st.fields>(i);
            for (; i + W <= last; i += W) pass_at<V, st.species, st.terms, st.fields>(i);
            for (; i < last; ++i) pass_at<T, st.species, st.terms, st.fields>(i);
        }
    }
    template <int s, Mask terms, Mask cleared>
    void pass()
    {
        pass_over<s>([](System & me, std::size_t first, std::size_t last) __attribute__((flatten)) {
            for (std::size_t i = first; i < last; i += std::size_t(width<V>))
                me.template pass_at<V, s, terms, cleared>(i);
        });
    }
    /// \tparam W  of one particle or of as many as a pack holds
    template <class W, int s, Mask terms, Mask cleared>
    [[gnu::always_inline]] void pass_at(std::size_t i)
    {
        auto& p = species<s>().particles;
        for_each(M::template fields<cleared>(), [&](auto f) {
            using X = Value<decltype(f), dim, W>;
            X zero;
            if constexpr (decltype(f)::rank == 0) zero = W(0);
            else
                for (int c = 0; c < components<decltype(f), dim>; ++c) zero[c] = W(0);
            p.template store_at<W>(f, i, zero);
        });
        detail_pass<W, terms>(p, i, std::make_index_sequence<std::size_t(M::terms)>{});
    }
    template <class W, Mask terms, std::size_t... t>
    [[gnu::always_inline]] void detail_pass(auto& p, std::size_t i, std::index_sequence<t...>) const
    {
        auto one = [&]<std::size_t k>(std::integral_constant<std::size_t, k>) __attribute__((always_inline))
        {
            if constexpr (((terms >> k) & 1) != 0) {
                auto const& term = std::get<k>(terms_);
                using Q = std::remove_cvref_t<decltype(p)>;
                ParticleView<W, std::remove_cvref_t<decltype(term)>, Q> view{p, i};
                term(view);
            }
        };
        (one(std::integral_constant<std::size_t, t>{}), ...);
    }
    /// Not inlined: compiled once, not for each component of each field.
    template <std::size_t stride, class F>
    [[gnu::noinline]] static void pack_column(T const* from, PairT* to, std::size_t first, std::size_t last)
    {
        for (std::size_t i = first; i < last; ++i) to[i * stride] = ParticlesOf<0>::template rounded<PairT, F>(from[i]);
    }
    /// Where positions are copied, so are their tails.
    template <Mask copied>
    static constexpr auto with_tail()
    {
        constexpr auto set = M::template fields<copied>();
        if constexpr (decltype(set)::template contains<Position>) return in_pairs(set);
        else return set;
    }
    /// Both components of a record of two: whole registers of them, interleaved.
    [[gnu::noinline]] static void pack_two(T const* x, T const* y, T* to, std::size_t first, std::size_t last)
    {
        for (std::size_t i = first; i < last; ++i) to[2 * i] = x[i], to[2 * i + 1] = y[i];
    }
    /// Copies fields of a species into its records and those of its images, and sends what others wait for.
    /// \tparam made  the records of our own and of their images are there
    template <int s, Mask copied, bool made = false>
    void pack()
    {
        if (last_sweep_ != nullptr) run_waiting(); // it reads the records of before
        auto& x = species<s>();
        const std::size_t images = x.bins.images().of.size();
        if constexpr (!made) {
            make_room<s>();
            pass_over<s>([](System& me, std::size_t first, std::size_t last) {
                me.template pack_range<s, copied>(first, last);
            });
            run_waiting<s>();
        }
        if constexpr (!alone) send_records<s, copied>();
        if (made || images == 0) return;
        backend_.for_each((images + task - 1) / task,
                          [&](std::size_t k) { pack_images<s>(k * task, std::min(images, (k + 1) * task)); });
    }
    /// Room for records of a species, of its images and of what others own; and the sentinel, any record but that it is
    /// beyond every range.
    template <int s>
    void make_room()
    {
        auto& x = species<s>();
        using L = typename std::remove_cvref_t<decltype(x.packed)>::L;
        constexpr auto stride = std::size_t(L::stride), at = std::size_t(L::template offset<Position>);
        const std::size_t n = x.particles.size();
        std::size_t records = n + 1 + x.bins.images().of.size();
        if constexpr (!alone) parts_.finish(s), records += parts_.foreign(s).records();
        if (x.packed.data.size() != records * stride) x.packed.data.assign(records * stride, PairT(1));
        PairT* const sentinel = x.packed.data.data() + n * stride;
        std::fill_n(sentinel, stride, PairT(1));
        std::fill_n(sentinel + at, std::size_t(dim), x.packed.far);
    }
    template <int s, Mask copied>
    void pack_range(std::size_t first, std::size_t end)
    {
        auto& x = species<s>();
        using L = typename std::remove_cvref_t<decltype(x.packed)>::L;
        constexpr auto stride = std::size_t(L::stride);
        constexpr bool one_vector =
            std::same_as<decltype(M::template fields<copied>()), Fields<Position>> && dim == 2 && !mixed;
        PairT* const data = x.packed.data.data();
        constexpr std::size_t in_cache = 256; // records that stay in the first-level cache over all their fields
        for (std::size_t last; first < end; first = last) {
            last = std::min(end, first + in_cache);
            if constexpr (stride == 2 && one_vector) {
                auto const& column = x.particles.column(position);
                pack_two(column[0].data(), column[1].data(), data, first, last);
                continue;
            }
            for_each(Set<with_tail<copied>()>{}, [&]<class F>(F f) {
                for (int c = 0; c < components<F, dim>; ++c) {
                    T const* from = x.particles.source_of(f)[std::size_t(c)].data();
                    using Kind = std::conditional_t<std::same_as<F, PositionTail>, F, Position>;
                    pack_column<stride, Kind>(from, data + std::size_t(L::template offset<F> + c), first, last);
                }
            });
        }
    }
    template <int s>
    void pack_images(std::size_t first, std::size_t last)
    {
        auto& x = species<s>();
        using L = typename std::remove_cvref_t<decltype(x.packed)>::L;
        constexpr auto stride = std::size_t(L::stride);
        auto const& images = x.bins.images();
        PairT* const data = x.packed.data.data();
        for (std::size_t g = first; g < last; ++g) {
            PairT* const to = data + (x.particles.size() + 1 + g) * stride;
            std::copy_n(data + std::size_t(images.of[g]) * stride, stride, to);
            move_record<L>(to, shift_of(images.code[g], grid_));
        }
    }
    /// A record of an image lies elsewhere.
    template <class L>
    static void move_record(PairT* record, Vec<dim, double> const& shift)
    {
        PairT* const at = record + L::template offset<Position>;
        for (int c = 0; c < dim; ++c) {
            if constexpr (mixed) {
                PairT* const tail = record + L::template offset<PositionTail>;
                const T moved = T(at[c]) + T(tail[c]) + T(shift[c]);
                at[c] = PairT(moved), tail[c] = PairT(moved - T(PairT(moved)));
            }
            else at[c] += PairT(shift[c]);
        }
    }
    /// Sends fields of those records that others wait for, and takes theirs as they come.
    template <int s, Mask copied>
    void send_records()
    {
        using L = typename decltype(Species<s>::packed)::L;
        static constexpr auto offset = [] {
            std::array<std::size_t, std::size_t(Layout<dim, Set<with_tail<copied>()>>::count)> o{};
            std::size_t k = 0;
            for_each(Set<with_tail<copied>()>{}, [&]<class F>(F) {
                for (int c = 0; c < components<F, dim>; ++c) o[k++] = std::size_t(L::template offset<F> + c);
            });
            return o;
        }();
        constexpr auto stride = std::size_t(L::stride);
        PairT* const data = species<s>().packed.data.data();
        const auto foreign = parts_.foreign(s);
        parts_.send(
            s, offset.size(),
            [&](std::int32_t i, PairT* to) {
                PairT const* const from = data + std::size_t(i) * stride;
                for (std::size_t k = 0; k < offset.size(); ++k) to[k] = from[offset[k]];
            },
            [this, data, foreign](std::int32_t i, PairT const* from) {
                PairT* const to = data + (std::size_t(foreign.first) + std::size_t(i)) * stride;
                for (std::size_t k = 0; k < offset.size(); ++k) to[offset[k]] = from[k];
                auto const& images = foreign.bins.images();
                if (images.of.empty()) return;
                for (auto g = images.first[std::size_t(i)]; g < images.first[std::size_t(i) + 1]; ++g) {
                    PairT* const image =
                        data + (std::size_t(foreign.first) + foreign.places.size + std::size_t(g)) * stride;
                    std::copy_n(to, stride, image);
                    const Vec<dim, double> shift = shift_of(images.code[std::size_t(g)], grid_);
                    move_record<L>(image, shift);
                }
            });
    }
    /// Records of a species with all that others own of it, outside of a plan.
    template <int s, Mask copied>
    void bring_records() const
    {
        auto& me = const_cast<System&>(*this); // records are no state
        me.template pack<s, copied>();
        if constexpr (!alone) me.parts_.finish(s);
    }
    static Parts parts_of(Workers const& workers)
    {
        if constexpr (alone) return Parts(ranks_of(workers));
        else return Parts(ranks_of(workers), workers.balance.by_cpu);
    }
    template <int s, Mask terms, Mask allowed>
    static constexpr Mask read_from(int q)
    {
        return q < species_count && (allowed >> q & 1) != 0 ? reading(terms, s, q) : 0;
    }
    /// Runs the task of each cell; on ranks f(task) does.
    template <int s, Mask terms, Mask allowed>
    void with_task(auto const& f)
    {
        if constexpr (s == 0 && (allowed & ~Mask(3)) != 0) carry_at_walls(terms_, carry_.value_or(Carry{due_}));
        constexpr Mask from_0 = read_from<s, terms, allowed>(0), from_1 = read_from<s, terms, allowed>(1);
        auto with = [&](auto const&... source) {
            auto& x = species<s>();
            using Sums = decltype(M::template fields<added(terms) | written(terms)>());
            using Target = Set<in_pairs(M::template fields<read_of_target(terms, s)>())>;
            constexpr Mask itself = (allowed >> s) & 1 ? terms : Mask(0);
            auto one = [&](std::size_t cell) {
                const bool passes_follow = !waiting_[std::size_t(s)].empty();
                sweep_cell<PairV, itself, Sums, Target>(physics_.interaction, terms_, x.particles, x.bins, cell,
                                                        passes_follow, source...);
                if constexpr (alone)
                    if (passes_follow) pass_over_cell<s>(cell);
            };
            // Alone at once: so g++ takes a scene's constants along into the sweep.
            if constexpr (alone) backend_.for_each(x.bins.cells(), one);
            else f(one);
        };
        if constexpr (from_0 != 0 && from_1 != 0) with(source<s, 0, from_0>(), source<s, 1, from_1>());
        else if constexpr (from_0 != 0) with(source<s, 0, from_0>());
        else if constexpr (from_1 != 0) with(source<s, 1, from_1>());
        else with();
    }
    /// \tparam ahead  a later sweep of the mobile particles    \tparam rest  some have run ahead
    template <int s, Mask terms, Mask allowed = ~Mask(0), Ahead ahead = Ahead{}, bool rest = false>
    void sweep()
    {
        with_task<s, terms, allowed>([&](auto const& one) {
            const std::size_t cells = species<s>().bins.cells();
            if constexpr (!alone) {
                constexpr unsigned sources =
                    (read_from<s, terms, allowed>(0) != 0 ? 1u : 0u) | (read_from<s, terms, allowed>(1) != 0 ? 2u : 0u);
                if constexpr (ahead.sweep.terms == 0) parts_.run(s, cells, sources, one, backend_, rest);
                else {
                    constexpr bool sees_walls = read_from<0, ahead.sweep.terms, ~Mask(0)>(1) != 0;
                    constexpr auto each = std::make_index_sequence<std::size_t(ahead.count)>{};
                    [&]<std::size_t... k>(std::index_sequence<k...>) { (room_for<ahead.between[k]>(), ...); }
                    (each);
                    auto one_and_on = [&](std::size_t cell) {
                        one(cell);
                        [&]<std::size_t... k>(std::index_sequence<k...>) { (stage_of<ahead.between[k]>(cell), ...); }
                        (each);
                    };
                    with_task<0, ahead.sweep.terms, ~Mask(0)>([&](auto const& later) {
                        auto sees_none = [&](std::size_t cell) {
                            if constexpr (sees_walls) return lists<0, 1>().of_cell(cell).index.empty();
                            else return true;
                        };
                        const typename Parts::template Ahead<decltype(sees_none), std::remove_cvref_t<decltype(later)>>
                            then{0, species<0>().bins.cells(), 1u, sees_none, later};
                        parts_.run(s, cells, sources, one_and_on, backend_, false, then);
                    });
                }
            }
        });
    }
    template <Stage st>
    void room_for()
    {
        if constexpr (st.action == Action::pack) make_room<st.species>();
    }
public:
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

private:
    /// f(s, q, memory set aside, memory by cell) for each pair of species of which something is kept.
    void each_memory(auto const& f)
    {
        each_species([&](auto s) {
            each_species([&](auto q) {
                constexpr int values = kept_values<s(), q()>;
                if constexpr (values > 0) {
                    auto& aside = std::get<std::size_t(s() * species_count + q())>(aside_);
                    f(s, q, aside, std::get<std::size_t(s() * species_count + q())>(memory_));
                }
            });
        });
    }
    template <int s, int q>
    auto from()
    {
        auto const& x = species<q>();
        return typename Lists<dim>::template From<T>{
            lists_[std::size_t(s * species_count + q)],         places<q>(), x.bins,
            std::remove_cvref_t<decltype(x.packed)>::L::stride, s == q,      foreign<q>()};
    }
    /// Where particles of a species were when lists were built.
    template <int s>
    auto places() const
    {
        return Places<dim, T>::of(species<s>().particles, built<s>);
    }
    /// The field that says so. Alone it need not be looked up: lists are built where particles are.
    template <int s>
    static constexpr auto built = [] {
        if constexpr (!alone && ParticlesOf<s>::template has<BuildPosition>) return build_position;
        else return position;
    }();
    template <int q>
    std::optional<Foreign<dim, T>> foreign() const
    {
        if constexpr (alone) return {};
        else return parts_.foreign(q);
    }
    template <int s, int q, Mask terms>
    auto source()
    {
        static_assert(!mixed || kept_values<s, q> == 0,
                      "spate: Mixed is for terms that keep nothing of a pair; take Double or Float");
        auto const& x = species<q>();
        auto& memory = std::get<std::size_t(s * species_count + q)>(memory_);
        return Source<terms, Set<kept<s, q>()>, ParticlesOf<q>, std::remove_cvref_t<decltype(x.packed)>, s == q>{
            x.particles, x.packed, lists<s, q>(), s == q, &memory, carry_.value_or(Carry{due_})};
    }
    /// The sets one after the other, a stretch of particles at a time: it is in the cache for the second set.
    template <bool from_start, class... Sets>
    void advance_from(double dt, Sets...)
    {
        each_species([&](auto s) {
            if constexpr (decltype((Fields<>{} | ... | (M::template evolving<s()>() & Sets{})))::size > 0)
                pass_over<s()>([s, dt](System& me, std::size_t first, std::size_t last) {
                    auto one = [&](auto set) {
                        for_each(M::template evolving<s()>() & set, [&](auto f) {
                            for (int c = 0; c < components<decltype(f), dim>; ++c)
                                advance_field<from_start, s()>(me.template species<s()>(), f, std::size_t(c), first,
                                                               last, T(dt));
                        });
                    };
                    (one(Sets{}), ...);
                });
        });
        if constexpr (M::floats) advance_bodies<from_start>(dt, Sets{}...);
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
    [[gnu::noinline]] static void copy_column(T const* from, T* to, std::size_t first, std::size_t last)
    {
        for (std::size_t i = first; i < last; i += std::size_t(width<V>)) store(to + i, load<V>(from + i));
    }
    template <int s>
    void remember_places()
    {
        auto& p = species<s>().particles;
        if constexpr (ParticlesOf<s>::template has<BuildPosition>)
            for (std::size_t c = 0; c < std::size_t(dim); ++c) {
                auto const& from = p.column(position)[c];
                auto& to = p.column(build_position)[c];
                InParts{backend_}(from.size(), [&](std::size_t first, std::size_t last) {
                    std::copy(from.data() + first, from.data() + last, to.data() + first);
                });
            }
    }
    [[gnu::cold]] void make_room()
    {
        each_species([&](auto s) {
            auto& x = species<s()>();
            if (saves_) x.start.resize(x.particles.size());
            x.particles.fit();
            x.particles.pad();
        });
    }
    /// Builds the lists of sorted particles, and gives them what was set aside of the pairs.
    void build_lists()
    {
        each_species([&](auto s) {
            auto build = [&](auto... sources) {
                const std::array<typename Lists<dim>::template From<T>, sizeof...(sources)> from{sources...};
                const typename Lists<dim>::template For<T> target{s(), places<s()>(), species<s()>().bins,
                                                                  species<s()>().particles.id()};
                Lists<dim>::build(target, grid_, width<PairV>, neighbours_, physics_.interaction.range(),
                                  skins_.of(s()), backend_, from);
            };
            constexpr bool meets_0 = M::planner.meet(s(), 0), meets_1 = species_count == 2 && M::planner.meet(s(), 1);
            if constexpr (meets_0 && meets_1) build(from<s(), 0>(), from<s(), 1>());
            else if constexpr (meets_0) build(from<s(), 0>());
            else if constexpr (meets_1) build(from<s(), 1>());
        });
        each_memory([&](auto s, auto q, auto& aside, auto& memory) {
            aside.give(lists<s(), q()>(), memory, species<s()>().particles, species<s()>().bins,
                       species<q()>().particles, species<q()>().bins, width<PairV>, backend_, foreign<q()>());
            aside.clear(); // it would be old news to lists to come
        });
        have_lists_ = true;
    }
    void look_around()
    {
        auto others = [&]<int s>(std::integral_constant<int, s>) -> Binning<dim> const* {
            if constexpr (alone) return nullptr;
            else return &parts_.halo(s).bins();
        };
        constexpr std::integral_constant<int, 0> mobiles{};
        if constexpr (M::markers) {
            constexpr std::integral_constant<int, 1> of_walls{};
            skins_.look_around(grid_, species<0>().bins, &species<1>().bins, others(mobiles), others(of_walls));
        }
        else skins_.look_around(grid_, species<0>().bins, nullptr, others(mobiles));
    }

    // ---- on many ranks
    Index<dim> cell_at(auto const& p, auto field, std::size_t i) const;
    /// Sends each particle, and what is kept of its pairs, to the owner of its cell.
    /// \param as_built  by where it was when lists were built    \param extra  of each particle, goes along
    void go_home(bool as_built, OfParticles* extra = nullptr);
    /// Who is near across the borders, now that particles are sorted.
    void meet_others();
    /// The patch in which each particle was when lists were built.
    template <int s>
    std::vector<Index<dim>> patches() const;
    bool balance_due() { return backend_.balance.every > 0 && ++looks_ % backend_.balance.every == 0; }
    [[gnu::cold]] void check_cells() const;
    /// Like shares of particles, before anything is known of what they cost.
    void cut_by_number();
    template <int s>
    [[nodiscard]] std::int64_t pairs_of_cell(std::size_t k) const;
    /// Since lists were built, in the unit of the balance.
    template <int s>
    [[nodiscard]] std::int64_t cost_of_cell(std::size_t k) const;
    /// Particles that know where they were when lists were built go home by it, and the lists are built again with skins
    /// of then.
    void build_again(bool local, OfParticles skin);
    /// Like shares of what cells have cost since lists were built, if that pays.
    void cut_by_cost();
    /// Cells that were here when lists were built, and are another rank's by new cuts.
    void count_moved_cells();
    /// The skin at each particle, empty where all are the same.
    template <int s>
    std::vector<double> skins_by_particle() const;

    static void swap_with_built(auto& particles)
    {
        if constexpr (std::remove_cvref_t<decltype(particles)>::template has<BuildPosition>)
            std::swap(particles.column(position), particles.column(build_position));
    }
    /// Where velocities differ lists reach far; see Skins.
    [[gnu::cold]] void choose_skins(bool wide)
    {
        skins_.use(neighbours_.closed_in());
        if (!neighbours_.local || !any_pairs) return;
        look_around();
        if (wide) return;
        skins_.use(neighbours_.closed_in(), spreads([](auto& box, auto const& p, std::size_t i) {
                       for (int c = 0; c < dim; ++c) box.add(c, double(p.column(velocity)[std::size_t(c)][i]));
                   }),
                   ranks());
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
        auto all = skins_.spreads(
            grid_, species<0>().bins, markers, [&](auto& box, std::size_t i) { add(box, mobile(), i); }, backend_);
        if constexpr (!alone) {
            if constexpr (M::moves) all.markers = ranks().all(all.markers, agree::Join{});
            const_cast<Parts&>(parts_).exchange_patches(0, all.mobile, skins_.of(0).patches());
        }
        return all;
    }
    void wrap()
    {
        if (!grid_.any_periodic()) return;
        wrap(mobile());
        if constexpr (M::moves) wrap(species<1>().particles);
    }
    void wrap(auto& particles)
    {
        const double most = farthest();
        auto& x = particles.column(position);
        for (int c = 0; c < dim; ++c)
            if (grid_.periodic(c))
                for (std::size_t i = 0; i < particles.size(); ++i) {
                    auto& value = x[std::size_t(c)][i];
                    if (!(std::abs(double(value)) <= most)) stop_lost(particles, i, most);
                    value = T(grid_.wrapped(c, double(value)));
                    const bool inside = double(value) >= grid_.box().lo[c] && double(value) < grid_.box().hi[c];
                    if (!inside) value = T(grid_.box().lo[c]); // rounded out in T
                }
    }
    [[noreturn, gnu::cold]] static void stop_lost(auto const& particles, std::size_t i, double most)
    {
        StopFacts f;
        f.particle = particles.id()[i];
        f.quantity = "the distance from the origin along an axis [m], to wrap,";
        for (int c = 0; c < dim; ++c) {
            f.position[c] = particles.at(position, i)[c];
            if (!(std::abs(f.position[c]) <= most)) f.value = f.position[c];
        }
        f.limit = most;
        throw IndexOverflow(f);
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
        using InLists = std::tuple<KeptOfCells<T, kept_values<k / species_count, k % species_count>>...>;
    };
    typename AllMemory<std::make_integer_sequence<int, species_count * species_count>>::type aside_;
    typename AllMemory<std::make_integer_sequence<int, species_count * species_count>>::InLists memory_; ///< by cell
    LocalSkins<dim, species_count> skins_;
    [[no_unique_address]] Parts parts_;
    double wrap_after_ = std::numeric_limits<double>::infinity(); ///< way after which positions are wrapped anew [m]
    bool have_lists_ = false, sorted_markers_ = false, kick_rates_ = false, lost_ = false, bounced_ = false;
    std::array<std::vector<Pass>, std::size_t(species_count)> waiting_; ///< passes, in their order
    bool puts_off_ = false;                                             ///< whether passes wait
    void (*last_sweep_)(System&) = nullptr;                             ///< that waits before them
    LaneExtremes<V, dim> seen_;
    static inline std::mutex seeing;
    std::optional<Carry> carry_; ///< of sweeps for rates; to others what is kept of pairs is only shown
    Carry last_carry_;           ///< of the one that waits
    double due_ = 0, moved_ = 0; ///< time since what is kept of pairs was kept, since the step was saved [s]
    bool trial_ = false;         ///< between save() and advance_saved()
    std::int64_t rebuilds_ = 0, evaluations_ = 0, pairs_evaluated_ = 0, looks_ = 0;
};

} // namespace spate
