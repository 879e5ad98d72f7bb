// SPDX-License-Identifier: BSD-3-Clause
// What each small part costs by itself: kernels, pair terms alone and fused, the stages of an evaluation, integrators.
#include "support/from_l1.hpp"
#include "support/scenes.hpp"

#include <string>

using namespace bench;

namespace {

/// Keeps a loop over single values from being made into packs: that would not be the scalar.
template <class V>
[[gnu::always_inline]] inline void one_by_one([[maybe_unused]] V& v)
{
    if constexpr (std::is_arithmetic_v<V>) asm volatile("" : "+m"(v));
    else if constexpr (width<V> == 1) asm volatile("" : "+m"(v.b));
}
template <class V>
void values(benchmark::State& state, auto const& f)
{
    using T = scalar_t<V>;
    constexpr std::size_t n = 1024, W = std::size_t(width<V>);
    Array<T> q(n), y(n);
    for (std::size_t k = 0; k < n; ++k) q[k] = T(2.2 * double(k) / n); // a support of 2, and a little beyond
    least(state, n, 100, [&] {
        for (std::size_t k = 0; k < n; k += W) {
            V x = load<V>(q.data() + k);
            one_by_one(x);
            store(y.data() + k, V(f(x)));
        }
        benchmark::ClobberMemory();
    });
}
void with_each_value(std::string const& name, auto const& f)
{
    auto one = [&]<class V>(V, std::string const& of) {
        benchmark::RegisterBenchmark((name + of).c_str(), [f](benchmark::State& s) { values<V>(s, f); })->MinTime(0.1);
    };
    one(double{}, "/double/scalar");
    one(Pack<double>{}, "/double/packs");
    one(Scalar<float>{}, "/float/scalar");
    one(Pack<float>{}, "/float/packs");
}
template <class K>
void kernel(std::string const& name)
{
    with_each_value("kernel/" + name + "/f", [](auto const& q) { return K::f(q); });
    with_each_value("kernel/" + name + "/g", [](auto const& q) { return K::g(q); });
}

template <class P>
void pair_terms(std::string const& name, P const& physics, double m)
{
    auto records = [&]<class Precision>(Precision, std::string const& of) {
        auto run = [=](benchmark::State& s) {
            FromL1<P, Open, Precision> l1(physics, Open{}, m);
            least(s, l1.pairs, 20, [&] { l1.on_records(); });
        };
        benchmark::RegisterBenchmark((name + of).c_str(), run)->MinTime(0.1);
    };
    auto packs = [&]<class Precision>(Precision, std::string const& of) {
        auto run = [=](benchmark::State& s) {
            FromL1<P, Open, Precision> l1(physics, Open{}, m);
            least(s, l1.pairs, 20, [&] { l1.on_packs(); });
        };
        benchmark::RegisterBenchmark((name + of).c_str(), run)->MinTime(0.1);
    };
    packs(Double{}, "/double/packs");
    records(Double{}, "/double/records");
    records(ScalarOf<Double>{}, "/double/scalar");
    packs(Float{}, "/float/packs");
    records(Float{}, "/float/records");
    records(ScalarOf<Float>{}, "/float/scalar");
}
void all_pair_terms()
{
    const double m = 1000 * dx * dx * dx;
    const LaminarViscosity laminar{.mu = 1e-3};
    const ArtificialViscosity artificial{.alpha = 0.1};
    const DensityDiffusion diffusion{.delta = 0.1};
    pair_terms("term/Continuity", water(1.2, Continuity<2>{}), m);
    pair_terms("term/PressureForce", water(1.2, PressureForce<2>{}), m);
    pair_terms("term/LaminarViscosity", water(1.2, laminar), m);
    pair_terms("term/ArtificialViscosity", water(1.2, artificial), m);
    pair_terms("term/SummationDensity", water(1.2, SummationDensity{}), m);
    pair_terms("term/MonaghanCleary", water(1.2, MonaghanCleary<3>{.mu = 1e-3}), m);
    pair_terms("term/VariableViscosity", water(1.2, VariableViscosity{.largest = 1e-3}), m);
    pair_terms("term/TensileCorrection", water(1.2, TensileCorrection{}).at(dx), m);
    pair_terms("term/Xsph", water(1.2, Xsph{}), m);
    pair_terms("term/SigmaContinuity", water(1.2, SigmaContinuity{1.5}), m);
    pair_terms("term/SigmaPressure", water(1.2, SigmaPressure{1.5}), m);
    pair_terms("term/DensityReinit by Shepard", water(1.2, DensityReinit<Shepard>{}), m);
    pair_terms("term/DensityReinit by Mls", water(1.2, DensityReinit<Mls>{}), m);
    pair_terms("term/Shifting", water(1.2, Shifting{.mach = 0.1}).at(dx), m);
    pair_terms("term/SurfaceShifting", water(1.2, SurfaceShifting{.mach = 0.1}).at(dx), m);
    pair_terms("term/DensityDiffusion", water(1.2, diffusion, Gravity<3>{{0, 0, -g}}), m);
    pair_terms("term/LinearSpring", dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}), 0.1);
    pair_terms("term/fused laminar", water(1.2, Continuity<2>{}, PressureForce<2>{}, laminar), m);
    pair_terms("term/fused dam break", dam_break_water(), m);
}

/// What a term adds to a fluid that has continuity and pressure force already, by the engine's own loop; the base is "none".
template <class P, class B = Open, int s = 0, int q = 0>
void added(std::string const& name, P const& physics, B const& boundary = {})
{
    auto run = [=]<class Precision>(Precision, std::string const& of) {
        auto time = [=](benchmark::State& state) {
            FromL1<P, B, Precision, s, q> l1(physics, boundary, 1000 * dx * dx * dx);
            least(state, l1.pairs, 20, [&] { l1.on_records(); });
        };
        benchmark::RegisterBenchmark(("added/" + name + of).c_str(), time)->MinTime(0.1);
    };
    run(Double{}, "/double");
    run(Float{}, "/float");
}
void all_added()
{
    auto fluid = [](auto... more) { return water(1.2, Continuity<2>{}, PressureForce<2>{}, more...); };
    added("none", fluid());
    added("LaminarViscosity", fluid(LaminarViscosity{.mu = 1e-3}));
    added("MonaghanCleary", fluid(MonaghanCleary<3>{.mu = 1e-3}));
    added("ArtificialViscosity", fluid(ArtificialViscosity{.alpha = 0.1}));
    added("MolteniColagrossi", fluid(MolteniColagrossi{.delta = 0.1}));
    added("DensityDiffusion", fluid(DensityDiffusion{.delta = 0.1}, Gravity<3>{{0, 0, -g}}));
    added("TensileCorrection", fluid(TensileCorrection{}).at(dx));
    added("Xsph", fluid(Xsph{}));
    const Box<3> box{{0, 0, 0}, {1, 1, 1}};
    const auto physics = fluid();
    auto walls = [&]<class Wall>(std::string const& name, Wall wall) {
        using B = decltype(Bce(box, dx, wall));
        added<std::remove_cv_t<decltype(physics)>, B, 1, 0>(name, physics, Bce(box, dx, wall));
    };
    walls("wall ByContinuity", ByContinuity{});
    walls("wall Adami", Adami{});
}

template <int Dim>
void selection(benchmark::State& state)
{
    constexpr int n = 512; // candidates
    std::mt19937 random(1);
    std::uniform_real_distribution<float> any(-1, 1);
    Array<float> x[std::size_t(Dim)];
    std::vector<std::int32_t> number(n), list(n + 16);
    float const* at[std::size_t(Dim)];
    const float origin[std::size_t(Dim)] = {};
    for (std::size_t c = 0; c < std::size_t(Dim); ++c) {
        x[c].resize(n);
        for (auto& y : x[c]) y = any(random);
    }
    for (int k = 0; k < n; ++k) number[std::size_t(k)] = k;
    std::int64_t within = 0;
    least(state, n, 200, [&] {
        int m = 0;
        for (int j = 0; j < n; j += 16) {
            for (std::size_t c = 0; c < std::size_t(Dim); ++c) at[c] = x[c].data() + j;
            m += select_near<Dim>(at, number.data() + j, n - j, origin, 1.0f, 0.8f, -1, list.data() + m, within);
        }
        benchmark::DoNotOptimize(m);
        benchmark::ClobberMemory();
    });
}
/// The stages of one evaluation and of a rebuild, ns a particle, on a block that leaves the second-level cache.
void stage(benchmark::State& state, std::string const& name)
{
    static auto sim = block(44, dam_break_water());
    auto& s = sim.system();
    const double n = double(s.total());
    SweepsOf sweeps(s);
    if (name == "equation of state") least(state, n, 1, [&] { s.refresh(); });
    else if (name == "sort") {
        auto particles = s.mobile();
        Binning<3> bins;
        least(state, n, 1, [&] { bins.sort(particles, s.grid()); });
    }
    else if (name == "list build") {
        Lists<3> lists;
        least(state, n, 1, [&] { build_lists(s, lists); });
    }
    else if (name == "rebuild") least(state, n, 1, [&] { s.rebuild(); });
    else if (name == "sweep") least(state, n, 1, [&] { sweeps.run(); });
    else if (name == "all rates") least(state, n, 1, [&] { s.rates(s.all); });
    else { // packing is no function of its own: what is left of an evaluation
        Least all, sweep, eos;
        for (auto _ : state)
            all.of([&] { s.rates(s.all); }), sweep.of([&] { sweeps.run(); }), eos.of([&] { s.refresh(); });
        state.counters["ns"] = all.ns(n) - sweep.ns(n) - eos.ns(n);
    }
    state.counters["pairs"] = double(s.pairs()) / n;
}
void stages()
{
    for (std::string name : {"sort", "list build", "rebuild", "equation of state", "pack", "sweep", "all rates"})
        benchmark::RegisterBenchmark(("stage/" + name).c_str(), [=](benchmark::State& s) {
            stage(s, name);
        })->MinTime(0.4);
    benchmark::RegisterBenchmark("selection/2D", selection<2>)->MinTime(0.1);
    benchmark::RegisterBenchmark("selection/3D", selection<3>)->MinTime(0.1);
}

/// A step of no time, so that the state stays: with all terms, and where gravity is the only one.
template <class I>
void integrator()
{
    auto time = [](benchmark::State& state, auto const& physics) {
        auto sim = block(12, physics, I{});
        least(state, double(sim.system().total()), 1, [&] { sim.integrator().step(sim.system(), 0); });
    };
    const std::string name = std::string("integrator/") + I::name;
    auto water_step = [=](benchmark::State& s) { time(s, dam_break_water()); };
    auto bare_step = [=](benchmark::State& s) {
        time(s, physics(Smoothing<CubicSpline<3>>{{.h = 1.2 * dx}}, Uniform{mass, 1e-3}, Gravity<3>{{0, 0, -g}}));
    };
    benchmark::RegisterBenchmark((name + "/dam_break").c_str(), water_step)->MinTime(0.1);
    benchmark::RegisterBenchmark((name + "/gravity").c_str(), bare_step)->MinTime(0.1);
}

[[maybe_unused]] const bool registered = [] {
    kernel<CubicSpline<3>>("CubicSpline");
    kernel<QuinticSpline<3>>("QuinticSpline");
    kernel<WendlandC2<3>>("WendlandC2");
    kernel<WendlandC4<3>>("WendlandC4");
    kernel<WendlandC6<3>>("WendlandC6");
    all_pair_terms();
    all_added();
    stages();
    integrator<ForwardEuler>();
    integrator<SymplecticEuler>();
    integrator<Leapfrog>();
    integrator<RungeKutta2>();
    return true;
}();

} // namespace
