// SPDX-License-Identifier: BSD-3-Clause
// Each term of the library by hand: two particles, h = 1, x_i - x_j = (0.6, 0.8), so r = q = 1 and, with Wendland's C2
// kernel in the plane, grad W = G x with G = -7/(4 pi) 5/8. Then what a pair beyond the support adds: nothing, bit for bit.
#include "oracle/dice.hpp"

#include <spate/spate.hpp>

#include <gtest/gtest.h>

#include <cstring>
#include <functional>

namespace {
using namespace spate;
constexpr double pi = std::numbers::pi;

template <int Dim>
struct State {
    Vec<Dim, double> x{}, v{};
    double rho = 1000, p = 0, m = 1, r = 0.5, mu = 0.1;
};
template <class V, int Dim>
auto record(State<Dim> const& s)
{
    Record<Dim, V, Fields<Position, Velocity, Density, Pressure, Mass, Radius, Viscosity>> r;
    r[position] = broadcast<V>(s.x), r[velocity] = broadcast<V>(s.v);
    r[density] = V(s.rho), r[pressure] = V(s.p), r[mass] = V(s.m), r[radius] = V(s.r);
    r[viscosity] = V(s.mu);
    return r;
}
template <class V, int Dim>
using Sums = Record<Dim, V, Fields<Acceleration, DensityRate, Density, TransportVelocity, Crowding>>;

/// The geometry of a pair as an interaction gives it.
template <class V, class I>
auto geometry(I const& interaction, auto const& ri, auto const& rj)
{
    using R = std::remove_cvref_t<decltype(ri)>;
    const Record<I::dim, V, Fields<>> uniform;
    using Seen = View<std::remove_cv_t<decltype(I::reads)>, Fields<>, R, std::remove_cv_t<decltype(uniform)>, void>;
    return interaction.template pair<V>(Seen{ri, uniform, nullptr, {}}, Seen{rj, uniform, nullptr, {}});
}
/// What a term adds to i of a pair; it sees of i and j what it has declared, and no more.
template <class V, int Dim, class T>
Sums<V, Dim> add_pair(auto const& interaction, T const& term, State<Dim> const& i, State<Dim> const& j,
                      Sums<V, Dim> sums)
{
    const auto ri = record<V>(i), rj = record<V>(j);
    using R = std::remove_cv_t<decltype(ri)>;
    using U = Record<Dim, V, Fields<>>;
    const U uniform;
    const auto ij = geometry<V>(interaction, ri, rj);
    const View<std::remove_cvref_t<decltype(reads_j<T>())>, Fields<>, R, U, void> of_j{rj, uniform, nullptr, {}};
    using Readable = std::remove_cvref_t<decltype(reads_i<T>())>;
    using Addable = std::remove_cvref_t<decltype(adds<T>())>;
    if constexpr (requires { ij.mask; }) {
        View<Readable, Addable, R, U, Sums<V, Dim>, std::remove_cvref_t<decltype(ij.mask)>> of_i{ri, uniform, &sums,
                                                                                                 ij.mask};
        term(of_i, of_j, ij);
    }
    else {
        View<Readable, Addable, R, U, Sums<V, Dim>> of_i{ri, uniform, &sums, {}};
        term(of_i, of_j, ij);
    }
    return sums;
}
template <int Dim>
Sums<double, Dim> of_pair(auto const& interaction, auto const& term, State<Dim> const& i, State<Dim> const& j)
{
    Sums<double, Dim> zero;
    clear(zero);
    return add_pair<double>(interaction, term, i, j, zero);
}

const Smoothing<WendlandC2<2>> plane{{.h = 1}};
const double G = -7 / (4 * pi) * 5 / 8;
const State<2> i{.x = {{0.6, 0.8}}, .v = {{1, 2}}, .rho = 1100, .p = 500, .m = 3};
const State<2> j{.x = {{0, 0}}, .v = {{-1, 1}}, .rho = 900, .p = -300, .m = 2};
State<2> with_velocity(State<2> s, Vec<2, double> const& v)
{
    s.v = v;
    return s;
}

void expect_vector(Vec<2, double> const& a, double x, double y)
{
    const double size = std::hypot(x, y);
    EXPECT_NEAR(a[0], x, 1e-14 * size);
    EXPECT_NEAR(a[1], y, 1e-14 * size);
}
void expect_number(double a, double b) { EXPECT_NEAR(a, b, 1e-14 * std::abs(b)); }

TEST(Smoothing, GivesAPairItsGeometry)
{
    const auto ij = geometry<double>(plane, record<double>(i), record<double>(j));
    expect_vector(ij.x, 0.6, 0.8);
    expect_number(ij.r2, 1);
    EXPECT_EQ(ij.h, 1);
    expect_number(ij.w, 7 / (4 * pi) * 3 / 16);
    expect_number(ij.grad_w[0], 0.6 * G);
    expect_number(ij.grad_w[1], 0.8 * G);
    EXPECT_EQ(plane.range(), 2);
}

TEST(Continuity, OfTwoParticlesByHand) // v_ij . x = (2, 1) . (0.6, 0.8) = 2
{
    expect_number(of_pair(plane, Continuity<2>{}, i, j)[density_rate], 2 * 2 * G);
    expect_number(of_pair(plane, Continuity<1>{}, i, j)[density_rate], 1100 * (2.0 / 900) * 2 * G);
    EXPECT_LT(of_pair(plane, Continuity<2>{}, i, j)[density_rate], 0) << "who part thin out";
}

TEST(PressureForce, OfTwoParticlesByHand)
{
    const double two = -2 * (500.0 / (1100 * 1100) - 300.0 / (900 * 900)) * G;
    expect_vector(of_pair(plane, PressureForce<2>{}, i, j)[acceleration], 0.6 * two, 0.8 * two);
    const double one = -2 * 200.0 / (1100 * 900) * G;
    expect_vector(of_pair(plane, PressureForce<1>{}, i, j)[acceleration], 0.6 * one, 0.8 * one);
    EXPECT_GT(of_pair(plane, PressureForce<1>{}, i, j)[acceleration][0], 0) << "pressure pushes apart";
}

TEST(LaminarViscosity, OfTwoParticlesByHand) // x . grad W = G, mean density 1000
{
    const double f = 2 * 2 * 0.3 * G / (1000.0 * 1000 * 1.01);
    expect_vector(of_pair(plane, LaminarViscosity{.mu = 0.3}, i, j)[acceleration], f * 2, f * 1);
    const double bare = 2 * 2 * 0.3 * G / (1000.0 * 1000);
    expect_vector(of_pair(plane, LaminarViscosity{.mu = 0.3, .eps = 0}, i, j)[acceleration], bare * 2, bare * 1);
    expect_number((LaminarViscosity{.mu = 0.3}.kinematic_viscosity(1000, 1, 2)), 0.3e-3);
}

TEST(MonaghanCleary, OfTwoParticlesByHand) // v_ij . x = 2
{
    const double f = 2 * (2 * 4 * 0.3 / (1100.0 * 900)) * 2 / 1.01 * G;
    const MonaghanCleary<2> term{.mu = 0.3};
    expect_vector(of_pair(plane, term, i, j)[acceleration], 0.6 * f, 0.8 * f);
    EXPECT_LT(f, 0) << "who part are held";
    expect_number(term.kinematic_viscosity(1000, 1, 2), 3 * 0.3e-3);
}

TEST(VariableViscosity, OfTwoParticlesByHand) // x . grad W = G, mean density 1000
{
    State<2> thick = i, thin = j;
    thick.mu = 0.5, thin.mu = 0.1;
    const double f = 2 * (0.5 + 0.1) * G / (1000.0 * 1000 * 1.01);
    expect_vector(of_pair(plane, VariableViscosity{.largest = 1}, thick, thin)[acceleration], f * 2, f * 1);
    thick.mu = thin.mu = 0.3;
    const auto same = of_pair(plane, LaminarViscosity{.mu = 0.3}, i, j)[acceleration];
    expect_vector(of_pair(plane, VariableViscosity{.largest = 1}, thick, thin)[acceleration], same[0], same[1]);
}

TEST(SpeciesViscosity, IsLaminarViscosityOfOneRole)
{
    const auto all = of_pair(plane, LaminarViscosity{.mu = 0.3}, i, j)[acceleration];
    EXPECT_EQ(of_pair(plane, SpeciesViscosity<Role::mobile>{.mu = 0.3}, i, j)[acceleration], all);
    EXPECT_EQ(of_pair(plane, SpeciesViscosity<Role::marker>{.mu = 0.3}, i, j)[acceleration], all);
    EXPECT_EQ(between<SpeciesViscosity<Role::marker>>().source, Role::marker);
    EXPECT_EQ(between<SpeciesViscosity<Role::marker>>().target, Role::mobile);
}

TEST(TensileCorrection, OfTwoParticlesByHand) // W(1)/W(1/2), by f: (1/2)^4 3 / ((3/4)^4 2)
{
    TensileCorrection term;
    EXPECT_TRUE(term.open());
    term.complete(0.5, plane);
    EXPECT_FALSE(term.open());
    const double f = std::pow(3.0 / 16 / (81.0 / 128), 4);
    const double pull = -2 * 0.2 * (300.0 / (900.0 * 900)) * f * G; // only j is under tension
    expect_vector(of_pair(plane, term, i, j)[acceleration], 0.6 * pull, 0.8 * pull);
    EXPECT_GT(pull, 0) << "it pushes apart";
    State<2> pressed = j, torn = i;
    pressed.p = 700, torn.p = -100;
    const double push = -2 * 0.01 * (500.0 / (1100 * 1100) + 700.0 / (900 * 900)) * f * G;
    expect_vector(of_pair(plane, term, i, pressed)[acceleration], 0.6 * push, 0.8 * push);
    const double both = -2 * 0.2 * (100.0 / (1100 * 1100) + 300.0 / (900 * 900)) * f * G;
    expect_vector(of_pair(plane, term, torn, j)[acceleration], 0.6 * both, 0.8 * both);
}

TEST(Xsph, OfTwoParticlesByHand) // mean density 1000, v_j - v_i = -(2, 1)
{
    const double k = 0.5 * 2 * 7 / (4 * pi) * 3 / 16 / 1000;
    expect_vector(of_pair(plane, Xsph{.eps = 0.5}, i, j)[transport_velocity], -2 * k, -k);
}

TEST(Shifting, OfTwoParticlesByHand) // W(1)/W(1/2) as of the tensile correction
{
    CrowdingSum term{.repulsion = 0.2};
    EXPECT_TRUE(term.open());
    term.complete(0.5, plane);
    const double s = (1 + 0.2 * std::pow(3.0 / 16 / (81.0 / 128), 4)) * 2 / 2000 * G;
    expect_vector(of_pair(plane, term, i, j)[crowding], 0.6 * s, 0.8 * s);
    EXPECT_LT(s, 0) << "towards the other; the shift is against it";
}

TEST(SummationDensity, OfTwoParticlesByHand)
{
    expect_number(of_pair(plane, SummationDensity{}, i, j)[density], 2 * 7 / (4 * pi) * 3 / 16);
    EXPECT_TRUE(has_self<SummationDensity>);
}

TEST(ArtificialViscosity, ActsOnApproachingPairsOnly)
{
    const ArtificialViscosity nu{.alpha = 0.02, .c0 = 30};
    EXPECT_EQ(of_pair(plane, nu, i, j)[acceleration], (Vec<2, double>{})) << "i and j part";
    const double mu = -2 / 1.01, Pi = -0.02 * 30 * mu / 1000;
    const double a = -2 * Pi * G;
    expect_vector(of_pair(plane, nu, with_velocity(i, {{-3, 0}}), j)[acceleration], a * 0.6, a * 0.8);
    EXPECT_GT(a, 0) << "against the approach";
    expect_number(nu.kinematic_viscosity(1000, 0.1, 2), 0.02 * 30 * 0.1 / 8);
    expect_number(nu.kinematic_viscosity(1000, 0.1, 3), 0.02 * 30 * 0.1 / 10);
}

TEST(MolteniColagrossi, OfTwoParticlesByHand)
{
    const double expected = 0.1 * 1 * 30 * (2.0 / 900) * 2 * 200 / 1.01 * G;
    expect_number(of_pair(plane, MolteniColagrossi{.delta = 0.1, .c0 = 30}, i, j)[density_rate], expected);
    EXPECT_LT(expected, 0) << "the denser one loses";
}

TEST(Fourtakas, OfTwoParticlesByHand)
{
    const double c = 30, s = -9 * 0.8 / (c * c); // g . x / c0^2
    for (double gamma : {1.0, 7.0}) {
        const double rho_H = 1000 * (std::pow(1 + gamma * s, 1 / gamma) - 1);
        const double expected = 0.1 * 1 * c * (2.0 / 900) * 2 * (200 - rho_H) / 1.01 * G;
        const double left_out = 65 * std::pow(s, 4) / (1 - 7 * std::abs(s)); // coefficients grow less than sevenfold
        const double series = 0.1 * c * (2.0 / 900) * 2 * 1000 * left_out / 1.01 * -G;
        const Fourtakas<2> term{.delta = 0.1, .c0 = c, .rho0 = 1000, .g = {{0, -9}}, .curvature = gamma - 1};
        EXPECT_NEAR(of_pair(plane, term, i, j)[density_rate], expected, 1e-14 * -expected + (gamma > 1 ? series : 0));
    }
    const Fourtakas<2> at_rest{.delta = 0.1, .c0 = c, .rho0 = 1000, .g = {{0, 0}}, .curvature = 6};
    EXPECT_EQ(of_pair(plane, at_rest, i, j)[density_rate],
              of_pair(plane, MolteniColagrossi{.delta = 0.1, .c0 = c}, i, j)[density_rate])
        << "without gravity it is Molteni and Colagrossi's";
}

/// i at a depth under the surface particle j: the hydrostatic pressure of i is rho0 g . x_ij.
double hydrostatic_rate(auto const& eos, double curvature, double depth_over_c2, double& scale)
{
    const double c = eos.c0, g = depth_over_c2 * c * c / 0.8; // x_ij = (0.6, -0.8)
    const State<2> below{.x = {{0.6, -0.8}}, .rho = eos.density_of(eos.rho0 * g * 0.8)};
    const State<2> above{.rho = eos.rho0};
    const Fourtakas<2> term{.delta = 0.1, .c0 = c, .rho0 = eos.rho0, .g = {{0, -g}}, .curvature = curvature};
    scale = 0.1 * c * (1 / eos.rho0) * 2 / 1.01 * -G; // of a difference of densities
    return of_pair(plane, term, below, above)[density_rate];
}
TEST(Fourtakas, LeavesOnlyTheSeriesErrorInAHydrostaticState)
{
    // (1 + 7 s)^(1/7) - 1 = s - 3 s^2 + 13 s^3 - 65 s^4 + 351 s^5 - ...: the term keeps three, so a difference of
    // densities of -65 rho0 s^4 is left.
    for (double s : {1e-2, 3e-3, 1e-3}) {
        double scale = 0;
        const double left = hydrostatic_rate(Tait{.rho0 = 1000, .c0 = 20}, 6, s, scale) / (scale * 1000);
        const double rounding = 1e-15; // of a density, relative
        EXPECT_NEAR(left, 65 * std::pow(s, 4), 351 * std::pow(s, 5) + rounding) << s;
    }
    double scale = 0;
    EXPECT_LE(std::abs(hydrostatic_rate(LinearEos{.rho0 = 1000, .c0 = 20}, 0, 1e-2, scale)) / scale, 1e-15 * 1000);
    const double p_over_B = 0.02; // as the header says
    EXPECT_LE(65 * std::pow(p_over_B / 7, 4), 1e-8);
}

TEST(Gravity, IsTheSameForAll)
{
    Sums<double, 3> sums;
    clear(sums);
    const auto r = record<double>(State<3>{});
    const Record<3, double, Fields<>> uniform;
    View<Fields<>, Fields<Acceleration>, decltype(r), decltype(uniform), Sums<double, 3>> view{r, uniform, &sums, {}};
    Gravity<3>{{{1, -2, 3}}}(view);
    EXPECT_EQ(sums[acceleration], (Vec<3, double>{{1, -2, 3}}));
}

TEST(LinearSpring, OfTwoDiscsByHand)
{
    const Discs discs{1};
    State<2> a = i, b = j; // distance 1
    a.r = 0.7, b.r = 0.4;  // overlap 0.1
    const double f = 50 * 0.1 / 3;
    const auto sum = of_pair(discs, LinearSpring{.k = 50}, a, b)[acceleration];
    EXPECT_NEAR(sum[0], 0.6 * f, 1e-14);
    EXPECT_NEAR(sum[1], 0.8 * f, 1e-14);
    b.r = 0.29;
    EXPECT_EQ(of_pair(discs, LinearSpring{.k = 50}, a, b)[acceleration], (Vec<2, double>{})) << "apart";
    b.r = 0.3;
    EXPECT_EQ(of_pair(discs, LinearSpring{.k = 50}, a, b)[acceleration], (Vec<2, double>{})) << "they only touch";
    expect_number((LinearSpring{.k = 50}.contact_frequency(2)), std::sqrt(50.0));
    Contact<2, double, bool> ij{.n = {}, .overlap = 0.1, .mask = true};
    expect_number((LinearSpring{.k = 50}.energy(ij)), 0.25);
}

// ---- equations of state

TEST(Tait, HasItsPressure)
{
    const Tait eos{.rho0 = 1000, .c0 = 50};
    for (long double s : {-0.05L, -1e-3L, -1e-7L, 1e-12L, 1e-9L, 1e-4L, 0.01L, 0.2L}) {
        const double rho = double(1000 * (1 + s));
        const long double exact_s = (static_cast<long double>(rho) - 1000) / 1000;
        const long double x = 1 + exact_s;
        const double expected = double(357142.857142857142857142857L * (x * x * x * x * x * x * x - 1));
        // long double loses 2^-64/s of x^7 - 1; the series keeps every digit of s that rho has
        const double allowed = std::abs(expected) * (1e-14 + 1e-18 / double(std::abs(exact_s)));
        EXPECT_NEAR(eos.pressure_of(rho), expected, allowed) << double(s);
    }
    EXPECT_EQ(eos.pressure_of(1000.0), 0);
    expect_number(eos.stiffness(), 1000 * 2500.0 / 7);
}

TEST(Tait, IsExactNearRestInFloat) // numerics A.2: (1 + s)^7 - 1 in float would be all error at s = 6e-8
{
    using V = Scalar<float>;
    const Tait eos{.rho0 = 1000, .c0 = 50};
    const auto p = [&](float rho) { return double(eos.pressure_of(V(rho)).b); };
    float rho = 1000;
    for (int n = 0; n < 60; ++n) {
        rho = std::nextafter(rho, 2000.f);
        if (n > 20) rho += 1e-5f * float(n * n * n * n);
        const double s = (double(rho) - 1000) / 1000;
        const double expected = eos.stiffness() * std::expm1(7 * std::log1p(s));
        EXPECT_NEAR(p(rho) / expected, 1, 8 * 6e-8) << "s = " << s; // eight roundings
    }
    EXPECT_EQ(p(1000.f), 0);
}

TEST(Tait, IsInverted)
{
    const Tait eos{.rho0 = 1000, .c0 = 50};
    for (double rho : {800.0, 950.0, 999.9999, 1000.0, 1000.0001, 1010.0, 1200.0})
        EXPECT_NEAR(eos.density_of(eos.pressure_of(rho)), rho, 2e-15 * rho + 1e-13) << rho;
    const double p = 12345;
    expect_number(eos.density_of(p), 1000 * std::pow(1 + p / eos.stiffness(), 1.0 / 7));
    using V = Scalar<float>;
    for (float rho : {950.f, 1000.f, 1010.f})
        EXPECT_NEAR(eos.density_of(eos.pressure_of(V(rho))).b, rho, 3 * 6e-8 * 1000);
    const Pack<double> packed = eos.density_of(Pack<double>(p));
    EXPECT_EQ(largest(packed), eos.density_of(p));
}

TEST(Tait, KnowsTheHydrostaticState) // numerics V19: p = B ((1 + 6 rho0 g z/(7 B))^(7/6) - 1)
{
    const Tait eos{.rho0 = 1000, .c0 = 10};
    const double gz = 0.01 * 100, B = eos.stiffness();
    const double p = eos.pressure_of(eos.hydrostatic_density(gz));
    EXPECT_NEAR(p, B * (std::pow(1 + 6 * 1000 * gz / (7 * B), 7.0 / 6) - 1), 1e-12 * p);
    EXPECT_NEAR(p / (1000 * gz), 1.004919, 5e-7);
    EXPECT_EQ(eos.hydrostatic_density(0), 1000);
}

TEST(LinearEos, HasItsPressureAndItsInverse)
{
    const LinearEos eos{.rho0 = 1000, .c0 = 20};
    expect_number(eos.pressure_of(1002.5), 400 * 2.5);
    expect_number(eos.density_of(-400.0), 999);
    EXPECT_EQ(eos.pressure_of(1000.0), 0);
    const LinearEos slow{.rho0 = 1000, .c0 = 10};
    const double gz = 0.01 * 100, p = slow.pressure_of(slow.hydrostatic_density(gz));
    EXPECT_NEAR(p / (1000 * gz), 1.005017, 5e-7); // (e^0.01 - 1)/0.01, numerics V19
}

/// e(rho) = integral of p/rho^2 from rho0, in long double by Simpson's rule.
long double energy_by_quadrature(auto const& eos, double rho)
{
    const int n = 2000;
    const long double a = eos.rho0, h = (static_cast<long double>(rho) - a) / n;
    auto f = [&](long double x) {
        const long double s = (x - a) / a;
        long double pressure;
        if constexpr (requires { eos.stiffness(); })
            pressure = eos.stiffness() * (s * (7 + s * (21 + s * (35 + s * (35 + s * (21 + s * (7 + s)))))));
        else pressure = static_cast<long double>(eos.c0) * eos.c0 * (x - a);
        return pressure / (x * x);
    };
    long double sum = f(a) + f(rho);
    for (int k = 1; k < n; ++k) sum += (k % 2 == 1 ? 4 : 2) * f(a + k * h);
    return sum * h / 3;
}
template <class E>
void expect_energy(E const& eos)
{
    for (double s : {-0.05, -0.002, -9e-4, -1e-5, 1e-7, 1e-4, 9.9e-4, 1.01e-3, 0.01, 0.1}) {
        const double rho = eos.rho0 * (1 + s), expected = double(energy_by_quadrature(eos, rho));
        // below 1e-3 by two terms of its series, so off by up to 3/2 s^2 (1 + 4/3 s); above by differences, by some eps/s^2
        const double off = std::abs(s) < 1e-3 ? 1.5 * s * s * (1 + 2 * std::abs(s)) + 1e-14 + 1e-15 / std::abs(s)
                                              : 1e-14 + 4e-15 / (s * s);
        EXPECT_NEAR(eos.energy_of(rho) / expected, 1, off) << s;
    }
    EXPECT_EQ(eos.energy_of(eos.rho0), 0);
}
TEST(Tait, KnowsItsCompressiveEnergy) { expect_energy(Tait{.rho0 = 1000, .c0 = 20}); }
TEST(LinearEos, KnowsItsCompressiveEnergy) { expect_energy(LinearEos{.rho0 = 1000, .c0 = 20}); }

TEST(EquationOfState, WritesThePressureOfAParticle)
{
    struct One {
        double rho, p = -1;
        double& operator[](Pressure) { return p; }
        double operator[](Density) const { return rho; }
    };
    One t{1010}, l{1010};
    Tait{.rho0 = 1000, .c0 = 20}(t);
    LinearEos{.rho0 = 1000, .c0 = 20}(l);
    expect_number(t.p, (Tait{.rho0 = 1000, .c0 = 20}.pressure_of(1010.0)));
    expect_number(l.p, 4000);
}

// ---- beyond the support

template <class V>
bool same_bits(V const& a, V const& b)
{
    alignas(64) scalar_t<V> x[std::size_t(width<V>)], y[std::size_t(width<V>)];
    store(x, a), store(y, b);
    return std::memcmp(x, y, sizeof x) == 0;
}
template <class V, int Dim>
using AddPair = std::function<Sums<V, Dim>(State<Dim> const&, State<Dim> const&, Sums<V, Dim> const&)>;

/// The sums before and after a pair at a distance: the sentinel's place, and just outside of the range.
template <class V, int Dim>
void expect_nothing_from(double range, AddPair<V, Dim> const& add)
{
    using T = scalar_t<V>;
    using Sentinel = Packed<Dim, T, Fields<Position>>;
    oracle::Dice dice(6);
    for (int trial = 0; trial < 40; ++trial) {
        auto draw = [&] {
            State<Dim> s;
            for (int c = 0; c < Dim; ++c) s.x[c] = dice.real(-3, 3), s.v[c] = dice.real(-20, 20);
            s.rho = dice.real(800, 1200), s.p = dice.real(-1e5, 1e6), s.m = dice.real(1e-6, 1e3);
            s.r = range / 2, s.mu = dice.real(0, 2);
            return s;
        };
        const State<Dim> target = draw();
        State<Dim> other = draw();
        if (trial % 2 == 0)
            for (int c = 0; c < Dim; ++c) other.x[c] = double(Sentinel::far);
        else {
            other.x = target.x;
            other.x[0] += range * dice.of(std::array{1 + 1e-5, 1.01, 2.0, 1e3}) + 1e-5;
        }
        Sums<V, Dim> before;
        clear(before);
        if (trial % 4 >= 2) {
            before[density_rate] = V(dice.real(-1, 1));
            before[density] = V(dice.real(500, 1500));
            for (int c = 0; c < Dim; ++c) before[acceleration][c] = V(dice.real(-1, 1));
        }
        const Sums<V, Dim> after = add(target, other, before);
        EXPECT_TRUE(same_bits(before[density_rate], after[density_rate])) << trial;
        EXPECT_TRUE(same_bits(before[density], after[density])) << trial;
        for (int c = 0; c < Dim; ++c) {
            EXPECT_TRUE(same_bits(before[acceleration][c], after[acceleration][c])) << trial;
            EXPECT_TRUE(same_bits(before[transport_velocity][c], after[transport_velocity][c])) << trial;
            EXPECT_TRUE(same_bits(before[crowding][c], after[crowding][c])) << trial;
        }
    }
}
template <class V, int Dim>
void expect_nothing(auto const& interaction, auto const& term)
{
    expect_nothing_from<V, Dim>(interaction.range(), [&](auto const& target, auto const& other, auto const& before) {
        return add_pair<V>(interaction, term, target, other, before);
    });
}
template <class V, class K>
void expect_nothing_of_all_terms()
{
    constexpr int Dim = K::dim;
    const Smoothing<K> smoothing{{.h = 0.013}};
    expect_nothing<V, Dim>(smoothing, Continuity<1>{});
    expect_nothing<V, Dim>(smoothing, Continuity<2>{});
    expect_nothing<V, Dim>(smoothing, PressureForce<1>{});
    expect_nothing<V, Dim>(smoothing, PressureForce<2>{});
    expect_nothing<V, Dim>(smoothing, LaminarViscosity{.mu = 1e-3});
    expect_nothing<V, Dim>(smoothing, LaminarViscosity{.mu = 1e-3, .eps = 0});
    expect_nothing<V, Dim>(smoothing, ArtificialViscosity{.alpha = 0.1, .c0 = 30});
    expect_nothing<V, Dim>(smoothing, MonaghanCleary<Dim>{.mu = 1e-3});
    expect_nothing<V, Dim>(smoothing, VariableViscosity{.largest = 2});
    expect_nothing<V, Dim>(smoothing, SpeciesViscosity<Role::mobile>{.mu = 1e-3});
    expect_nothing<V, Dim>(smoothing, SummationDensity{});
    TensileCorrection tensile;
    tensile.complete(0.01, smoothing);
    expect_nothing<V, Dim>(smoothing, tensile);
    expect_nothing<V, Dim>(smoothing, Xsph{});
    CrowdingSum crowd{.repulsion = 0.2};
    crowd.complete(0.01, smoothing);
    expect_nothing<V, Dim>(smoothing, crowd);
    for (double c0 : {1.0, 30.0, 1500.0}) { // slow sound makes rho_H of the sentinel large
        Vec<Dim, double> g{};
        g[Dim - 1] = -9.81;
        expect_nothing<V, Dim>(smoothing, MolteniColagrossi{.delta = 0.1, .c0 = c0});
        expect_nothing<V, Dim>(smoothing, Fourtakas<Dim>{.delta = 0.1, .c0 = c0, .rho0 = 1000, .g = g, .curvature = 6});
    }
}
template <class V>
class BeyondTheSupport : public ::testing::Test {};
using Values = ::testing::Types<double, Scalar<float>, Pack<double>, Pack<float>>;
TYPED_TEST_SUITE(BeyondTheSupport, Values);

TYPED_TEST(BeyondTheSupport, EveryTermAddsExactlyNothing)
{
    expect_nothing_of_all_terms<TypeParam, CubicSpline<2>>();
    expect_nothing_of_all_terms<TypeParam, CubicSpline<3>>();
    expect_nothing_of_all_terms<TypeParam, WendlandC2<1>>();
    expect_nothing_of_all_terms<TypeParam, WendlandC2<2>>();
    expect_nothing_of_all_terms<TypeParam, WendlandC2<3>>();
}
TYPED_TEST(BeyondTheSupport, AContactAddsExactlyNothing)
{
    expect_nothing<TypeParam, 2>(Round<2>{0.02}, LinearSpring{.k = 1e6});
    expect_nothing<TypeParam, 3>(Round<3>{0.02}, LinearSpring{.k = 1e6});
}

// ---- packs

TEST(Terms, GiveInPacksTheBitsOfScalars)
{
    oracle::Dice dice(9);
    using Both = std::pair<Sums<Pack<double>, 2>, Sums<double, 2>>;
    auto expect_same = [&](std::function<Both(State<2> const&, State<2> const&)> const& of) {
        for (int trial = 0; trial < 50; ++trial) {
            State<2> a = i, b = j;
            for (int c = 0; c < 2; ++c) a.x[c] = dice.real(-1.5, 1.5), a.v[c] = dice.real(-3, 3);
            const Both both = of(a, b);
            auto const& packed = both.first;
            auto const& scalar = both.second;
            EXPECT_TRUE(same_bits(packed[density_rate], Pack<double>(scalar[density_rate])));
            EXPECT_TRUE(same_bits(packed[density], Pack<double>(scalar[density])));
            for (int c = 0; c < 2; ++c) {
                EXPECT_TRUE(same_bits(packed[acceleration][c], Pack<double>(scalar[acceleration][c])));
                EXPECT_TRUE(same_bits(packed[transport_velocity][c], Pack<double>(scalar[transport_velocity][c])));
                EXPECT_TRUE(same_bits(packed[crowding][c], Pack<double>(scalar[crowding][c])));
            }
        }
    };
    Sums<Pack<double>, 2> zero;
    clear(zero);
    auto check = [&](auto const& term) {
        expect_same([&](State<2> const& a, State<2> const& b) {
            return Both{add_pair<Pack<double>>(plane, term, a, b, zero), of_pair(plane, term, a, b)};
        });
    };
    check(Continuity<1>{});
    check(Continuity<2>{});
    check(PressureForce<1>{});
    check(PressureForce<2>{});
    check(LaminarViscosity{.mu = 0.3});
    check(MonaghanCleary<2>{.mu = 0.3});
    check(VariableViscosity{.largest = 2});
    check(SummationDensity{});
    check(Xsph{});
    check(CrowdingSum{.repulsion = 0.2, .w_spacing = 0.5});
    check(TensileCorrection{.w_spacing = 0.5});
    check(ArtificialViscosity{.alpha = 0.1, .c0 = 20});
    check(MolteniColagrossi{.delta = 0.1, .c0 = 20});
    check(Fourtakas<2>{.delta = 0.1, .c0 = 20, .rho0 = 1000, .g = {{1, -9}}, .curvature = 6});
}

// ---- what a model completes

TEST(Wcsph, CompletesWhatTermsLeaveOpen)
{
    const auto water =
        wcsph(CubicSpline<2>{.h = 0.1}, Tait{.rho0 = 998, .c0 = 25}, Continuity<2>{}, DensityDiffusion{.delta = 0.2},
              PressureForce<2>{}, ArtificialViscosity{.alpha = 0.1}, Gravity<2>{{0, -9.81}});
    auto const& diffusion = std::get<Fourtakas<2>>(water.terms);
    EXPECT_EQ(diffusion.delta, 0.2);
    EXPECT_EQ(diffusion.c0, 25);
    EXPECT_EQ(diffusion.rho0, 998);
    EXPECT_EQ(diffusion.curvature, 6);
    EXPECT_EQ(diffusion.g, (Vec<2, double>{{0, -9.81}}));
    EXPECT_EQ(std::get<ArtificialViscosity>(water.terms).c0, 25);
    EXPECT_NO_THROW(water.check());
    const auto oil = wcsph(CubicSpline<2>{.h = 0.1}, LinearEos{.rho0 = 900, .c0 = 10}, MolteniColagrossi{.c0 = 7},
                           DensityDiffusion{});
    EXPECT_EQ(std::get<MolteniColagrossi>(oil.terms).c0, 7) << "what is given stays";
    EXPECT_EQ(std::get<Fourtakas<2>>(oil.terms).curvature, 0);
}

} // namespace
