// SPDX-License-Identifier: BSD-3-Clause
// The smallest kernel: what Kernel asks for and no more; no base class, no attribute, no registration.
#include <spate/spate.hpp>

using namespace spate;

namespace {

//[kernel
struct Parabola { // Epanechnikov 1969 in 2D: W = 2/(pi h^2) (1 - q^2)
    static constexpr int dim = 2;
    static constexpr double radius = 1;
    double h;

    double sigma() const { return 2 / (3.14159265358979323846 * h * h); }
    static auto f(auto q) { return max(1 - q * q, 0); }
    static auto g(auto q) { return where(q < 1, decltype(q)(-2), 0); }
};
static_assert(Kernel<Parabola>);
//]

} // namespace

void must_compile_smallest_kernel()
{
    Simulation s(wcsph(Parabola{.h = 0.02}, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, PressureForce<2>{}),
                 RungeKutta2{}, Open{});
    s.fill(Box<2>{{0, 0}, {0.1, 0.1}}, 0.01);
    s.run({.steps = 1});
}
