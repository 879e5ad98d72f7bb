// SPDX-License-Identifier: BSD-3-Clause
// What the semi-discrete equations conserve to rounding, on any particles (numerics V05, A.3), and the symmetries of space
// that they have (V06): random states, 20 % jitter, 5 % noise of density, through the engine.
#include "oracle/dice.hpp"
#include "physics/one_of.hpp"

#include <spate/spate.hpp>

#include <gtest/gtest.h>

#include <numeric>

namespace {
using namespace spate;

constexpr double dx = 0.02, rho0 = 1000, c0 = 20;

/// A cluster on a jittered lattice, in random motion: a free one in Open{}, a full box in Periodic.
template <int Dim>
Box<Dim> block()
{
    Box<Dim> b{};
    for (int c = 0; c < Dim; ++c) b.hi[c] = (Dim == 2 ? 24 : 10) * dx;
    return b;
}
template <int Dim, class B, class... T>
auto random_state(B boundary, T... term)
{
    Simulation sim(physics(Smoothing<WendlandC2<Dim>>{{.h = 1.6 * dx}}, term...), ForwardEuler{}, boundary);
    oracle::Dice dice(12);
    sim.fill(block<Dim>(), dx, [&](auto& p, std::size_t i) {
        auto x = p.at(position, i), v = x;
        for (int c = 0; c < Dim; ++c) x[c] += dx * dice.real(-0.2, 0.2), v[c] = dice.real(-1, 1);
        p.put(position, i, x);
        p.put(velocity, i, v);
        const double noise = dice.real(-0.05, 0.05), mass_noise = dice.real(-0.05, 0.05);
        if constexpr (std::remove_cvref_t<decltype(p)>::template has<Density>) p.put(density, i, rho0 * (1 + noise));
        p.put(mass, i, rho0 * std::pow(dx, Dim) * (1 + mass_noise));
    });
    sim.system().rebuild();
    sim.system().rates(sim.system().all);
    return sim;
}

/// sum of m a along each axis over sum m |a|, the worst.
template <int Dim>
double momentum(auto const& p)
{
    double worst = 0;
    for (int c = 0; c < Dim; ++c) {
        ExactSum sum;
        double size = 0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const auto a = p.at(acceleration, i);
            sum.add(p.at(mass, i) * a[c]);
            size += p.at(mass, i) * std::sqrt(a.squaredNorm());
        }
        EXPECT_GT(size, 0);
        worst = std::max(worst, std::abs(sum.value()) / size);
    }
    return worst;
}
/// sum of m x (x) a - a (x) x, in each plane, over sum m |x| |a|, about the middle of the block.
template <int Dim>
double angular_momentum(auto const& p)
{
    double worst = 0;
    for (int c = 0; c < Dim; ++c)
        for (int d = 0; d < c; ++d) {
            ExactSum sum;
            double size = 0;
            for (std::size_t i = 0; i < p.size(); ++i) {
                const auto a = p.at(acceleration, i), x = p.at(position, i) - 0.5 * block<Dim>().hi;
                sum.add(p.at(mass, i) * (x[c] * a[d] - x[d] * a[c]));
                size += p.at(mass, i) * std::sqrt(x.squaredNorm() * a.squaredNorm());
            }
            worst = std::max(worst, std::abs(sum.value()) / size);
        }
    return worst;
}
/// The power of compression, sum of m p/rho^2 d rho/dt, and of acceleration, sum of m v . a: their sum over their sizes.
double energy(auto const& p)
{
    ExactSum internal, kinetic;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double rho = p.at(density, i), m = p.at(mass, i);
        internal.add(m * p.at(pressure, i) / (rho * rho) * p.at(density_rate, i));
        kinetic.add(m * p.at(velocity, i).dot(p.at(acceleration, i)));
    }
    EXPECT_NE(internal.value(), 0);
    return std::abs(internal.value() + kinetic.value()) / (std::abs(internal.value()) + std::abs(kinetic.value()));
}
/// sum of V d rho/dt over the sum of its sizes.
double volume_weighted(auto const& p)
{
    ExactSum sum;
    double size = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double x = p.at(mass, i) / p.at(density, i) * p.at(density_rate, i);
        sum.add(x), size += std::abs(x);
    }
    return std::abs(sum.value()) / size;
}
double rounding(auto const& p) { return 1e-14 * std::sqrt(double(p.size())); } // V05

template <class D>
class Conservation : public ::testing::Test {
public:
    static constexpr int dim = D::value;
    void note(const char* what, double x) { this->RecordProperty(what, std::to_string(x * 1e16) + "e-16"); }
};
using Dims = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Conservation, Dims);

constexpr Tait tait{.rho0 = rho0, .c0 = c0};

template <int Dim>
auto compressible(auto boundary, int continuity, int pressure) // of sigma 1 or 2
{
    return random_state<Dim>(boundary, tait, OneOf<Continuity<1>, Continuity<2>>{{}, continuity - 1},
                             OneOf<PressureForce<1>, PressureForce<2>>{{}, pressure - 1});
}

TYPED_TEST(Conservation, OfMomentaAndEnergyWithOneSigma)
{
    constexpr int dim = TestFixture::dim;
    auto check = [&](auto const& sim) {
        auto const& p = sim.particles();
        this->note("momentum", momentum<dim>(p));
        this->note("angular", angular_momentum<dim>(p));
        this->note("energy", energy(p));
        EXPECT_LE(momentum<dim>(p), rounding(p));
        EXPECT_LE(angular_momentum<dim>(p), rounding(p));
        EXPECT_LE(energy(p), 1e-13);
    };
    for (int sigma : {1, 2}) check(compressible<dim>(Open{}, sigma, sigma));
    check(random_state<dim>(Open{}, tait, SigmaContinuity{1.5, rho0}, SigmaPressure{1.5, rho0}));
}

TYPED_TEST(Conservation, OfMomentumButNotOfEnergyWithMixedSigma)
{
    constexpr int dim = TestFixture::dim;
    auto check = [&](auto const& sim) {
        auto const& p = sim.particles();
        EXPECT_LE(momentum<dim>(p), rounding(p));
        EXPECT_LE(angular_momentum<dim>(p), rounding(p));
        EXPECT_GT(energy(p), 1e-3);
        this->RecordProperty("energy", std::to_string(energy(p)));
    };
    check(compressible<dim>(Open{}, 1, 2));
    check(compressible<dim>(Open{}, 2, 1));
    check(random_state<dim>(Open{}, tait, Continuity<2>{}, SigmaPressure{1.5, rho0}));
    check(random_state<dim>(Open{}, tait, SigmaContinuity{1.5, rho0}, PressureForce<1>{}));
}

TYPED_TEST(Conservation, AcrossPeriodicFaces)
{
    constexpr int dim = TestFixture::dim;
    auto check = [&](auto const& sim) {
        auto const& p = sim.particles();
        this->note("momentum", momentum<dim>(p));
        this->note("energy", energy(p));
        EXPECT_LE(momentum<dim>(p), rounding(p));
        EXPECT_LE(energy(p), 1e-13);
    };
    for (int sigma : {1, 2}) check(compressible<dim>(Periodic(block<dim>()), sigma, sigma));
}

TYPED_TEST(Conservation, OfMomentumByViscosity)
{
    constexpr int dim = TestFixture::dim;
    auto of = [](int which) {
        using AnyViscosity = OneOf<ArtificialViscosity, MonaghanCleary<dim>, LaminarViscosity>;
        return random_state<dim>(Open{}, AnyViscosity{{{.alpha = 0.1, .c0 = c0}, {.mu = 1}, {.mu = 1}}, which});
    };
    auto artificial = of(0);
    auto const& a = artificial.particles();
    EXPECT_LE(momentum<dim>(a), rounding(a));
    EXPECT_LE(angular_momentum<dim>(a), rounding(a)) << "a central force";
    this->note("artificial", momentum<dim>(a));

    auto central = of(1);
    auto const& b = central.particles();
    EXPECT_LE(momentum<dim>(b), rounding(b));
    EXPECT_LE(angular_momentum<dim>(b), rounding(b)) << "a central force";
    this->note("monaghan_cleary", angular_momentum<dim>(b));
    double work_of_central = 0;
    for (std::size_t i = 0; i < b.size(); ++i)
        work_of_central += b.at(mass, i) * b.at(velocity, i).dot(b.at(acceleration, i));
    EXPECT_LT(work_of_central, 0);

    auto laminar = of(2);
    auto const& l = laminar.particles();
    EXPECT_LE(momentum<dim>(l), rounding(l));
    EXPECT_GT(angular_momentum<dim>(l), 1e-6) << "numerics A.4: the Morris form does not conserve it";
    this->note("laminar", momentum<dim>(l));

    double work_of_artificial = 0, work_of_laminar = 0; // both take energy from the motion
    for (std::size_t i = 0; i < a.size(); ++i)
        work_of_artificial += a.at(mass, i) * a.at(velocity, i).dot(a.at(acceleration, i));
    for (std::size_t i = 0; i < l.size(); ++i)
        work_of_laminar += l.at(mass, i) * l.at(velocity, i).dot(l.at(acceleration, i));
    EXPECT_LT(work_of_artificial, 0);
    EXPECT_LT(work_of_laminar, 0);
}

TYPED_TEST(Conservation, OfMomentaByTensileCorrection)
{
    constexpr int dim = TestFixture::dim;
    auto sim = random_state<dim>(Open{}, tait, TensileCorrection{});
    auto const& p = sim.particles();
    EXPECT_LE(momentum<dim>(p), rounding(p));
    EXPECT_LE(angular_momentum<dim>(p), rounding(p)) << "a central force";
    this->note("momentum", momentum<dim>(p));
}

TYPED_TEST(Conservation, OfMomentumByXsph) // of the velocity that positions follow
{
    constexpr int dim = TestFixture::dim;
    auto sim = random_state<dim>(Open{}, tait, Xsph{});
    auto const& p = sim.particles();
    for (int c = 0; c < dim; ++c) {
        ExactSum own, moving;
        double size = 0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            own.add(p.at(mass, i) * p.at(velocity, i)[c]);
            moving.add(p.at(mass, i) * p.at(transport_velocity, i)[c]);
            size += p.at(mass, i) * std::abs(p.at(transport_velocity, i)[c] - p.at(velocity, i)[c]);
        }
        EXPECT_GT(size, 0);
        EXPECT_LE(std::abs(own.value() - moving.value()) / size, rounding(p));
    }
}

TYPED_TEST(Conservation, OfMomentumByViscosityOfEachParticle)
{
    constexpr int dim = TestFixture::dim;
    auto sim = random_state<dim>(Open{}, VariableViscosity{.largest = 2});
    auto& p = sim.particles();
    oracle::Dice dice(3);
    for (std::size_t i = 0; i < p.size(); ++i) p.put(viscosity, i, dice.real(0, 2));
    sim.system().rates(sim.system().all);
    EXPECT_LE(momentum<dim>(p), rounding(p));
    EXPECT_GT(angular_momentum<dim>(p), 1e-6) << "as of laminar viscosity";
    this->note("momentum", momentum<dim>(p));
}

/// The diffusion of a pair is antisymmetric in V_i d rho_i: that sum is what it keeps.
TYPED_TEST(Conservation, OfTheVolumeWeightedSumByDensityDiffusion)
{
    constexpr int dim = TestFixture::dim;
    Vec<dim, double> g{};
    g[dim - 1] = -9.81;
    auto of = [&](int which, double curvature) {
        using AnyDiffusion = OneOf<MolteniColagrossi, Fourtakas<dim>>;
        const Fourtakas<dim> fourtakas{.delta = 0.1, .c0 = c0, .rho0 = rho0, .g = g, .curvature = curvature};
        return random_state<dim>(Open{}, AnyDiffusion{{{.delta = 0.1, .c0 = c0}, fourtakas}, which});
    };
    auto whole = of(0, 0);
    EXPECT_LE(volume_weighted(whole.particles()), rounding(whole.particles()));
    this->note("molteni", volume_weighted(whole.particles()));

    auto linear = of(1, 0);
    EXPECT_LE(volume_weighted(linear.particles()), rounding(linear.particles()));
    this->note("fourtakas", volume_weighted(linear.particles()));

    // With Tait's curvature rho_H(x_ij) is not odd: (gamma - 1)/2 s^2 of rho0 is left of a pair, s = g . x/c0^2.
    auto curved = of(1, 6);
    const double s = 9.81 * 3.2 * dx / (c0 * c0), left = 3 * s * s / 0.01; // against a noise of about a hundredth
    EXPECT_GT(volume_weighted(curved.particles()), rounding(curved.particles()));
    EXPECT_LE(volume_weighted(curved.particles()), left);
}

TYPED_TEST(Conservation, OfMomentaByContacts)
{
    constexpr int dim = TestFixture::dim;
    Simulation sim(physics(Round<dim>{0.7 * dx}, LinearSpring{.k = 1e4}), ForwardEuler{}, Open{});
    oracle::Dice dice(5);
    sim.fill(block<dim>(), dx, [&](auto& p, std::size_t i) {
        auto x = p.at(position, i);
        for (int c = 0; c < dim; ++c) x[c] += dx * dice.real(-0.2, 0.2);
        p.put(position, i, x);
        p.put(mass, i, dice.real(0.5, 2));
        p.put(radius, i, dx * dice.real(0.3, 0.7));
    });
    sim.system().rebuild();
    sim.system().rates(sim.system().all);
    auto const& p = sim.particles();
    EXPECT_LE(momentum<dim>(p), rounding(p));
    EXPECT_LE(angular_momentum<dim>(p), rounding(p));
    this->note("momentum", momentum<dim>(p));
}

// ---- the symmetries of space

template <int Dim>
struct State {
    std::vector<Vec<Dim, double>> x, v;
    std::vector<double> rho;
    std::vector<std::uint32_t> id;
    Vec<Dim, double> g{};
};
/// Coordinates and velocities are multiples of 2^-20: shifts and turns of them are exact.
template <int Dim>
State<Dim> state()
{
    oracle::Dice dice(8);
    auto exact = [](double a) { return std::round(a * 0x1p20) * 0x1p-20; };
    State<Dim> s;
    s.g[Dim - 1] = -9.75;
    const int n = Dim == 2 ? 16 : 8;
    const std::size_t count = std::size_t(std::pow(n, Dim) + 0.5);
    for (std::size_t k = 0; k < count; ++k) {
        Vec<Dim, double> x, v;
        std::size_t rest = k;
        for (int c = 0; c < Dim; ++c, rest /= std::size_t(n)) {
            x[c] = exact(dx * (double(rest % std::size_t(n)) + dice.real(-0.2, 0.2)));
            v[c] = exact(dice.real(-1, 1));
        }
        s.x.push_back(x), s.v.push_back(v);
        s.rho.push_back(rho0 * dice.real(0.95, 1.05));
        s.id.push_back(std::uint32_t(k));
    }
    return s;
}
template <int Dim>
auto scene(State<Dim> const& s)
{
    Simulation sim(physics(Smoothing<CubicSpline<Dim>>{{.h = 1.3 * dx}}, Uniform{mass, rho0 * std::pow(dx, Dim)}, tait,
                           Continuity<2>{}, PressureForce<2>{}, LaminarViscosity{.mu = 1},
                           ArtificialViscosity{.alpha = 0.05, .c0 = c0},
                           Fourtakas<Dim>{.delta = 0.1, .c0 = c0, .rho0 = rho0, .g = s.g, .curvature = 6},
                           Gravity<Dim>{s.g}),
                   RungeKutta2{}, Open{});
    for (std::size_t i = 0; i < s.x.size(); ++i) {
        sim.add(s.x[i], s.v[i]);
        sim.particles().put(density, i, s.rho[i]);
    }
    sim.particles().set_ids(s.id);
    sim.prepare();
    sim.system().rebuild();
    sim.system().rates(sim.system().all);
    return sim;
}
/// Acceleration and rate of density by id.
template <int Dim>
struct Rates {
    std::vector<Vec<Dim, double>> a;
    std::vector<double> rho;
    bool operator==(Rates const&) const = default;
};
template <int Dim>
Rates<Dim> rates(State<Dim> const& s)
{
    auto sim = scene(s);
    auto const& p = sim.particles();
    Rates<Dim> r{std::vector<Vec<Dim, double>>(p.size()), std::vector<double>(p.size())};
    for (std::size_t i = 0; i < p.size(); ++i) {
        r.a[p.id()[i]] = p.at(acceleration, i);
        r.rho[p.id()[i]] = p.at(density_rate, i);
    }
    return r;
}
/// Largest difference, each over the largest value.
template <int Dim>
double difference(Rates<Dim> const& a, Rates<Dim> const& b)
{
    double da = 0, sa = 0, dr = 0, sr = 0;
    for (std::size_t i = 0; i < a.a.size(); ++i) {
        da = std::max(da, (a.a[i] - b.a[i]).squaredNorm());
        sa = std::max(sa, a.a[i].squaredNorm());
        dr = std::max(dr, std::abs(a.rho[i] - b.rho[i]));
        sr = std::max(sr, std::abs(a.rho[i]));
    }
    EXPECT_GT(sa, 0);
    EXPECT_GT(sr, 0);
    return std::max(std::sqrt(da / sa), dr / sr);
}
constexpr double tolerance = 1e-13; // V06

template <class D>
class Symmetry : public Conservation<D> {};
TYPED_TEST_SUITE(Symmetry, Dims);

TYPED_TEST(Symmetry, UnderASteadyMotionIsExact)
{
    constexpr int dim = TestFixture::dim;
    const State<dim> s = state<dim>();
    State<dim> moving = s;
    for (auto& v : moving.v)
        for (int c = 0; c < dim; ++c) v[c] += 3.5 - 8 * c;
    EXPECT_TRUE(rates(s) == rates(moving)) << "differences of velocities are the same bits, so are the rates";
}

TYPED_TEST(Symmetry, UnderASteadyMotionOutlastsSteps)
{
    constexpr int dim = TestFixture::dim;
    constexpr double U = 3.5, dt = 1e-5;
    constexpr int steps = 20;
    const State<dim> s = state<dim>();
    State<dim> moving = s;
    for (auto& v : moving.v) v[0] += U;
    auto run = [](State<dim> const& start) {
        auto sim = scene(start);
        for (int k = 0; k < steps; ++k) sim.step({.dt = dt});
        State<dim> end = start;
        auto const& p = sim.particles();
        for (std::size_t i = 0; i < p.size(); ++i) {
            const auto k = p.id()[i];
            end.x[k] = p.at(position, i), end.v[k] = p.at(velocity, i), end.rho[k] = p.at(density, i);
        }
        return end;
    };
    const State<dim> a = run(s), b = run(moving);
    double worst = 0;
    for (std::size_t i = 0; i < a.x.size(); ++i) {
        worst = std::max(worst, std::abs(b.rho[i] / a.rho[i] - 1));
        for (int c = 0; c < dim; ++c) {
            worst = std::max(worst, std::abs(b.v[i][c] - a.v[i][c] - (c == 0 ? U : 0)) / U);
            worst = std::max(worst, std::abs(b.x[i][c] - a.x[i][c] - (c == 0 ? U * steps * dt : 0)) / dx);
        }
    }
    // Each step rounds x at its own place; stiff terms carry a difference e of x into the rates as c0^2 e/dx^2.
    EXPECT_LE(worst, 1e-12);
    this->note("worst", worst);
}

TYPED_TEST(Symmetry, UnderAQuarterTurn)
{
    constexpr int dim = TestFixture::dim;
    const State<dim> s = state<dim>();
    const auto r = rates(s);
    for (int from = 0; from < dim; ++from)
        for (int to = 0; to < dim; ++to) {
            if (from == to) continue;
            auto turn = [&](auto& vectors) {
                for (auto& x : vectors) {
                    const double t = x[from];
                    x[from] = -x[to], x[to] = t;
                }
            };
            State<dim> turned = s;
            std::vector<Vec<dim, double>> g{s.g};
            turn(turned.x), turn(turned.v), turn(g);
            turned.g = g[0];
            auto expected = r;
            turn(expected.a);
            const double d = difference(expected, rates(turned));
            EXPECT_LE(d, tolerance);
            this->note("worst", d);
        }
}

TYPED_TEST(Symmetry, UnderAMirror)
{
    constexpr int dim = TestFixture::dim;
    const State<dim> s = state<dim>();
    const auto r = rates(s);
    for (int axis = 0; axis < dim; ++axis) {
        State<dim> mirrored = s;
        auto expected = r;
        for (auto& x : mirrored.x) x[axis] = -x[axis];
        for (auto& v : mirrored.v) v[axis] = -v[axis];
        for (auto& a : expected.a) a[axis] = -a[axis];
        mirrored.g[axis] = -mirrored.g[axis];
        const double d = difference(expected, rates(mirrored));
        EXPECT_LE(d, tolerance);
        this->note("worst", d);
    }
}

TYPED_TEST(Symmetry, UnderPermutation)
{
    constexpr int dim = TestFixture::dim;
    const State<dim> s = state<dim>();
    const auto r = rates(s);
    oracle::Dice dice(1);
    std::vector<std::size_t> order(s.x.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    for (std::size_t k = order.size(); k > 1; --k)
        std::swap(order[k - 1], order[std::size_t(dice.integer(0, int(k) - 1))]);
    State<dim> shuffled = s, renamed = s;
    for (std::size_t k = 0; k < order.size(); ++k) {
        shuffled.x[k] = s.x[order[k]], shuffled.v[k] = s.v[order[k]], shuffled.rho[k] = s.rho[order[k]];
        shuffled.id[k] = std::uint32_t(order[k]);
        renamed.id[k] = std::uint32_t(order[k]);
    }
    EXPECT_TRUE(rates(shuffled) == r) << "sums run in the order (global bin, id), wherever a particle lies in memory";
    auto other = rates(renamed); // by the new names: another order of sums
    Rates<dim> back = other;
    for (std::size_t k = 0; k < order.size(); ++k) back.a[k] = other.a[order[k]], back.rho[k] = other.rho[order[k]];
    const double d = difference(r, back);
    EXPECT_LE(d, tolerance);
    EXPECT_GT(d, 0) << "the order of sums did change";
    this->note("worst", d);
}

} // namespace
