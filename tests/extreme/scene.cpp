// SPDX-License-Identifier: BSD-3-Clause
#include "scene.hpp"

namespace extreme {

using namespace spate;

namespace {

template <class S>
class Of : public Scene {
public:
    explicit Of(S&& scene) : sim_(std::move(scene)) {}
    std::size_t fill(Box<2> const& box) override
    {
        if constexpr (fluid) return sim_.fill(box, spacing);
        else return 0;
    }
    void add(Vec<2, double> x, Vec<2, double> v, double m, double r) override
    {
        const std::size_t i = sim_.add(x, v);
        auto& p = sim_.particles();
        if constexpr (!fluid) p.put(mass, i, m), p.put(radius, i, r);
        else {
            (void)r;
            double& own = p.value(mass);
            if (own == 0) own = m > 0 ? m : equation_of_state(sim_.physics()).rho0 * spacing * spacing;
        }
    }
    void run(RunOptions const& o, std::function<void()> const& after_step) override { sim_.run(o, Ear{after_step}); }
    std::vector<State> states() override
    {
        auto const& p = sim_.particles();
        std::vector<State> all(p.size());
        for (std::size_t i = 0; i < p.size(); ++i) {
            State& s = all[p.id()[i]];
            s.x = p.at(position, i), s.v = p.at(velocity, i), s.a = p.at(acceleration, i), s.mass = p.at(mass, i);
            if constexpr (fluid) s.rho = p.at(density, i), s.rho_rate = p.at(density_rate, i), s.p = p.at(pressure, i);
            else s.radius = p.at(radius, i);
        }
        return all;
    }
    void put(std::size_t id, State const& s) override
    {
        auto& p = sim_.particles();
        const auto i = std::size_t(std::find(p.id().begin(), p.id().end(), id) - p.id().begin());
        p.put(position, i, s.x), p.put(velocity, i, s.v);
        if constexpr (fluid) p.put(density, i, s.rho);
        else p.put(mass, i, s.mass), p.put(radius, i, s.radius);
    }
    void rates() override
    {
        sim_.make_lists_current();
        sim_.system().rates(sim_.system().all);
    }
    void current() override
    {
        sim_.prepare();
        sim_.make_lists_current();
    }
    [[nodiscard]] std::size_t size() const override { return sim_.particles().size(); }
    [[nodiscard]] double dt() const override { return sim_.dt(); }
    [[nodiscard]] double time() const override { return sim_.time(); }
    [[nodiscard]] std::int64_t steps() const override { return sim_.steps(); }
    [[nodiscard]] std::uint64_t hash() const override { return sim_.state_hash(); }
    [[nodiscard]] Energy energy() const override { return sim_.energy(); }
    [[nodiscard]] Vec<2, double> momentum() const override { return sim_.momentum(); }
    [[nodiscard]] RunReport const& report() const override { return sim_.report(); }

    double spacing = 0;

private:
    static constexpr bool fluid = S::Engine::M::mobile.template contains<Density>;
    struct Ear {
        std::function<void()> const& f;
        void begin(auto&) {}
        void step(auto&)
        {
            if (f) f();
        }
        void end(auto&) {}
    };
    S sim_;
};

template <class Precision>
std::unique_ptr<Scene> make_of(Setup const& s)
{
    chosen::integrator = s.integrator;
    auto whole = [&](auto physics, auto boundary) -> std::unique_ptr<Scene> {
        const Threads workers{s.threads, s.cell};
        Neighbours n = neighbours_for<std::remove_cvref_t<decltype(physics.interaction)>>();
        if (s.skin > 0) n.skin = s.skin;
        Simulation sim(physics, chosen::AnyIntegrator{}, boundary, workers, Precision{}, TracingWatch{s.watch}, n);
        auto scene = std::make_unique<Of<decltype(sim)>>(std::move(sim));
        scene->spacing = s.dx;
        return scene;
    };
    if (s.kind == Kind::grains) {
        auto grains = physics(Discs{s.largest}, LinearSpring{s.k}, Gravity<2>{s.g});
        if (s.periodic) return whole(grains, Walls(s.box, periodic(x_axis, y_axis)));
        return whole(grains, Walls(s.box));
    }
    auto water = wcsph(CubicSpline<2>{s.smoothing * s.dx}, Tait{s.rho0, s.c0}, Continuity<2>{}, PressureForce<2>{},
                       ArtificialViscosity{.alpha = s.alpha}, Gravity<2>{s.g});
    if (s.kind == Kind::walled) return whole(water, Bce(s.box, s.dx, ByContinuity{}));
    if (s.periodic) return whole(water, Periodic(s.box));
    return whole(water, Periodic(s.box, open(left, right, bottom, top)));
}
} // namespace

std::unique_ptr<Scene> make(Setup const& s)
{
    if (s.real == Real::float_) return make_of<Float>(s);
    return make_of<Double>(s);
}
bool finite(std::vector<State> const& all)
{
    for (auto const& s : all)
        for (double value : {s.x[0], s.x[1], s.v[0], s.v[1], s.rho})
            if (!std::isfinite(value)) return false;
    return true;
}

} // namespace extreme
