// expect: spate: a condition on packs is where(condition, a, b), not if, ?: or &&
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>

using namespace spate;

struct PushApart { // an `if` would be taken for all lanes as soon as one lane asks for it
    static constexpr Fields reads{velocity};
    static constexpr Fields adds{acceleration};
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        if ((i[velocity] - j[velocity]).dot(ij.x) < 0) i[acceleration] += ij.x;
    }
};

int main()
{
    auto water = wcsph(CubicSpline<2>{.h = 0.012}, Tait{.rho0 = 1000, .c0 = 10}, Continuity<2>{}, PushApart{});
    Simulation(water, RungeKutta2{}, Open{}).run({.steps = 1});
}
