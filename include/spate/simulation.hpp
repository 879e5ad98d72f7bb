// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A scene: physics, integrator, boundary and backend, put together; filled with particles and run.
#pragma once

#include "spate/backend/backend.hpp"
#include "spate/backend/serial.hpp"
#include "spate/boundary/boundary.hpp"
#include "spate/boundary/motion.hpp"
#include "spate/integrator/integrator.hpp"
#include "spate/measure/exchanged.hpp"
#include "spate/measure/nearest_image.hpp"
#include "spate/measure/wall_force.hpp"
#include "spate/measure/watch.hpp"
#include "spate/physics/advice.hpp"
#include "spate/physics/measures.hpp"
#include "spate/physics/sph/rest.hpp"
#include "spate/physics/time_step.hpp"

#include <atomic>
#include <bit>
#include <chrono>
#include <functional>
#include <numbers>
#include <set>

namespace spate {

/// How long and how finely to run: `dam.run({.until = 0.9, .cfl = 0.2})`.
struct RunOptions {
    double until = std::numeric_limits<double>::infinity();        ///< end time [s]
    std::int64_t steps = std::numeric_limits<std::int64_t>::max(); ///< at most so many steps in this call
    double cfl = 0.25;                                             ///< factor C of the time-step criteria [-]
    double dt = 0;                                                 ///< fixed step [s]; 0: by the criteria
};

/// What a run was like, so far.
struct RunReport {
    std::int64_t steps = 0;
    double wall = 0;             ///< of the step loop, output excluded [s]
    double cpu = 0;              ///< of all threads in it [s]
    double mach = 0;             ///< largest |v| / c0 [-]
    double density_change = 0;   ///< largest |rho / rho0 - 1| [-]
    double energy_rise = 0;      ///< largest rise of total energy over the reference [-]
    double energy_reference = 0; ///< [J]
    Energy start;                ///< at the first step
    TimeStep stable;             ///< largest step that linear theory lets stand at the first step
    std::vector<std::string> warnings;
};

/// How an interaction wants its lists kept, where it says so.
template <class I>
constexpr Neighbours neighbours_for()
{
    if constexpr (requires { I::neighbours; }) return I::neighbours;
    else return {};
}

template <class P, class I, class B, class Workers = Serial, class Precision = Double, class W = Watch>
class Simulation {
    static_assert(Integrator<I>, "spate: the second argument of a Simulation is an integrator, such as RungeKutta2{}");
    static_assert(spate::Backend<Workers>,
                  "spate: the fourth argument of a Simulation is a backend, such as Threads{}; "
                  "see backend/backend.hpp");
    static_assert(
        std::same_as<std::remove_cvref_t<decltype(std::declval<B const&>().template edges<P::dim>())>, Edges<P::dim>>,
        "spate: the boundary has another number of dimensions than the kernel or the grains");
    static_assert(Boundary<B, P::dim>,
                  "spate: the third argument of a Simulation is a boundary of the physics' dimension, "
                  "such as Open{}; see boundary/boundary.hpp");

public:
    static constexpr int dim = P::dim;
    using Engine = System<P, B, Workers, Precision>;
    static constexpr bool has_contacts = Set<Engine::M::wall_adds>::template contains<Acceleration>;
    using Point = Vec<dim, double>;
    using Mobile = typename Engine::template ParticlesOf<0>;

    [[gnu::cold]] Simulation(P physics, I integrator, B boundary, Workers backend = {}, Precision = {}, W watch = {},
                             Neighbours neighbours = neighbours_for<typename Engine::M::Interaction>())
        : integrator_(integrator), watch_(watch), system_(checked(physics, boundary, backend, neighbours, watch),
                                                          boundary, backend, neighbours, I::saves || traces),
          g_(gravity_of(physics))
    {
        place_markers();
    }

    // ---- particles
    /// Fills a box with particles at the centres of cubes of edge `spacing` [m], but where a solid is; `start` is
    /// `hydrostatic`, `settled`, or is called with (particles, i) for each new one. Returns how many.
    template <class Start = std::nullptr_t>
    [[gnu::cold]] std::size_t fill(Box<dim> const& box, double spacing, Start start = nullptr)
    {
        require_positive("spacing", spacing, "m");
        check_start<Start>();
        Index<dim> n;
        for (int c = 0; c < dim; ++c) {
            const std::string edge = along_axis("box length", c);
            require_positive(edge, box.size()[c], "m");
            const double k = std::round(box.size()[c] / spacing);
            require(spacing <= box.size()[c] * (1 + 1e-6), "spacing", spacing,
                    "at most the box length " + text(box.size()[c]) + " m");
            require(k < 1e9, "spacing", spacing, "at least a billionth of the box length");
            require(std::abs(box.size()[c] / spacing - k) < 1e-6 * k, edge, box.size()[c],
                    "a whole number of spacings; the nearest is " + text(k * spacing) + " m, or take spacing " +
                        text(box.size()[c] / k) + " m");
            n[std::size_t(c)] = std::int32_t(k);
        }
        constexpr double most = std::numeric_limits<std::int32_t>::max();
        double particles = 1;
        for (auto k : n) particles *= k;
        require(particles <= most, "spacing", spacing, "one that gives at most 2147483647 particles");
        complete(spacing);
        set_mass(spacing);
        auto& p = system_.mobile();
        system_.set_aside();
        const std::size_t first = p.size();
        std::size_t count = 1;
        for (auto k : n) count *= std::size_t(k);
        std::vector<Point> at;
        // Each rank begins a part, unless the user's own start may count on all of them.
        bool a_part = false;
        if constexpr (!Engine::alone && (at_rest<Start> || std::same_as<Start, std::nullptr_t>))
            a_part = system_.template owns_all<0>();
        std::vector<std::uint32_t> numbers;
        std::size_t placed = 0;
        for (std::size_t k = 0; k < count; ++k) {
            Point x;
            std::size_t rest = k;
            for (int c = 0; c < dim; ++c) {
                const auto m = std::size_t(n[std::size_t(c)]);
                x[c] = box.lo[c] + (double(rest % m) + 0.5) * spacing;
                rest /= m;
            }
            if constexpr (requires { system_.boundary().covers(x); })
                if (system_.boundary().covers(x)) continue;
            const std::size_t number = placed++;
            if (a_part) {
                if (!system_.starts_here(number)) continue;
                numbers.push_back(std::uint32_t(number));
            }
            at.push_back(x);
        }
        if constexpr (!Engine::alone)
            if (a_part) system_.template adopt<0>(std::move(numbers), placed);
        if (!a_part) p.resize(first + at.size());
        for (std::size_t k = 0; k < at.size(); ++k) {
            p.put(position, first + k, at[k]);
            begin(p, first + k, box, start);
        }
        if constexpr (Engine::species_count == 2) wet_markers(box, start);
        prepare();
        return placed;
    }
    template <int Other, class... Start>
    std::size_t fill(Box<Other> const&, double, Start...)
    {
        static_assert(Other == dim, "spate: the box has another number of dimensions than the kernel or the grains");
        return 0;
    }
    /// One particle; its index until the next step.
    std::size_t add(Point const& x, Point const& v = {})
    {
        system_.set_aside();
        prepared_ = looked_ = false;
        return append(system_.mobile(), x, v);
    }
    /// Room for particles that are to enter.
    [[nodiscard]] Mobile newcomers() const
    {
        Mobile more;
        for_each(Mobile::uniform, [&](auto f) { more.value(f) = system_.mobile().value(f); });
        return more;
    }
    /// One particle among newcomers, as add() begins it.
    std::size_t append(Mobile& to, Point const& x, Point const& v = {}) const
    {
        const std::size_t i = to.size();
        to.resize(i + 1);
        to.put(position, i, x);
        begin(to, i, Box<dim>{x, x}, nullptr);
        to.put(velocity, i, v);
        return i;
    }
    /// Between two steps newcomers enter, in their order and with ids that nobody had before; nobody touches them yet. All
    /// ranks are given the same ones, and each keeps its own.
    [[gnu::cold]] Amount<dim> enter(Mobile const& more)
    {
        if (!prepared_) prepare();
        if (more.empty()) return {};
        auto& p = system_.mobile();
        system_.set_aside();
        const std::size_t first = p.size();
        p.resize(first + more.size());
        for_each(Mobile::fields, [&](auto f) {
            for (std::size_t c = 0; c < std::size(p.column(f)); ++c)
                std::copy_n(more.column(f)[c].begin(), more.size(), p.column(f)[c].begin() + std::ptrdiff_t(first));
        });
        together(system_.ranks(), [&] { check_particles(), check_places(first); });
        std::vector<char> is(p.size(), 0);
        std::fill(is.begin() + std::ptrdiff_t(first), is.end(), char(1));
        const Amount<dim> a = amount_of(is, false);
        looked_ = false;
        system_.resized();
        exchanged_.entered += a, exchanged_.moment += a.mass * time_;
        return a;
    }
    /// Between two steps the particles leave for which leaves(particles, i) holds: theirs is what is returned.
    Amount<dim> remove(auto const& leaves)
    {
        if (!prepared_) prepare();
        std::vector<char> is;
        if (!system_.ranks().all(find(leaves, is), agree::Or{})) return {};
        make_lists_current(); // for their contacts; may sort
        find(leaves, is);
        const Amount<dim> a = amount_of(is, true);
        std::vector<std::int32_t> stay;
        for (std::size_t i = 0; i < is.size(); ++i)
            if (is[i] == 0) stay.push_back(std::int32_t(i));
        looked_ = false;
        system_.keep(stay);
        exchanged_.left += a, exchanged_.moment -= a.mass * time_;
        return a;
    }
    /// What has entered and left.
    [[nodiscard]] Exchanged<dim> const& exchanged() const { return exchanged_; }
    /// Tells the scene that particles were changed by hand.
    [[gnu::cold]] void prepare()
    {
        if (physics().open())
            throw BadInput("spacing", "not known",
                           "given by a fill, or kernel.h and what terms want of it by hand [m]");
        together(system_.ranks(), [&] {
            check_particles();
            if (step_ == 0) check_places();
        });
        looked_ = false;
        system_.use(make_grid());
        system_.resized();
        if constexpr (!Engine::alone) system_.distribute(step_ == 0);
        prepared_ = true;
    }

    // ---- running
    /// Throws BadInput for the first option out of range; run() asks too.
    [[gnu::cold]] static void check(RunOptions const& o)
    {
        require(!std::isnan(o.until) && o.until >= 0, "until", o.until, "0 or above [s]");
        require_non_negative("dt", o.dt, "s");
        require(o.cfl > 0 && o.cfl <= 10, "cfl", o.cfl, "above 0 and at most 10");
        require(o.steps >= 0, "steps", double(o.steps), "0 or above");
        require(std::isfinite(o.until) || o.steps < std::numeric_limits<std::int64_t>::max(), "until", o.until,
                "a finite end time [s], or a number of steps");
    }
    /// Steps until the end time or the number of steps; outputs have begin(sim), step(sim), end(sim). What changes the scene
    /// between two steps, such as a Pour, has before_step(sim) besides.
    template <class... Output>
    RunReport const& run(RunOptions const& o, Output&&... output)
    {
        check(o);
        if constexpr (!Engine::alone) agree_on(o);
        if (!prepared_) prepare();
        begin_run(o);
        (output.begin(*this), ...);
        const std::int64_t last =
            o.steps > std::numeric_limits<std::int64_t>::max() - step_ ? o.steps : step_ + o.steps;
        try {
            while (time_ < o.until && step_ < last && !interrupted()) {
                (before_step(output), ...);
                step(o);
                (output.step(*this), ...);
            }
            if constexpr (W::on) final_look();
        }
        catch (Stop& stop) {
            stopped_ = true;
            (output.end(*this), ...);
            (tell(stop, output), ...);
            throw;
        }
        (output.end(*this), ...);
        return report_;
    }
    /// One step.
    void step(RunOptions const& o)
    {
        if (!prepared_) prepare();
        const auto wall = std::chrono::steady_clock::now();
        const std::clock_t cpu = std::clock();
        if constexpr (!Engine::alone) system_.wander(step_);
        Extremes e = looked_ ? system_.seen() : system_.template extremes<needs_acceleration>();
        looked_ = false;
        look(e);
        choose_dt(o, e);
        if constexpr (Engine::M::moves) e |= move_markers(dt_);
        bool outrun = false;
        if (stale(e)) {
            if constexpr (W::on) look_outside();
            rebuild();
            if (stale(e.unmoved())) rebuild(true);
            if (stale(e.unmoved()) && o.dt <= 0) shorten(e.unmoved());
            outrun = stale(e.unmoved());
        }
        if constexpr (W::on) look_at_way(e);
        if (outrun) stop_outrun(e.unmoved());
        if constexpr (W::on) {
            if (step_ == 0) look_at_start();
            if (energy_due()) look_at_energy();
            if constexpr (traces) keep_step();
        }
        system_.template phase<When::before_step>(step_, [] {}); // the lists are those of this step
        move_contacts();
        system_.put_off();
        integrator_.step(system_, dt_);
        if constexpr (Engine::reflects && !requires { I::reflects; }) system_.reflect();
        if constexpr (!Engine::M::template has_phase<When::after_step>)
            system_.template look<needs_acceleration>(), looked_ = true; // along with what waits
        system_.finish();
        if constexpr (Engine::reflects) look_at_bounces();
        after_step();
        time_ += dt_;
        ++step_;
        ++report_.steps;
        report_.cpu += double(std::clock() - cpu) / CLOCKS_PER_SEC;
        report_.wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
    }
    /// Whether the watch can say which term made a value; on many ranks a replay would be of all of them.
    static constexpr bool traces = requires { W::traces; }
    &&Engine::alone;
    /// Whether a term sets densities, and with them energy that no force gives: re-initialisation.
    static constexpr bool writes_energy = []<class... T>(std::tuple<T...> const*) {
        return (false || ... || requires { T::writes_energy; });
    }(static_cast<typename Engine::M::Terms const*>(nullptr));
    /// The compressive energy that such terms have given to the fluid since the start [J].
    [[nodiscard]] double written_energy() const { return written_energy_; }
    /// Asked before each step: true ends the run after the step in hand.
    void interrupt_when(std::function<bool()> f) { interrupted_ = std::move(f); }
    [[nodiscard]] bool interrupted() const { return system_.ranks().all(interrupted_(), agree::Or{}); }

    // ---- what is known
    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] double dt() const { return dt_; }
    [[nodiscard]] std::string_view criterion() const { return criterion_; }
    [[nodiscard]] std::int64_t steps() const { return step_; }
    [[nodiscard]] RunReport const& report() const { return report_; }
    P const& physics() const { return system_.physics(); }
    I const& integrator() const { return integrator_; }
    Engine& system()
    {
        looked_ = false;
        return system_;
    }
    Engine const& system() const { return system_; }
    auto& particles()
    {
        looked_ = false;
        return system_.mobile();
    }
    auto const& particles() const { return system_.mobile(); }
    Vec<dim, double> const& gravity() const { return g_; }
    /// What bounds the step; known from the first step on.
    Stiffness const& stiffness() const { return stiffness_; }
    /// Brings pressure and other derived fields up to date with the state.
    void refresh()
    {
        if (stopped_) return;
        make_lists_current();
        looked_ = false;
        system_.refresh();
    }
    /// Rebuilds the neighbour lists if the positions of now need it: the next step would begin with the same rebuild.
    void make_lists_current()
    {
        if (!prepared_) prepare();
        if (system_.stale(system_.extremes(), 0, 0)) rebuild();
    }
    /// Whether a Stop has ended the run: the state is left as it was found, and nothing brings it up to date.
    [[nodiscard]] bool stopped() const { return stopped_; }
    /// Of the mobile particles, and what those that left had lost; lists must be current where contacts store energy.
    [[nodiscard]] Energy energy() const
    {
        Energy e = energy_in(system_);
        e.dissipated += exchanged_.left.dissipated;
        return e;
    }
    /// sum m v over the mobile particles [kg m/s], each component exact.
    [[nodiscard]] Point momentum() const
    {
        auto const& p = system_.mobile();
        Point total;
        for (int c = 0; c < dim; ++c)
            total[c] = system_.sum([&](std::size_t i) { return p.at(mass, i) * p.at(velocity, i)[c]; });
        return total;
    }
    /// sum m over the mobile particles [kg].
    [[nodiscard]] double total_mass() const
    {
        auto const& p = system_.mobile();
        return system_.sum([&](std::size_t i) { return p.at(mass, i); });
    }
    /// sum m/rho over the mobile particles [m^dim].
    [[nodiscard]] double volume() const
    {
        auto const& p = system_.mobile();
        return system_.sum([&](std::size_t i) { return p.at(mass, i) / p.at(density, i); });
    }
    /// Of the particles on the walls of markers [N]; derived fields are those of the last evaluation: refresh() before.
    [[nodiscard]] Point wall_force() requires(Engine::species_count == 2 || has_contacts) { return WallForce{}(*this); }
    /// Whether something does work on the particles: walls that move, a force of the user, or gravity along a periodic axis,
    /// which has no potential to compare with.
    [[nodiscard]] bool driven() const
    {
        if constexpr (driven_by_user) return true;
        if constexpr (requires { B::has_velocity; })
            if constexpr (B::has_velocity) return true; // a wall that moves does work
        const auto edges = system_.boundary().template edges<dim>();
        for (int c = 0; c < dim; ++c)
            if (g_[c] != 0 && edges.periodic(c)) return true;
        return false;
    }
    [[nodiscard]] std::uint64_t state_hash() const { return system_.state_hash(); }

    // ---- going on from a checkpoint: see io/resume.hpp
    /// f(name, number) for all that the steps to come depend on beside the particles, and for what has been counted.
    template <class Self>
    [[gnu::cold]] static void numbers_of(Self& self, auto const& f)
    {
        auto& r = self.report_;
        f("step", self.step_), f("time", self.time_), f("dt", self.dt_);
        f("free_dt", self.free_dt_), f("first_dt", self.first_dt_), f("warned", self.warned_);
        f("cfl", self.cfl_), f("fixed_dt", self.fixed_dt_);
        f("report_steps", r.steps), f("wall_s", r.wall), f("cpu_s", r.cpu);
        f("mach_max", r.mach), f("density_change_max", r.density_change), f("energy_rise_max", r.energy_rise);
        f("energy_reference", r.energy_reference), f("kinetic_start", r.start.kinetic);
        f("potential_start", r.start.potential), f("internal_start", r.start.internal);
        f("written_energy", self.written_energy_), f("exchanged_moment", self.exchanged_.moment);
        f("came_at_start", self.came_at_start_);
        for (auto* a : {&self.exchanged_.entered, &self.exchanged_.left}) {
            const std::string side = a == &self.exchanged_.left ? "left_" : "entered_";
            f(side + "particles", a->particles), f(side + "mass", a->mass), f(side + "energy", a->energy);
            f(side + "dissipated", a->dissipated);
            for (int c = 0; c < dim; ++c) f(along_axis(side + "momentum", c), a->momentum[c]);
        }
        Engine::numbers_of(self.system_, f);
    }
    /// f(name, value) for what the scene was put together with; a scene that differs in one of them is another scene.
    [[gnu::cold]] void each_parameter(auto const& f) const
    {
        auto const& i = physics().interaction;
        auto const& n = system_.neighbours();
        f("range of interaction", i.range()), f("length of interaction", i.length());
        if constexpr (has_equation_of_state<P>)
            f("rho0", equation_of_state(physics()).rho0), f("c0", equation_of_state(physics()).c0);
        const Stiffness s = stiffness_of_all();
        f("viscosity", s.viscosity), f("contact frequency", s.contact_frequency);
        for (int c = 0; c < dim; ++c) f(along_axis("gravity", c), g_[c]);
        f("skin", n.skin), f("bin edge over range", n.bin_edge()), f("trigger", n.closed_in());
        f("bins in a range", n.finer), f("skin by place", n.local);
        if (const auto box = system_.boundary().template box<dim>())
            for (int c = 0; c < dim; ++c)
                f(along_axis("lower corner of the box", c), box->lo[c]),
                    f(along_axis("upper corner of the box", c), box->hi[c]);
        if constexpr (Engine::M::floats) {
            auto const& bodies = system_.boundary().bodies();
            for (int k = 0; k < bodies.count; ++k) f("mass of body " + std::to_string(k), bodies[k].mass);
        }
        system_.each_species([&](auto k) {
            auto const& p = system_.template species<k()>().particles;
            for_each(p.uniform, [&]<class F>(F field) {
                f(std::string(F::name) + " of species " + std::to_string(k()), p.value(field));
            });
        });
    }
    /// Whether the particles are those that the scene last heard of.
    [[nodiscard]] bool prepared() const { return prepared_; }
    /// The state of another time takes the place of this one. fill() puts it into the particles and the numbers; then
    /// lists(system) builds the lists of then.
    [[gnu::cold]] void resume(Box<dim> const& grid_box, std::string const& criterion, std::vector<std::string> warnings,
                              auto const& fill, auto const& lists)
    {
        static std::set<std::string> words; // a criterion is a view
        system_.use(make_grid(grid_box));
        fill();
        lists(system_);
        criterion_ = *words.insert(criterion).first;
        report_.warnings = std::move(warnings);
        stiffness_ = stiffness_of_all();
        hold_bodies();
        if constexpr (Engine::M::moves) system_.boundary().move_to(time_);
        least_radius_ = least_radius();
        prepared_ = true, stopped_ = false, resumed_ = true, looked_ = false;
    }
    /// The bins of lists beyond the range, in a box.
    [[gnu::cold]] [[nodiscard]] Grid<dim> make_grid(Box<dim> const& box) const
    {
        constexpr int by_dimension[] = {64, 16, 6}, of_many_ranks[] = {16, 4, 2}; // several cells a rank
        // Short lists make cells so cheap that what a cell itself costs shows: larger ones, where enough remain for each thread.
        constexpr int of_short_lists[] = {64, 32, 10};
        const bool larger = short_lists<typename Engine::M::Interaction> &&
                            system_.mobile().size() > 32768 * std::size_t(system_.backend().threads());
        const int cell = system_.backend().cell > 0 ? system_.backend().cell
                         : !Engine::alone           ? of_many_ranks[dim - 1]
                         : larger                   ? of_short_lists[dim - 1]
                                                    : by_dimension[dim - 1];
        auto const& n = system_.neighbours();
        return Grid<dim>(box, system_.boundary().template edges<dim>(), physics().interaction.range() * n.bin_edge(),
                         n.finer, cell);
    }

private:
    /// The message of a stop names the files that an output has saved for it.
    template <class Output>
    static void tell([[maybe_unused]] Stop& stop, [[maybe_unused]] Output const& output)
    {
        if constexpr (requires { stop.add(output.saved()); }) stop.add(output.saved());
    }
    [[nodiscard]] Stiffness stiffness_of_all() const
    {
        const double m = least(mass);
        Stiffness s = stiffness_of(physics(), m, least(radius));
        detail::each_in(system_.terms(), [&](auto const& t) {
            if constexpr (requires { t.pushes; })
                s.contact_frequency = std::max(s.contact_frequency, t.contact_frequency(m));
        });
        return s;
    }
    /// A particle term other than Gravity that pushes: a driving force of unknown work.
    static constexpr bool driven_by_user = []<class... X>(std::tuple<X...> const*) {
        return (false || ... ||
                (ParticleTerm<X> && !std::same_as<X, Gravity<dim>> && decltype(adds<X>() | writes<X>())::size > 0 &&
                 (decltype((adds<X>() | writes<X>()) & Fields{acceleration, velocity})::size > 0)));
    }(static_cast<typename P::Terms const*>(nullptr));
    static constexpr bool needs_acceleration = has_equation_of_state<P> || I::ahead_acceleration > 0;

    /// Ranks that run different scenes, or not to the same end, would wait for each other for ever.
    [[gnu::cold]] void agree_on(RunOptions const& o) const
    {
        auto const& b = system_.backend();
        std::vector<std::string> name{"until",    "steps", "cfl",           "dt",
                                      "the step", "cell",  "Balance.every", "Balance.forced"};
        std::vector<double> most{o.until,
                                 double(o.steps),
                                 o.cfl,
                                 o.dt,
                                 double(step_),
                                 double(b.cell),
                                 double(b.balance.every),
                                 double(b.balance.forced)};
        each_parameter([&](std::string_view what, double value) { name.emplace_back(what), most.push_back(value); });
        std::vector<double> least = most;
        system_.ranks().each(least, agree::Least{});
        system_.ranks().each(most, agree::Most{});
        for (std::size_t k = 0; k < least.size(); ++k)
            if (least[k] != most[k] && !(std::isnan(least[k]) && std::isnan(most[k])))
                throw BadInput(name[k], text(least[k]) + " on one rank and " + text(most[k]) + " on another",
                               "the same on all ranks");
    }
    void before_step([[maybe_unused]] auto& output)
    {
        if constexpr (requires { output.before_step(*this); }) output.before_step(*this);
    }
    /// Whether there is any; `is` tells which.
    bool find(auto const& leaves, std::vector<char>& is) const
    {
        auto const& p = system_.mobile();
        const std::size_t n = p.size();
        is.assign(n, 0);
        std::atomic<bool> any = false;
        system_.backend().for_each((n + Engine::task - 1) / Engine::task, [&](std::size_t k) {
            bool mine = false;
            for (std::size_t i = k * Engine::task, end = std::min(n, (k + 1) * Engine::task); i < end; ++i)
                if (leaves(p, i)) is[i] = 1, mine = true;
            if (mine) any = true;
        });
        return any;
    }
    [[gnu::cold]] Amount<dim> amount_of(std::vector<char> is, bool contacts) const
    {
        if (contacts) is = system_.with_foreign(std::move(is));
        auto const& p = system_.mobile();
        const Some<Engine> some{system_, is, contacts};
        Amount<dim> a;
        a.particles = std::int64_t(some.sum([](std::size_t) { return 1.0; }));
        a.mass = some.sum([&](std::size_t i) { return p.at(mass, i); });
        for (int c = 0; c < dim; ++c)
            a.momentum[c] = some.sum([&](std::size_t i) { return p.at(mass, i) * p.at(velocity, i)[c]; });
        const Energy e = energy_in(some);
        a.energy = e.total(), a.dissipated = e.dissipated;
        return a;
    }
    [[nodiscard]] Energy energy_in(auto const& particles) const
    {
        if constexpr (has_equation_of_state<P>) return energy_of(particles, &equation_of_state(physics()), g_);
        else return energy_of(particles, static_cast<void const*>(nullptr), g_);
    }
    [[gnu::cold]] static P const& checked(P const& physics, B const& boundary, Workers const& backend,
                                          Neighbours const& n, W const& watch)
    {
        if (!physics.open()) check_physics(physics, boundary, n);
        backend.check();
        n.check();
        watch.check();
        require(backend.cell >= 0 && backend.cell <= 32, "cell", backend.cell, "0 (by dimension), or 1 to 32 ranges");
        return physics;
    }
    static void check_physics(P const& physics, B const& boundary, Neighbours const& n)
    {
        physics.check();
        // Lists are made of squares in float, in which these are finite and not 0.
        const double range = physics.interaction.range();
        require(range > 1e-18 && range < 1e18, "the range of interaction", range, "between 1e-18 and 1e18 [m]");
        boundary.check(physics.interaction.range() * (1 + n.skin));
    }
    /// What the physics leaves to the spacing of the particles.
    void complete(double spacing)
    {
        if (!physics().open()) return;
        const P whole = physics().at(spacing);
        check_physics(whole, system_.boundary(), system_.neighbours());
        system_.complete(whole);
    }
    /// Mass from the spacing, where mass is uniform and follows from a reference density.
    [[gnu::cold]] void set_mass(double spacing)
    {
        if constexpr (has_equation_of_state<P> && Set<P::uniform>::template contains<Mass>) {
            const double m = equation_of_state(physics()).rho0 * std::pow(spacing, dim);
            auto& mine = system_.mobile().value(mass);
            require(mine == 0 || std::abs(m / mine - 1) < 1e-12, "spacing", spacing,
                    "the spacing of the first fill: mass is uniform");
            mine = m;
            if constexpr (Engine::species_count == 2) system_.template species<1>().particles.value(mass) = m;
        }
    }
    template <class Start>
    static constexpr bool at_rest = std::same_as<Start, Hydrostatic> || std::same_as<Start, Settled>;
    template <class Start>
    void check_start() const
    {
        if constexpr (at_rest<Start>)
            static_assert(has_equation_of_state<P>,
                          "spate: hydrostatic needs an equation of state in the model, and so does settled");
        if constexpr (std::same_as<Start, Settled>) {
            int along = 0;
            for (int c = 0; c < dim; ++c) along += g_[c] != 0;
            require(along <= 1, "components of Gravity.g for a settled start", along, "0 or 1: along an axis");
        }
    }
    template <class Particles, class Start>
    void begin(Particles& p, std::size_t i, [[maybe_unused]] Box<dim> const& box, [[maybe_unused]] Start start) const
    {
        if constexpr (has_equation_of_state<P> && Particles::template has<Density>)
            p.put(density, i, equation_of_state(physics()).rho0);
        if constexpr (at_rest<Start>) {
            constexpr bool wall = !std::same_as<Particles, std::remove_cvref_t<decltype(system_.mobile())>>;
            const detail::AtRest rest{equation_of_state(physics()), box, g_};
            const Point x = p.at(position, i);
            double rho;
            if constexpr (std::same_as<Start, Hydrostatic>)
                rho = rest.eos.hydrostatic_density(std::max(0.0, rest.depth(x)));
            else if constexpr (wall) rho = rest.eos.hydrostatic_density(std::max(0.0, rest.depth(x) - rest.sunk()));
            else p.put(position, i, rest.settled_place(x)), rho = rest.density_under(rest.depth(x));
            p.put(density, i, rho);
        }
        else if constexpr (!std::same_as<Start, std::nullptr_t>) start(p, i);
    }
    [[gnu::cold]] void place_markers()
    {
        if constexpr (Engine::species_count == 2) {
            complete(system_.boundary().spacing());
            auto& p = system_.template species<1>().particles;
            std::vector<Point> x;
            std::vector<int> of;
            std::vector<std::uint32_t> numbers;
            std::size_t placed = 0;
            system_.boundary().place(physics().interaction.range(), [&](Point const& at, int k = 0) {
                const std::size_t number = placed++;
                if (!system_.starts_here(number)) return;
                x.push_back(at), of.push_back(k);
                if constexpr (!Engine::alone) numbers.push_back(std::uint32_t(number));
            });
            if constexpr (Engine::alone) p.resize(x.size());
            else system_.template adopt<1>(std::move(numbers), placed);
            for (std::size_t i = 0; i < x.size(); ++i) {
                p.put(position, i, x[i]);
                if constexpr (Engine::M::moves) p.put(rest_position, i, x[i]), p.put(part, i, of[i]);
                else if constexpr (requires { system_.boundary().sliding(x[i]); })
                    if constexpr (B::has_velocity) p.put(velocity, i, system_.boundary().sliding(x[i]));
                begin(p, i, Box<dim>{x[i], x[i]}, nullptr);
            }
            set_mass(system_.boundary().spacing());
            if constexpr (Engine::M::moves) move_markers(0);
        }
    }
    /// Puts the walls where their laws say that they are now. Their acceleration is the mean over the step to come, so that
    /// the integrator, which moves them within the step, ends with the velocity of the law.
    Extremes move_markers(double dt)
    {
        if constexpr (Engine::M::moves) {
            auto& boundary = system_.boundary();
            boundary.move_to(time_);
            const auto now = boundary.motions(time_), then = boundary.motions(time_ + dt);
            auto& p = system_.template species<1>().particles;
            const std::size_t n = p.size();
            system_.backend().for_each((n + Engine::task - 1) / Engine::task, [&](std::size_t k) {
                for (std::size_t i = k * Engine::task, end = std::min(n, (k + 1) * Engine::task); i < end; ++i) {
                    const Point x0 = p.at(rest_position, i);
                    const auto which = std::size_t(p.at(part, i));
                    const Point v = now[which].velocity_of(x0);
                    Point x = now[which].position_of(x0) - p.at(position, i);
                    p.put(position, i, p.at(position, i) + nearest_image(x, system_.grid()));
                    p.put(velocity, i, v + boundary.sliding(x0));
                    p.put(acceleration, i,
                          dt > 0 ? (1 / dt) * (then[which].velocity_of(x0) - v) : now[which].acceleration_of(x0));
                }
            });
            return system_.wall_extremes();
        }
        else return {};
    }
    /// Markers whose density is a state start at that of the fluid before them.
    template <class Start>
    [[gnu::cold]] void wet_markers([[maybe_unused]] Box<dim> const& box, [[maybe_unused]] Start start)
    {
        if constexpr (at_rest<Start>) {
            auto& p = system_.template species<1>().particles;
            const Box<dim> near = box.grown(physics().interaction.range());
            for (std::size_t i = 0; i < p.size(); ++i)
                if (near.contains(p.at(position, i))) begin(p, i, box, start);
        }
    }
    void look_at_bounces()
    {
        if constexpr (!requires { I::reflects; }) // else they are those of now
            if (system_.bounced()) system_.forget_kick_rates();
        if (system_.lost()) together(system_.ranks(), [&] { stop_lost(); });
    }
    /// Walls of contact that move are, in this step, where they are when the integrator takes its last rates.
    void move_contacts()
    {
        const double t = time_ + I::ahead_velocity * dt_;
        auto move = [&](auto& term) {
            if constexpr (requires { term.move_to(t); }) term.move_to(t);
        };
        detail::each_in(system_.terms(), move);
    }
    static double radius_of([[maybe_unused]] auto const& p, [[maybe_unused]] std::size_t i)
    {
        if constexpr (std::remove_cvref_t<decltype(p)>::template has<Radius>) return p.at(radius, i);
        else return 0;
    }
    [[gnu::cold]] void stop_lost() const
    {
        auto const& p = system_.mobile();
        const std::size_t i = detail::first_by_id(p, [&](std::size_t k) {
            Point x = p.at(position, k), v = p.at(velocity, k);
            return system_.boundary().reflect(x, v, radius_of(p, k)) != B::Bounce::none;
        });
        if constexpr (!Engine::alone)
            if (i == p.size()) return; // it is another rank's
        StopFacts f = i < p.size() ? detail::facts_of(p, i) : StopFacts{};
        f.step = step_, f.time = time_, f.quantity = "the bounces off two walls in one step", f.limit = B::bounces;
        f.value = std::numeric_limits<double>::infinity();
        throw OutOfDomain(f);
    }
    [[gnu::cold]] void check_particles() const
    {
        auto const& p = system_.mobile();
        using Q = std::remove_cvref_t<decltype(p)>;
        const std::size_t i = detail::first_by_id(p, [&](std::size_t k) {
            bool bad = false;
            for_each(Q::fields & Fields{position, velocity, density, mass, radius}, [&](auto f) {
                for (auto const& a : p.column(f)) bad = bad || !std::isfinite(double(a[k]));
            });
            return bad;
        });
        if (i < p.size()) {
            const auto [name, value] = detail::not_finite(p, i);
            detail::refuse_particle(name, p.id()[i], value, "a finite number");
        }
        for_each(Q::fields & Fields{density, mass}, [&]<class F>(F f) {
            const std::size_t k = detail::first_by_id(p, [&](std::size_t j) { return !(p.at(f, j) > 0); });
            if (k < p.size()) detail::refuse_particle(F::name, p.id()[k], p.at(f, k), "above 0");
        });
        if constexpr (Set<Q::uniform>::template contains<Mass>)
            require(p.empty() || p.value(mass) > 0, "mass", p.value(mass),
                    "above 0 [kg]; the spacing of a fill sets it");
    }
    /// No particle starts beyond a wall, or is too large for the lists.
    [[gnu::cold]] void check_places(std::size_t first = 0) const
    {
        auto const& p = system_.mobile();
        using Q = std::remove_cvref_t<decltype(p)>;
        const std::size_t i = detail::first_by_id(p, [&](std::size_t k) {
            return k >= first && system_.boundary().template beyond<dim>(p.at(position, k)) > 0;
        });
        if (i < p.size())
            throw BadInput("position of particle " + std::to_string(p.id()[i]),
                           text(system_.boundary().template beyond<dim>(p.at(position, i))) + " m beyond a wall",
                           "inside the walls");
        const double most = system_.farthest(); // beyond, forces are noise
        for (std::size_t k = 0; k < p.size(); ++k)
            for (auto const& x : p.column(position))
                if (!(std::abs(x[k]) <= most))
                    detail::refuse_particle(position.name, p.id()[k], x[k],
                                            "at most " + text(most) +
                                                " m from the origin: there rounding is a hundredth of the particles' "
                                                "length");
        if constexpr (Set<Q::fields>::template contains<Radius> && requires { physics().interaction.largest; })
            for (std::size_t k = first; k < p.size(); ++k)
                if (!(p.at(radius, k) <= physics().interaction.largest))
                    detail::refuse_particle(radius.name, p.id()[k], p.at(radius, k),
                                            "at most the interaction's largest, " +
                                                text(physics().interaction.largest) + " m");
    }
    [[gnu::cold]] Grid<dim> make_grid() const
    {
        auto box = system_.boundary().template box<dim>();
        if (!box) {
            Point lo{};
            auto const& p = system_.mobile();
            for (std::size_t i = 0; i < p.size(); ++i)
                for (int c = 0; c < dim; ++c)
                    lo[c] = i == 0 ? p.at(position, i)[c] : std::min(lo[c], p.at(position, i)[c]);
            if constexpr (!Engine::alone) {
                constexpr double nowhere = std::numeric_limits<double>::infinity();
                const bool nobody = !system_.ranks().all(!p.empty(), agree::Or{});
                for (int c = 0; c < dim && !nobody; ++c)
                    lo[c] = system_.ranks().all(p.empty() ? nowhere : lo[c], agree::Least{});
            }
            box = Box<dim>{lo, lo};
        }
        return make_grid(*box);
    }
    void rebuild(bool wide = false)
    {
        looked_ = false;
        try {
            system_.rebuild(wide);
        }
        catch (IndexOverflow const& e) {
            StopFacts f = e.facts();
            f.species = Engine::M::moves ? -1 : 0; // at rest, markers cannot be it
            throw IndexOverflow(seen_now(f));
        }
        catch (NeighbourOverflow const& e) {
            throw NeighbourOverflow(seen_now(e.facts()));
        }
    }
    /// With the step and the velocity of the particle that sorting or listing has stopped at.
    [[gnu::cold]] StopFacts seen_now(StopFacts f) const
    {
        f.step = step_, f.time = time_;
        auto const& p = system_.mobile();
        const std::size_t i = detail::first_by_id(p, [&](std::size_t k) { return p.id()[k] == f.particle; });
        if (f.species == 0 && i < p.size()) {
            const StopFacts all = detail::facts_of(p, i);
            std::copy(std::begin(all.velocity), std::end(all.velocity), f.velocity);
        }
        return f;
    }
    [[gnu::cold]] void begin_run(RunOptions const& o)
    {
        if (resumed_ && step_ > 0 && (o.cfl != cfl_ || o.dt != fixed_dt_))
            report_.warnings.push_back("the run goes on with cfl " + text(o.cfl) + " and dt " + text(o.dt) +
                                       " s, before the checkpoint it had " + text(cfl_) + " and " + text(fixed_dt_) +
                                       " s: it is another run from here");
        resumed_ = false, cfl_ = o.cfl, fixed_dt_ = o.dt;
        if (step_ > 0) return;
        stiffness_ = stiffness_of_all();
        hold_bodies();
        if (o.dt > 0) return;
        const TimeStep t = time_step(stiffness_, o.cfl, 0, std::sqrt(g_.squaredNorm()));
        require(std::isfinite(t.dt), "dt", o.dt, "above 0: the model has no criterion that bounds the step");
    }
    /// The least value among the particles of what contacts depend on; 0 where they don't carry it.
    [[gnu::cold]] [[nodiscard]] double least([[maybe_unused]] auto field) const
    {
        auto const& p = system_.mobile();
        if constexpr (!std::remove_cvref_t<decltype(p)>::template has<decltype(field)>) return 0;
        else if constexpr (Set<P::uniform>::template contains<decltype(field)>) return p.value(field);
        else {
            double x = p.empty() ? 1 : p.at(field, 0);
            for (std::size_t i = 0; i < p.size(); ++i) x = std::min(x, p.at(field, i));
            if constexpr (!Engine::alone) {
                const double nobody = std::numeric_limits<double>::infinity();
                const double least = system_.ranks().all(p.empty() ? nobody : x, agree::Least{});
                return least < nobody ? least : x;
            }
            return x;
        }
    }
    /// What bounds the step of bodies that float.
    void hold_bodies()
    {
        if constexpr (Engine::M::floats) {
            static_assert(has_equation_of_state<P>, "spate: a body floats in a fluid; add an equation of state");
            auto const& eos = equation_of_state(physics());
            body_rate_ = system_.boundary().body_rate(physics().interaction, eos.rho0, eos.c0, stiffness_.viscosity);
        }
    }
    void choose_dt(RunOptions const& o, Extremes const& e)
    {
        if (step_ == 0) begin_run(o);
        TimeStep t;
        if (o.dt > 0) t = {o.dt, "fixed"};
        else {
            double push = std::max(e.acceleration, std::sqrt(g_.squaredNorm()));
            if constexpr (Engine::M::floats) push = std::max(push, system_.boundary().body_acceleration());
            t = time_step(stiffness_, o.cfl, std::max(e.speed, e.wall_speed), push);
            if constexpr (Engine::M::floats) t.bound(o.cfl / body_rate_, "body");
            if (step_ > 0) t.bound(1.1 * free_dt_, "growth");
            if (step_ == 0) first_dt_ = t.dt;
            if (t.dt < 1e-3 * first_dt_) stop_dt(t.dt);
        }
        free_dt_ = t.dt;
        if (step_ == 0) advise(t.dt, e);
        if (time_ + t.dt * (1 + 1e-9) >= o.until) t.bound(o.until - time_, "end");
        if (!std::isfinite(time_ + t.dt)) stop_time(time_ + t.dt);
        dt_ = t.dt, criterion_ = t.criterion;
    }
    /// Warns where theory predicts growth at this step.
    [[gnu::cold]] void advise(double dt, Extremes const& e)
    {
        double spacing = 0;
        if constexpr (has_equation_of_state<P>) {
            auto const& p = system_.mobile();
            if (!p.empty()) spacing = std::pow(p.at(mass, 0) / equation_of_state(physics()).rho0, 1.0 / dim);
            spacing = system_.ranks().all(spacing, agree::Most{});
            constexpr double most = 16; // spacings in a range: theory sums over the lattice
            if (const double in = physics().interaction.range() / spacing; spacing > 0 && !(in <= most)) {
                report_.warnings.push_back("the range of interaction is " + text(in) +
                                           " spacings: nothing is foretold of stability");
                spacing = 0;
            }
        }
        report_.stable = stable_step<I>(physics(), spacing, stiffness_, dt);
        for (auto& warning : advice<I>(physics(), spacing, stiffness_, dt, e.most_density / e.least_density))
            report_.warnings.push_back(warning);
        if constexpr (Engine::M::floats)
            if (dt * body_rate_ > 1)
                report_.warnings.push_back("dt = " + text(dt) + " s is more than a body of its mass bears, " +
                                           text(1 / body_rate_) + " s: take a smaller dt");
    }
    void after_step()
    {
        auto run = [&] { system_.template phase<When::after_step>(step_, [&] { make_lists_current(); }); };
        if constexpr (writes_energy) {
            bool due = false;
            auto ask = [&](auto const& term) {
                if constexpr (requires { term.writes_energy; }) due = due || step_ % term.every == 0;
            };
            detail::each_in(system_.terms(), ask);
            const double before = due ? energy().internal : 0;
            run();
            if (due) written_energy_ += energy().internal - before;
        }
        else run();
    }
    /// Whether the lists may miss a pair at the positions of a step of dt.
    [[nodiscard]] bool stale(Extremes const& e) const
    {
        return system_.stale(e, I::ahead_velocity * dt_, I::ahead_acceleration * dt_ * dt_);
    }
    /// A step by the criteria is as short as lists need it: what closes in faster than sound would outrun them.
    [[gnu::cold]] void shorten(Extremes const& e)
    {
        const double way = system_.closing(e, I::ahead_velocity * dt_, I::ahead_acceleration * dt_ * dt_);
        const double most = system_.neighbours().closed_in() * physics().interaction.range();
        if (!(way > most)) return;
        free_dt_ = dt_ *= 0.99 * most / way, criterion_ = "lists"; // ways grow with dt at least in proportion
        if constexpr (Engine::M::moves) move_markers(dt_);
    }
    /// Lists that do not last one step would miss pairs in silence.
    [[noreturn, gnu::cold]] void stop_outrun(Extremes const& e) const
    {
        StopFacts f;
        f.step = step_, f.time = time_, f.quantity = "the way that a pair may close in within one step, over the range";
        f.limit = system_.neighbours().closed_in();
        f.value = system_.closing(e, I::ahead_velocity * dt_, I::ahead_acceleration * dt_ * dt_) /
                  physics().interaction.range();
        throw SkinOutrun(f);
    }
    [[noreturn, gnu::cold]] void stop_dt(double dt) const
    {
        StopFacts f;
        f.step = step_, f.time = time_, f.quantity = "dt [s]", f.value = dt, f.limit = 1e-3 * first_dt_;
        throw DtCollapse(f);
    }
    [[noreturn, gnu::cold]] void stop_time(double next) const
    {
        StopFacts f;
        f.step = step_, f.time = time_, f.quantity = "the time of the next step [s]", f.value = next;
        f.limit = std::numeric_limits<double>::max();
        throw NonFinite(f);
    }
    /// A body may be lost where no particle feels it.
    void look_at_bodies() const
    {
        auto const& bodies = system_.boundary().bodies();
        for (int k = 0; k < bodies.count; ++k)
            if (!bodies[k].finite()) stop_body(k, bodies[k]);
    }
    [[noreturn, gnu::cold]] void stop_body(int k, auto const& body) const
    {
        StopFacts f;
        f.step = step_, f.time = time_, f.species = 1;
        f.quantity = "the state of body " + std::to_string(k) + ", or a square of its speed,";
        f.value = std::sqrt(body.state.velocity.squaredNorm()), f.limit = std::numeric_limits<double>::max();
        for (int c = 0; c < dim; ++c) f.position[c] = body.place()[c], f.velocity[c] = body.state.velocity[c];
        throw NonFinite(f);
    }
    void look(Extremes const& e)
    {
        if constexpr (has_equation_of_state<P>) {
            auto const& eos = equation_of_state(physics());
            report_.mach = std::max(report_.mach, e.speed / eos.c0);
            if (e.most_density > 0)
                report_.density_change =
                    std::max({report_.density_change, e.most_density / eos.rho0 - 1, 1 - e.least_density / eos.rho0});
        }
        if constexpr (W::on) {
            if (e.poison != 0)
                together(system_.ranks(), [&] {
                    stop_if_not_finite(system_.mobile(), step_, time_, [&]() -> Origin {
                        if constexpr (traces) return origin();
                        else return {};
                    });
                });
            if constexpr (Engine::M::floats) look_at_bodies();
            if constexpr (has_equation_of_state<P>)
                if (!(e.least_density > 0) || e.most_density > most_density()) {
                    look_outside(); // one that was thrown through a wall says more than those it passed
                    together(system_.ranks(), [&] { stop_of_density(system_.mobile(), most_density(), step_, time_); });
                }
        }
    }
    [[nodiscard]] double most_density() const
    {
        auto const& eos = equation_of_state(physics());
        if constexpr (requires { eos.most_compression; }) return eos.most_compression * eos.rho0;
        else return std::numeric_limits<double>::infinity();
    }
    /// Pairs that are too near.
    [[gnu::cold]] void look_at_start()
    {
        if constexpr (Engine::any_pairs && Engine::M::planner.meet(0, 0)) {
            const auto worst = deepest_pair(system_, watch_.overlap);
            together(system_.ranks(),
                     [&] { look_at_pairs(system_, worst, watch_.overlap, step_, time_, report_.warnings); });
        }
    }
    [[gnu::cold]] [[nodiscard]] double least_radius() const
    {
        auto const& p = system_.mobile();
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < p.size(); ++i) least = std::min(least, radius_of(p, i));
        return system_.ranks().all(least, agree::Least{});
    }
    /// Contacts begin within what two grains close in by in one step: a tenth of a radius is told, a radius is a stop.
    void look_at_way(Extremes const& e)
    {
        if (stiffness_.contact_frequency <= 0) return;
        if (step_ == 0) least_radius_ = least_radius();
        const double way = std::min(e.speed * dt_, system_.closing(e.unmoved(), dt_, 0)), r = least_radius_;
        if (way > 0.1 * r && !told_way_) warn_of_way(way);
        if (way > r) together(system_.ranks(), [&] { stop_way(way); });
    }
    [[gnu::cold]] void warn_of_way(double way)
    {
        told_way_ = true;
        report_.warnings.push_back("grains move by " + text(way / least_radius_) +
                                   " radii in a step at t = " + text(time_) +
                                   " s: contacts that begin deeper than a tenth are not resolved; take a smaller dt");
    }
    [[gnu::cold]] void stop_way(double way) const
    {
        auto const& p = system_.mobile();
        const double most = way / dt_;
        const std::size_t i = detail::first_by_id(
            p, [&](std::size_t k) { return p.at(velocity, k).squaredNorm() >= most * most * (1 - 1e-12); });
        if constexpr (!Engine::alone)
            if (i == p.size()) return; // it is another rank's
        StopFacts f = i < p.size() ? detail::facts_of(p, i) : StopFacts{};
        f.step = step_, f.time = time_, f.quantity = "the way of a grain in one step [m]", f.value = way;
        f.limit = least_radius_;
        throw OverlapTooDeep(f, "a contact would begin deeper than a radius, or be missed: take a smaller dt");
    }
    /// Remembers a state from which the steps until now can be run again: that of the last rebuild, as lists go with it, or
    /// a later one; integrators that save do so in each step.
    void keep_step()
    {
        constexpr std::size_t most = 100;
        if (I::saves || kept_rebuild_ != system_.rebuilds() || kept_dt_.size() >= most) {
            if constexpr (!I::saves) system_.keep();
            kept_dt_.clear();
            kept_rebuild_ = system_.rebuilds(), kept_step_ = step_, kept_time_ = time_;
        }
        kept_dt_.push_back(dt_);
    }
    /// Which term made a value that is not finite, found by running the steps since the kept state again; this state is put
    /// back afterwards.
    [[gnu::cold]] Origin origin()
    {
        if (kept_dt_.empty() || kept_rebuild_ != system_.rebuilds()) return {};
        const double time = time_;
        looked_ = false;
        Engine failed = system_;
        Origin found;
        try {
            found = origin_of_replay();
        }
        catch (Stop const&) {
        } // one that came before
        system_ = std::move(failed);
        time_ = time;
        return found;
    }
    [[gnu::cold]] Origin origin_of_replay()
    {
        if (!system_.restore()) return {};
        time_ = kept_time_;
        for (std::size_t k = 0; k < kept_dt_.size(); ++k) {
            const std::int64_t step = kept_step_ + std::int64_t(k);
            if constexpr (Engine::M::moves) move_markers(kept_dt_[k]);
            if (k > 0 || !I::saves) system_.template phase<When::before_step>(step, [] {});
            Replay<Engine> again(std::move(system_));
            integrator_.step(again, kept_dt_[k]);
            system_ = static_cast<Engine&&>(again);
            if (again.found()) return again.origin();
            if constexpr (Engine::reflects && !requires { I::reflects; }) system_.reflect();
            if constexpr (Engine::reflects) look_at_bounces();
            system_.template phase<When::after_step>(step, [] {});
            time_ += kept_dt_[k];
        }
        return {};
    }
    [[gnu::cold]] void final_look()
    {
        look(system_.extremes());
        if (!system_.stale(system_.extremes(), 0, 0)) look_at_energy(); // a rebuild here would wrap the last state
        look_outside();
    }
    [[gnu::cold]] void look_outside() const
    {
        together(system_.ranks(), [&] {
            stop_if_outside(system_.mobile(), system_.boundary(), physics().interaction.range(), step_, time_);
        });
    }
    /// By the number of the step and what has been found so far: a run that goes on from a checkpoint looks when it would have.
    [[nodiscard]] bool energy_due() const
    {
        if (step_ % watch_.energy_every != 0) return false;
        if (report_.energy_rise > watch_.warn / 2) return true;
        const auto look = std::uint64_t(step_ / watch_.energy_every), calm = std::uint64_t(watch_.calm);
        return look < calm ? look == 0 || std::has_single_bit(look) : look % calm == 0;
    }
    void look_at_energy()
    {
        if (driven()) return;
        const Energy e = energy();
        const double came = exchanged_.energy();
        if (report_.energy_reference == 0) {
            report_.start = e, came_at_start_ = came;
            report_.energy_reference = reference(e);
        }
        if (exchanged_.any()) report_.energy_reference = std::max(report_.energy_reference, reference(e));
        if (report_.energy_reference == 0) return;
        const double rise = (e.total() - report_.start.total() - (came - came_at_start_)) / report_.energy_reference;
        report_.energy_rise = std::max(report_.energy_rise, rise);
        if (rise > watch_.warn && !warned_) warn_of_energy(rise);
        // What is measured of a bounded scheme oscillates by a known amount.
        double allowed = watch_.stop;
        if constexpr (requires { I::energy_error(1.0); })
            allowed += I::energy_error(stiffness_.contact_frequency * dt_);
        if (!(rise <= allowed)) stop_energy(rise, allowed);
    }
    [[gnu::cold]] void warn_of_energy(double rise)
    {
        warned_ = true;
        report_.warnings.push_back("total energy has risen by " + text(100 * rise) + " % of its reference at step " +
                                   std::to_string(step_) + ", t = " + text(time_) + " s");
    }
    [[noreturn, gnu::cold]] void stop_energy(double rise, double allowed) const
    {
        StopFacts f;
        f.step = step_, f.time = time_, f.quantity = "the rise of total energy over its reference";
        f.value = rise, f.limit = allowed;
        throw EnergyRunaway(f);
    }
    /// Kinetic and stored energy at the start, or that of the fastest flow that the speed of sound was chosen for, c0/10.
    [[gnu::cold]] [[nodiscard]] double reference(Energy const& e) const
    {
        double r = e.kinetic + e.rotational;
        if constexpr (has_equation_of_state<P>) {
            const double u = equation_of_state(physics()).c0 / 10;
            auto const& p = system_.mobile();
            r = std::max(r, 0.5 * u * u * system_.sum([&](std::size_t i) { return p.at(mass, i); }));
        }
        else r += e.internal;
        return r;
    }

    I integrator_;
    W watch_;
    Engine system_;
    Vec<dim, double> g_;
    Stiffness stiffness_;
    RunReport report_;
    Exchanged<dim> exchanged_;
    double came_at_start_ = 0; ///< energy that particles had brought when the watch began [J]
    std::function<bool()> interrupted_ = [] { return false; };
    double time_ = 0, dt_ = 0, free_dt_ = 0, first_dt_ = 0, cfl_ = 0, fixed_dt_ = 0, written_energy_ = 0;
    std::string_view criterion_ = "none";
    std::int64_t step_ = 0;
    bool prepared_ = false, warned_ = false, stopped_ = false, resumed_ = false;
    bool looked_ = false; ///< the last step has seen the extremes of the state of now
    bool told_way_ = false;
    double least_radius_ = std::numeric_limits<double>::infinity(); ///< [m]
    std::vector<double> kept_dt_;                                   ///< of the steps since the kept state [s]
    std::int64_t kept_step_ = 0, kept_rebuild_ = -1;
    double kept_time_ = 0;                                                                          ///< [s]
    [[no_unique_address]] std::conditional_t<Engine::M::floats, double, std::tuple<>> body_rate_{}; ///< [1/s]
};

} // namespace spate
