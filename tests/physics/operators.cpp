// SPDX-License-Identifier: BSD-3-Clause
// Sums over the infinite lattice, through the engine, by terms that a user may write (numerics V02, V04): consistency,
// neighbour counts, the symbols of the first derivative and of the viscosity, and the order of smoothing.
#include "extreme/chosen.hpp"
#include "oracle/table.hpp"

#include <spate/spate.hpp>

#include <gtest/gtest.h>

namespace {
using namespace spate;

// clang-format off
inline constexpr struct Unity : ScalarField      { static constexpr std::string_view name = "unity"; static constexpr bool derived = true; } unity{};
inline constexpr struct Slope : VectorField      { static constexpr std::string_view name = "slope"; static constexpr bool derived = true; } slope{};
inline constexpr struct Near : ScalarField       { static constexpr std::string_view name = "near"; static constexpr bool derived = true; } near{};
inline constexpr struct Wave : ScalarField       { static constexpr std::string_view name = "wave"; } wave{};
inline constexpr struct Smoothed : ScalarField   { static constexpr std::string_view name = "smoothed"; static constexpr bool derived = true; } smoothed{};
inline constexpr struct Derivative : VectorField { static constexpr std::string_view name = "derivative"; static constexpr bool derived = true; } derivative{};
// clang-format on

/// S0 = sum_j V W, S_g = -sum_j V x dW/dx, and how many neighbours count; density is 1, so mass is volume.
struct Consistency {
    static constexpr Fields reads_j{mass};
    static constexpr Fields adds{unity, slope, near};
    static constexpr bool self = true;
    static constexpr When when = When::before_step;
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        i[unity] += j[mass] * ij.w;
        const auto V_grad_w = j[mass] * ij.grad_w;
        auto s = ij.x;
        for (int c = 0; c < int(std::size(s.c)); ++c) s[c] = -1 * (ij.x[c] * V_grad_w[c]);
        i[slope] += s;
        using V = std::remove_cvref_t<decltype(ij.w)>;
        i[near] += spate::where(ij.w > 0, V(1), V(0));
    }
};
/// <f>_i = sum_j V f W and its gradient.
struct Smooth {
    static constexpr Fields reads_j{mass, wave};
    static constexpr Fields adds{smoothed, derivative};
    static constexpr bool self = true;
    static constexpr When when = When::before_step;
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        i[smoothed] += j[mass] * j[wave] * ij.w;
        i[derivative] += (j[mass] * j[wave]) * ij.grad_w;
    }
};

/// A lattice in a periodic box of n[c] spacings, or as many more whole multiples of n[c] as the lists need; of the kernel in
/// hand, all of which share one scene type.
template <int Dim, class Precision>
auto lattice(double h_over_dx, double dx, std::array<int, 3> n, double viscosity_eps = 0.01)
{
    const Neighbours neighbours{.skin = 0.05};
    const double radius = chosen::support() * h_over_dx; // is the h of the kernel in hand, so eps h^2 has another eps
    const double eps = viscosity_eps / std::pow(chosen::support(), 2);
    const int least = int(std::ceil(2 * radius * (1 + neighbours.skin) * (1 + 1e-9)));
    Box<Dim> box{};
    for (int c = 0; c < Dim; ++c) {
        const int period = n[std::size_t(c)];
        box.hi[c] = (least + period - 1) / period * period * dx;
    }
    const double volume = std::pow(dx, Dim);
    const auto model = physics(Smoothing<chosen::AnyKernel<Dim>>{{.h = radius * dx}}, Uniform{mass, volume},
                               Uniform{density, 1}, Consistency{}, Smooth{}, LaminarViscosity{.mu = 1, .eps = eps});
    return Simulation(model, ForwardEuler{}, Periodic(box), Serial{}, Precision{}, Watch{}, neighbours);
}
template <int Dim>
void fill(auto& sim, double dx, auto const& start)
{
    sim.fill(sim.system().boundary().template box<Dim>().value(), dx, start);
    sim.system().rebuild();
    sim.system().template phase<When::before_step>(0, [] {});
}

template <int Dim, class P_>
struct Setting {
    static constexpr int dim = Dim;
    using P = P_;
};
template <class S>
class Lattice : public ::testing::Test {
public:
    using P = typename S::P;
    static constexpr int dim = S::dim;
    static constexpr bool in_double = std::same_as<P, Double>;

    /// Takes each kernel in hand; in float only one of each is more than compile time.
    static void each_kernel(auto const& test)
    {
        for (chosen::kernel = 0; chosen::kernel < 5; ++chosen::kernel)
            if (in_double || dim == 2 || chosen::kernel % 2 == 0) test();
    }
    /// The rows of the table for this kernel and dimension.
    static std::vector<oracle::Row> rows()
    {
        std::vector<oracle::Row> mine;
        for (auto const& r : oracle::table("kernel_lattice_constants.csv"))
            if (r.at("kernel") == chosen::kernels[chosen::kernel] && r.at("dim") == std::to_string(dim))
                mine.push_back(r);
        return mine;
    }
    static double number(oracle::Row const& r, std::string const& column) { return std::stod(r.at(column)); }
    /// The tolerance for a number of the table: no less than half of its last digit, of eleven.
    static double allowed(oracle::Row const& r, std::string const& column)
    {
        const double v = number(r, column), digit = v == 0 ? 0 : std::pow(10, std::floor(std::log10(std::abs(v))) - 10);
        return std::max(in_double ? 1e-12 : 2e-6, 0.5 * digit);
    }
};
template <class S>
class LatticeWaves : public Lattice<S> {}; // against numbers that a float does not resolve
template <class S>
class LatticeInFloat : public Lattice<S> {};
using InDouble = ::testing::Types<Setting<1, Double>, Setting<2, Double>, Setting<3, Double>>;
using InFloat = ::testing::Types<Setting<1, Float>, Setting<2, Float>, Setting<3, Float>>;
TYPED_TEST_SUITE(LatticeWaves, InDouble);
TYPED_TEST_SUITE(LatticeInFloat, InFloat);

/// The largest difference from the table, over what is allowed.
template <class This>
double sums_and_neighbours()
{
    constexpr int dim = This::dim;
    double worst = 0;
    This::each_kernel([&] {
        const auto rows = This::rows();
        EXPECT_EQ(rows.size(), 5u);
        for (auto const& row : rows)
            for (double dx :
                 {1.0, 0.01}) { // with 1, a neighbour exactly at the support is exactly there, and does not count
                auto sim = lattice<dim, typename This::P>(This::number(row, "h_over_dx"), dx, {1, 1, 1});
                fill<dim>(sim, dx, nullptr);
                auto const& p = sim.particles();
                const auto neighbours = std::size_t(This::number(row, "neighbours"));
                for (std::size_t i = 0; i < p.size(); ++i) {
                    worst = std::max(worst, std::abs(p.at(unity, i) - 1 - This::number(row, "S0_minus_1")) /
                                                This::allowed(row, "S0_minus_1"));
                    for (int c = 0; c < dim; ++c)
                        worst = std::max(worst, std::abs(p.at(slope, i)[c] - 1 - This::number(row, "Sgrad_minus_1")) /
                                                    This::allowed(row, "Sgrad_minus_1"));
                    if (dx == 1) {
                        EXPECT_EQ(std::size_t(p.at(near, i)), neighbours + 1) << "itself counts here";
                    }
                }
                if (dx == 1) {
                    EXPECT_EQ(std::size_t(sim.system().pairs()), neighbours * p.size());
                }
            }
    });
    return worst;
}
TYPED_TEST(LatticeWaves, HaveTheKnownSumsAndNeighbours)
{
    const double worst = sums_and_neighbours<Lattice<TypeParam>>();
    EXPECT_LE(worst, 1) << "times the tolerance";
    this->RecordProperty("worst", std::to_string(worst) + " of the tolerance");
}
TYPED_TEST(LatticeInFloat, HasTheKnownSumsAndNeighbours)
{
    const double worst = sums_and_neighbours<Lattice<TypeParam>>();
    EXPECT_LE(worst, 1) << "times the tolerance";
    this->RecordProperty("worst", std::to_string(worst) + " of the tolerance");
}

TYPED_TEST(LatticeWaves, HaveTheKnownFirstDerivative)
{
    using This = Lattice<TypeParam>;
    constexpr int dim = This::dim;
    double worst = 0;
    This::each_kernel([&] {
        for (auto const& row : This::rows())
            for (int N : {8, 16, 32, 64}) {
                const double k = 2 * std::numbers::pi / N;
                auto sim = lattice<dim, Double>(This::number(row, "h_over_dx"), 1, {N, 1, 1});
                fill<dim>(sim, 1, [k](auto& p, std::size_t i) { p.put(wave, i, std::sin(k * p.at(position, i)[0])); });
                const double expected = 1 + This::number(row, "keff_rel_N" + std::to_string(N));
                auto const& p = sim.particles();
                for (std::size_t i = 0; i < p.size(); ++i) {
                    const auto d = p.at(derivative, i);
                    worst = std::max(worst, std::abs(d[0] / k - expected * std::cos(k * p.at(position, i)[0])));
                    for (int c = 1; c < dim; ++c) worst = std::max(worst, std::abs(d[c] / k));
                }
            }
    });
    EXPECT_LE(worst, 1e-10);
    this->RecordProperty("worst", std::to_string(worst / 1e-10) + " of the tolerance");
}

TYPED_TEST(LatticeWaves, DecayWithTheKnownViscosity)
{
    using This = Lattice<TypeParam>;
    constexpr int dim = This::dim;
    double worst = 0;
    auto one = [&](oracle::Row const& row, int N, double eps, std::string const& column) {
        const double k = 2 * std::numbers::pi / N;
        auto sim = lattice<dim, Double>(This::number(row, "h_over_dx"), 1, {N, 1, 1}, eps);
        fill<dim>(sim, 1, [k](auto& p, std::size_t i) {
            auto v = p.at(velocity, i);
            v[int(std::size(v.c)) - 1] = std::sin(k * p.at(position, i)[0]); // across the wave, except on a line
            p.put(velocity, i, v);
        });
        sim.system().rates(sim.system().all);
        const double nu = 1 + This::number(row, column); // over mu/rho, which is 1
        auto const& p = sim.particles();
        for (std::size_t i = 0; i < p.size(); ++i) {
            const auto a = p.at(acceleration, i), v = p.at(velocity, i);
            for (int c = 0; c < dim; ++c) worst = std::max(worst, std::abs(a[c] / (k * k) + nu * v[c]));
        }
    };
    This::each_kernel([&] {
        for (auto const& row : This::rows()) {
            one(row, 16, 0.01, "nueff_rel_N16_eps0.01");
            one(row, 64, 0.01, "nueff_rel_N64_eps0.01");
            one(row, 64, 0, "nueff_rel_N64_eps0");
        }
    });
    EXPECT_LE(worst, 1e-10);
    this->RecordProperty("worst", std::to_string(worst / 1e-10) + " of the tolerance");
}

/// Largest error of <f>, f = sin(2 pi x) cos(2 pi y), with N points a wavelength and h of 4 spacings.
double smoothing_error(int N)
{
    const double dx = 1.0 / N, k = 2 * std::numbers::pi, h_over_dx = 4;
    auto sim = lattice<2, Double>(h_over_dx, dx, {N, N, 1});
    fill<2>(sim, dx, [k](auto& p, std::size_t i) {
        const auto x = p.at(position, i);
        p.put(wave, i, std::sin(k * x[0]) * std::cos(k * x[1]));
    });
    // f is an eigenfunction of every sum over the lattice; its eigenvalue, by the sum over one kernel:
    using K = chosen::AnyKernel<2>;
    const double support = chosen::support() * h_over_dx;
    const K kernel{.h = support * dx};
    const int reach = int(support);
    double symbol = 0;
    for (int a = -reach; a <= reach; ++a)
        for (int b = -reach; b <= reach; ++b)
            symbol += dx * dx * kernel.sigma() * K::f(std::hypot(a, b) / support) * std::cos(k * a * dx) *
                      std::cos(k * b * dx);
    double error = 0, off = 0;
    auto const& p = sim.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        error = std::max(error, std::abs(p.at(smoothed, i) - p.at(wave, i)));
        off = std::max(off, std::abs(p.at(smoothed, i) - symbol * p.at(wave, i)));
    }
    EXPECT_LE(off, 1e-12) << N;
    return error;
}

class SmoothingOf : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(EachKernel, SmoothingOf, ::testing::Range(0, 5),
                         [](auto const& kernel) { return std::string(chosen::kernels[kernel.param]); });

TEST_P(SmoothingOf, IsOfSecondOrderWithTheKnownConstant)
{
    chosen::kernel = GetParam();
    constexpr double second_moments[] = {31.0 / 98, 2771.0 / 5736, 5.0 / 18, 7.0 / 33, 6.0 / 35}; // numerics A.1
    const double m2 = second_moments[chosen::kernel];
    const double support = 4 * chosen::support();
    const chosen::AnyKernel<2> at_4{.h = support};
    double unity = 0; // S0 at h of 4 spacings: the smoothed field is off by f (S0 - 1) too, at every N
    for (int a = -12; a <= 12; ++a)
        for (int b = -12; b <= 12; ++b) unity += at_4.sigma() * at_4.f(std::hypot(a, b) / support);
    // error = (m2/2) h^2 |lap f| (1 - O(k^2 h^2)): with 8 to 64 points h is 1/2 to 1/16 of a wavelength, where the
    // second term shows in the order; 128 and 256 points are where the leading term stands alone.
    double last = 0, order = 0, constant = 0;
    for (int N : {8, 16, 32, 64, 128, 256}) {
        const double error = smoothing_error(N) + (unity - 1), h = 4.0 / N;
        if (last > 0) order = std::log2(last / error);
        constant = error / (0.5 * m2 * h * h * 8 * std::numbers::pi * std::numbers::pi);
        RecordProperty("order_" + std::to_string(N), std::to_string(order));
        RecordProperty("constant_" + std::to_string(N), std::to_string(constant));
        last = error;
    }
    EXPECT_NEAR(order, 2, 0.02);
    EXPECT_NEAR(constant, 1, 0.005);
}

} // namespace
