// SPDX-License-Identifier: BSD-3-Clause
// A shear wave on a lattice decays at a rate that is a lattice sum, and in time as the integrator's own map says.
#include "spate/spate.hpp"

#include "lattice.hpp"

#include <gtest/gtest.h>

namespace {

using namespace spate;

constexpr double h = 1.3, nu = 1, rho0 = 1000;

/// The decay rate over nu k^2 of v_y = eps sin(k x) with N points of a wavelength, RungeKutta2's own error taken out.
double measured(int N, double eps)
{
    const double k = 2 * std::numbers::pi / N, amplitude = 1e-6;
    const double kappa = lattice::table("kernel_stability_constants.csv", "cubic", 2, h, "Lambda");
    const double dt =
        0.1 * 2 * h * h / (kappa * nu); // a tenth of the viscous limit, which is below the acoustic one here
    const Box<2> box{{}, {{double(N), 7}}};
    auto fluid = wcsph(CubicSpline<2>{h}, LinearEos{.rho0 = rho0, .c0 = 1}, Continuity<2>{}, PressureForce<2>{},
                       LaminarViscosity{.mu = rho0 * nu, .eps = eps});
    Simulation sim(fluid, RungeKutta2{}, Periodic(box), Serial{}, Double{}, NoWatch{});
    sim.fill(box, 1, [&](auto& p, std::size_t i) {
        p.put(velocity, i, {{0, amplitude * std::sin(k * p.at(position, i)[0])}});
    });
    auto const& p = sim.particles();
    std::vector<double> shape(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) shape[p.id()[i]] = std::sin(k * p.at(position, i)[0]);
    auto wave = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < p.size(); ++i) sum += p.at(velocity, i)[1] * shape[p.id()[i]];
        return sum;
    };
    const double before = wave();
    const int n = int(1 / (nu * k * k * dt)); // one e-fold
    sim.run({.steps = n, .dt = dt});
    const double R = std::pow(wave() / before, 1.0 / n); // = 1 - z + z^2/2
    return (1 - std::sqrt(2 * R - 1)) / dt / (nu * k * k);
}

struct Case {
    int N;
    double eps;
    const char* column; // of the table, where it has one
};
class Shear : public testing::TestWithParam<Case> {};

TEST_P(Shear, DecaysAtTheRateOfTheLattice)
{
    const auto [N, eps, column] = GetParam();
    const double k = 2 * std::numbers::pi / N;
    const double sum = lattice::laplacian<2>(lattice::cubic<2>(), h, k, eps) / (k * k);
    const double rate = measured(N, eps);
    EXPECT_NEAR(rate / sum, 1, 1e-6);
    RecordProperty("rate_error", testing::PrintToString(rate / sum - 1));
    if (column == nullptr) return;
    EXPECT_NEAR(rate / (1 + lattice::table("kernel_lattice_constants.csv", "cubic", 2, h, column)), 1, 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Wavelengths, Shear,
                         testing::Values(Case{16, 0.01, "nueff_rel_N16_eps0.01"},
                                         Case{64, 0.01, "nueff_rel_N64_eps0.01"}, Case{64, 0, "nueff_rel_N64_eps0"},
                                         Case{16, 0, nullptr}));

} // namespace
