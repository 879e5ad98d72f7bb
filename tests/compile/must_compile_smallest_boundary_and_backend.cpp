// SPDX-License-Identifier: BSD-3-Clause
// The smallest boundary (space without an end) and the smallest backend (one thread, tasks from the last to the first).
#include <spate/spate.hpp>

using namespace spate;

namespace {

struct Nowhere {
    static constexpr bool markers = false;
    template <int Dim>
    Edges<Dim> edges() const
    {
        return Edges<Dim>(Edge::open);
    }
    template <int Dim>
    std::optional<Box<Dim>> box() const
    {
        return {};
    }
    template <int Dim>
    double beyond(Vec<Dim, double> const&) const
    {
        return 0;
    }
    double thickness(double) const { return 0; }
    void check(double) const {}
};
struct Backwards {
    static constexpr const char* name = "backwards";
    int cell = 0;
    int threads() const { return 1; }
    void check() const {}
    void for_each(std::size_t tasks, auto const& run) const
    {
        while (tasks-- > 0) run(tasks);
    }
};

} // namespace

void must_compile_smallest_boundary_and_backend()
{
    Simulation water(
        wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, PressureForce<2>{}),
        RungeKutta2{}, Nowhere{}, Backwards{});
    water.fill(Box<2>{{0, 0}, {0.1, 0.1}}, 0.01);
    water.run({.steps = 1});
}
