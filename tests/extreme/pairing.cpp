// SPDX-License-Identifier: BSD-3-Clause
// X12 and X13: a lattice under tension, and one under pressure with many neighbours: what grows, how fast, and what holds
// particles apart.
#include "spate/spate.hpp"

#include "order/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace spate;
using Point = Vec<2, double>;

constexpr double rho0 = 1000, c0 = 20, dx = 0x1p-5;
constexpr int n = 20; // particles along a side of the period: 2.2 times the reach of the widest kernel here

/// Of the scene that runs: one type for both kernels, whose support is 2 h.
bool wendland = false;
struct EitherKernel {
    static constexpr int dim = 2;
    static constexpr double radius = 2;
    double h;

    [[nodiscard]] double sigma() const { return wendland ? WendlandC2<2>{h}.sigma() : CubicSpline<2>{h}.sigma(); }
    template <class V>
    static V f(V const& q)
    {
        if (wendland) return WendlandC2<2>::f(q);
        return CubicSpline<2>::f(q);
    }
    template <class V>
    static V g(V const& q)
    {
        if (wendland) return WendlandC2<2>::g(q);
        return CubicSpline<2>::g(q);
    }
};
struct Case {
    bool wendland;
    double smoothing;   ///< h over dx
    double compression; ///< rho over rho0
    double alpha = 0;
    double tension = 0; ///< of TensileCorrection; 0.2 by Monaghan
    double mach = 0;    ///< of Shifting
    int threads = 1;
    [[nodiscard]] double mass() const { return compression * rho0 * dx * dx; }
};

template <class Precision>
class Lattice {
public:
    /// \param begin  (id, x on the lattice) -> displacement, velocity, change of density
    template <class Begin>
    Lattice(Case const& c, Begin const& begin) : sim_(scene(c))
    {
        sim_.fill(box, dx, [&](auto& p, std::size_t i) {
            const Point x = p.at(position, i);
            const auto [by, v, change] = begin(int(p.id()[i]), x);
            p.put(position, i, x + by), p.put(velocity, i, v), p.put(density, i, c.compression * rho0 + change);
        });
        sim_.particles().value(mass) = c.mass();
    }
    void run(int steps, double dt) { sim_.run({.steps = steps, .dt = dt}); }
    void run(int steps) { sim_.run({.steps = steps, .cfl = 0.25}); }
    [[nodiscard]] std::uint64_t hash() const { return sim_.state_hash(); }
    [[nodiscard]] std::vector<Point> places() const
    {
        auto const& p = sim_.particles();
        std::vector<Point> x(p.size());
        for (std::size_t i = 0; i < p.size(); ++i) x[p.id()[i]] = p.at(position, i);
        return x;
    }
    /// The least distance of two particles over dx.
    [[nodiscard]] double nearest() const
    {
        const auto x = places();
        double least2 = 1e9;
        for (std::size_t i = 0; i < x.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) least2 = std::min(least2, wrapped(x[i] - x[j]).squaredNorm());
        return std::sqrt(least2) / dx;
    }
    static Point wrapped(Point d)
    {
        for (int c = 0; c < 2; ++c) d[c] -= n * dx * std::round(d[c] / (n * dx));
        return d;
    }

private:
    static constexpr Box<2> box{{{0, 0}}, {{n * dx, n* dx}}};
    static auto scene(Case const& c)
    {
        wendland = c.wendland;
        auto fluid = wcsph(EitherKernel{c.smoothing * dx}, Tait{rho0, c0}, Continuity<2>{}, PressureForce<2>{},
                           ArtificialViscosity{.alpha = c.alpha},
                           TensileCorrection{.tension = c.tension, .compression = c.tension / 20},
                           Shifting{.mach = c.mach, .cfl = 6 * 0.25});
        return Simulation(fluid, Leapfrog{}, Periodic(box), Threads{c.threads}, Precision{}, NoWatch{},
                          Neighbours{.skin = 0.05});
    }
    decltype(scene(Case{})) sim_;
};

/// A plane wave on the lattice and its growth by linear theory.
struct Mode {
    int a = 0, b = 0;   ///< k = 2 pi (a, b)/(n dx)
    double omega2 = 0;  ///< -(growth)^2 where negative [1/s^2]
    Point e{};          ///< direction of the displacement
    double density = 0; ///< its change over a displacement, a quarter of a wave behind [kg/m^4]

    [[nodiscard]] double phase(Point const& x) const
    {
        return 2 * std::numbers::pi * (a * (x[0] / dx - 0.5) + b * (x[1] / dx - 0.5)) / n; // 0 at the first point
    }
    [[nodiscard]] double growth() const { return std::sqrt(std::max(0.0, -omega2)); }
};
/// Small displacements xi of a lattice of density rho and pressure p, density by continuity:
///   xi'' = -(m^2 d(p/rho^2)/drho S S.xi + 2 m p/rho^2 T xi),
///   S = sum sin(k.x) grad W, T = sum (1 - cos(k.x)) grad grad W.
/// The slower of the two polarisations, or one that is known to be an eigenvector, of a wave without a change of density.
Mode mode_of(Case const& c, int a, int b, std::optional<Point> along = {})
{
    // grad W = G x, grad grad W = G + D x x, of h = dx = 1
    const auto shape = c.wendland ? lattice::wendland_c2<2>() : lattice::cubic<2>();
    const auto slope = [&](double q) {
        if (c.wendland) return q < 2 ? 7.5 * (1 - q / 2) * (1 - q / 2) : 0;
        return q < 1 ? 9 : q < 2 ? 12 / (q * q) - 3 : 0;
    };
    const double h = c.smoothing;
    double S[2] = {}, T[2][2] = {};
    lattice::each<2>(shape, h, [&](auto const& x, double r2, double G) {
        const double kx = 2 * std::numbers::pi * (a * x[0] + b * x[1]) / n, q = std::sqrt(r2) / h,
                     D = shape.sigma / std::pow(h, 6) * slope(q) / q;
        for (std::size_t k = 0; k < 2; ++k) {
            S[k] += std::sin(kx) * G * x[k];
            for (std::size_t l = 0; l < 2; ++l) T[k][l] += (1 - std::cos(kx)) * ((k == l ? G : 0) + D * x[k] * x[l]);
        }
    });
    const double rho = c.compression * rho0, p = Tait{rho0, c0}.pressure_of(rho), s = c.compression,
                 sound2 = c0 * c0 * std::pow(s, 6), m = rho; // of dx = 1
    double M[2][2];
    for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l)
            M[k][l] = (m * m * (sound2 - 2 * p / rho) / (rho * rho) * S[k] * S[l] + 2 * m * p / (rho * rho) * T[k][l]) /
                      (dx * dx);
    Mode mode{a, b};
    if (along) {
        mode.e = *along;
        for (int k = 0; k < 2; ++k)
            for (int l = 0; l < 2; ++l) mode.omega2 += mode.e[k] * M[k][l] * mode.e[l];
        return mode;
    }
    const double mean = 0.5 * (M[0][0] + M[1][1]), half = 0.5 * (M[0][0] - M[1][1]);
    mode.omega2 = mean - std::hypot(half, M[0][1]);
    mode.e = std::abs(M[0][1]) > 1e-9 * std::abs(mean) ? Point{{M[0][1], mode.omega2 - M[0][0]}}
             : half < 0                                ? Point{{1, 0}}
                                                       : Point{{0, 1}};
    mode.e = (1 / std::sqrt(mode.e.squaredNorm())) * mode.e;
    mode.density = -m * (S[0] * mode.e[0] + S[1] * mode.e[1]) / dx;
    return mode;
}
Mode fastest(Case const& c)
{
    Mode best{0, 0, 1e300};
    for (int a = 0; a <= n / 2; ++a)
        for (int b = -n / 2; b <= n / 2; ++b)
            if (a != 0 || b != 0)
                if (const Mode mode = mode_of(c, a, b); mode.omega2 < best.omega2) best = mode;
    return best;
}
/// The wave in a scene, and its size: what of the displacements is along it.
template <class Precision>
class Wave {
public:
    Wave(Case const& c, Mode const& mode, double amplitude)
        : mode_(mode), scene_(c, [&](int, Point const& x) {
              const double A = amplitude * dx, w = std::cos(mode.phase(x));
              return std::tuple{(A * w) * mode.e, (mode.growth() * A * w) * mode.e,
                                A * mode.density * std::sin(mode.phase(x))};
          })
    {
        for (Point const& x : scene_.places())
            lattice_.push_back({{(std::floor(x[0] / dx) + 0.5) * dx, (std::floor(x[1] / dx) + 0.5) * dx}});
    }
    [[nodiscard]] double size() const
    {
        const auto now = scene_.places();
        double sum = 0;
        for (std::size_t k = 0; k < now.size(); ++k)
            sum += Lattice<Precision>::wrapped(now[k] - lattice_[k]).dot(mode_.e) * std::cos(mode_.phase(lattice_[k]));
        return sum;
    }
    void run(int steps, double dt) { scene_.run(steps, dt); }

private:
    Mode mode_;
    Lattice<Precision> scene_;
    std::vector<Point> lattice_;
};
std::ostream& operator<<(std::ostream& out, Case const& c)
{
    return out << (c.wendland ? "Wendland C2" : "cubic spline") << ", h/dx " << c.smoothing << ", rho/rho0 "
               << c.compression << (c.tension > 0 ? ", tensile correction" : "") << (c.mach > 0 ? ", shifting" : "");
}

/// f(precision, amplitude of a small wave over dx, name): in float 1e-3 dx is 1e4 roundings of the density.
void in_both(auto const& f)
{
    f(Double{}, 1e-6, "double");
    f(Float{}, 1e-3, "float");
}
// The modes in which a lattice goes to pieces grow as linear theory has it, under tension and under pressure.
TEST(Pairing, X12X13GrowthIsThatOfLinearTheory)
{
    in_both([]<class Precision>(Precision, double amplitude, char const* real) {
        for (Case c : {Case{false, 1.3, 0.99}, Case{true, 1.3, 0.99}, Case{true, 2.0, 0.99}, Case{false, 1.3, 1.01},
                       Case{false, 1.6, 1.01}, Case{false, 2.0, 1.01}, Case{true, 1.3, 1.01}})
            for (int threads : {1, 2}) {
                c.threads = threads;
                const Mode mode = fastest(c);
                Wave<Precision> wave(c, mode, amplitude);
                const double before = wave.size(), dt = 0.1 * c.smoothing * dx / c0;
                const int steps = int(std::ceil(2 / (mode.growth() * dt))); // two e-folds
                wave.run(steps, dt);
                const double measured = std::log(wave.size() / before) / (steps * dt);
                EXPECT_NEAR(measured, mode.growth(), 0.05 * mode.growth()) << c << ", " << real;
                std::printf("  %s, %s: k = (%d, %d) along (%.2f, %.2f) grows by %.5f c0/dx, theory %.5f\n",
                            testing::PrintToString(c).c_str(), real, mode.a, mode.b, mode.e[0], mode.e[1],
                            measured * dx / c0, mode.growth() * dx / c0);
            }
    });
}
// The mode that tension makes grow swings under pressure, and the other way round: the sign of p decides (Swegle et al. 1995).
TEST(Pairing, X12TheSignOfThePressureDecides)
{
    in_both([]<class Precision>(Precision, double amplitude, char const* real) {
        for (bool kernel : {false, true}) {
            const Case pulled{kernel, 1.3, 0.99}, pressed{kernel, 1.3, 1.01};
            const Mode grows = fastest(pulled);
            const Mode swings = mode_of(pressed, grows.a, grows.b, grows.e);
            ASSERT_GT(swings.omega2, 0);
            Wave<Precision> wave(pressed, swings, amplitude);
            const double before = wave.size(), period = 2 * std::numbers::pi / std::sqrt(swings.omega2);
            const int steps = int(std::ceil(period / (0.1 * 1.3 * dx / c0)));
            wave.run(steps, period / steps);
            EXPECT_NEAR(wave.size(), before, 0.05 * before) << pressed << ", " << real;
        }
    });
}

/// The least distance of two particles over dx: of all times, and in the end.
struct Distances {
    double least = 1e9, last = 0;
    std::uint64_t hash = 0;
};
/// A lattice with noise of a twentieth of a spacing goes where it goes.
template <class Precision>
Distances relaxed(Case const& c, int steps)
{
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> noise(-0.05 * dx, 0.05 * dx);
    Lattice<Precision> scene(c, [&](int, Point const&) {
        const double x = noise(random), y = noise(random);
        return std::tuple{Point{{x, y}}, Point{}, 0.0};
    });
    Distances d;
    for (int k = 0; k < steps; k += 50) {
        scene.run(50);
        d.last = scene.nearest(), d.least = std::min(d.least, d.last);
    }
    d.hash = scene.hash();
    std::printf("  %s: nearest two %.3f dx at least, %.3f dx in the end\n", testing::PrintToString(c).c_str(), d.least,
                d.last);
    return d;
}
constexpr double monaghan = 0.2, flow = 0.1, alpha = 0.1;
constexpr double paired = 0.7; ///< dx; a lattice of triangles has 1.07

void under_tension(int steps)
{
    in_both([steps]<class Precision>(Precision, double, char const* real) {
        for (bool kernel : {false, true}) {
            EXPECT_LT(relaxed<Precision>({kernel, 1.3, 0.99, alpha}, steps).least, paired) << real;
            EXPECT_GT(relaxed<Precision>({kernel, 1.3, 0.99, alpha, monaghan}, steps).least, 0.5) << real;
            EXPECT_GT(relaxed<Precision>({kernel, 1.3, 0.99, alpha, 0, flow}, steps).least, 0.5) << real;
        }
    });
}
TEST(Pairing, X12TensionPairsAndIsControlled) { under_tension(1000); }
TEST(LongPairing, X12TensionIsControlledFor1e4Steps) { under_tension(10000); }

void under_pressure(int steps)
{
    in_both([steps]<class Precision>(Precision, double, char const* real) {
        for (double smoothing : {1.6, 1.8, 2.0}) {
            EXPECT_LT(relaxed<Precision>({false, smoothing, 1.01, alpha}, steps).last, paired) << real;
            EXPECT_GT(relaxed<Precision>({true, smoothing, 1.01, alpha}, steps).least, paired) << real;
            EXPECT_GT(relaxed<Precision>({false, smoothing, 1.01, alpha, 0, flow}, steps).least, paired) << real;
        }
    });
}
TEST(Pairing, X13TheCubicSplinePairsWendlandDoesNot) { under_pressure(2000); }
TEST(LongPairing, X13TheCubicSplinePairsWendlandDoesNot) { under_pressure(10000); }

TEST(Pairing, X12X13BitsAreThoseOfOneThread)
{
    in_both([]<class Precision>(Precision, double, char const*) {
        for (Case c : {Case{false, 1.3, 0.99, alpha, monaghan, flow}, Case{false, 1.8, 1.01, alpha}}) {
            const auto one = relaxed<Precision>(c, 200).hash;
            c.threads = 2;
            EXPECT_EQ(relaxed<Precision>(c, 200).hash, one) << c;
        }
    });
}

} // namespace
