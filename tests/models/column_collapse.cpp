// SPDX-License-Identifier: BSD-3-Clause
// A column of discs with friction falls on a floor with friction: V54 of the validation plan. Tall columns (height over
// width a above 3) run out by a power of a, 2/3 in a channel (Lube et al. 2005) and 0.7 for discs (Staron & Hinch 2005).
// With few discs across, the power is nearer to 1, that of low columns: docs/results/granular.
#include "models/case.hpp"
#include "models/results.hpp"
#include "oracle/dice.hpp"

#include "spate/spate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace {

using namespace spate;

constexpr double r = 0.01, m = 0.1, g = 9.81; // largest radius [m], mass of a grain of it [kg], gravity [m/s^2]
constexpr int across = 64; // grains in the width of a column: with 16 and 32 the tip of low heaps comes loose
constexpr double wide = across * 2 * r;
constexpr LinearSpring spring{.k = 4e6}; // the weight of 1200 grains presses the lowest by a fortieth of their radius
constexpr Dashpot dashpot{.e = 0.5};
constexpr Friction friction{.mu = 0.5};

auto channel(Box<2> const& box)
{
    return Simulation(dem<2>(Mixture{.largest = r}, spring, dashpot, friction, Gravity<2>{{0, -g}}), Leapfrog{},
                      Walls(box, contact(spring, dashpot, friction), open(top)), Threads{}, Double{}, Watch{},
                      Neighbours{.skin = 0.1, .finer = 1, .window = 1});
}
double step()
{
    return std::numbers::pi / spring.contact_frequency(0.56 * m) / 25; // of the lightest
}
struct Collapse {
    double aspect, runout, height; ///< all over the width of the column at rest
};
/// A stack settles between two walls; then the one on the right is gone, until the heap has had 4.5 free falls to rest.
Collapse collapse(double stacked)
{
    const auto rows = int(stacked * across);
    auto column = channel(Box<2>{{0, 0}, {wide, 3 * r * rows}});
    oracle::Dice dice(2026);
    for (int k = 0; k < across * rows; ++k) {
        const double size = dice.real(0.75, 0.998);
        const double sway = dice.real(-1, 1) * (1 - size) * r; // none in another, none upright on another
        const auto i = column.add({(k % across + 0.5) * 2 * r + sway, (k / across + 0.6) * 2 * r});
        column.particles().put(radius, i, size * r);
        column.particles().put(mass, i, size * size * m);
    }
    const double fall = std::sqrt(2 * stacked * wide / g);
    column.run({.until = 2 * fall, .dt = step()});
    auto const& c = column.particles();
    double top_at = 0;
    for (std::size_t i = 0; i < c.size(); ++i) top_at = std::max(top_at, c.at(position, i)[1]);

    auto heap = channel(Box<2>{{0, 0}, {12 * top_at, 2 * top_at}});
    for (std::size_t i = 0; i < c.size(); ++i) {
        const auto k = heap.add(c.at(position, i));
        heap.particles().put(radius, k, c.at(radius, i)), heap.particles().put(mass, k, c.at(mass, i));
    }
    heap.run({.until = 4.5 * std::sqrt(2 * top_at / g), .dt = step()});
    // The heap is who is in touch with it (a tenth of a radius apart at most): others roll on by themselves, as discs do.
    auto const& p = heap.particles();
    std::vector<std::size_t> reached{0}, left;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p.at(position, i)[0] < p.at(position, reached[0])[0]) reached[0] = i; // at the wall
    for (std::size_t i = 0; i < p.size(); ++i)
        if (i != reached[0]) left.push_back(i);
    for (std::size_t n = 0; n < reached.size(); ++n) {
        const auto is_near = [&, k = reached[n]](std::size_t i) {
            const double apart = p.at(radius, i) + p.at(radius, k) + 0.1 * r;
            return (p.at(position, i) - p.at(position, k)).squaredNorm() < apart * apart;
        };
        const auto far = std::partition(left.begin(), left.end(), std::not_fn(is_near));
        reached.insert(reached.end(), far, left.end());
        left.erase(far, left.end());
    }
    double end = 0, height = 0, kinetic = 0;
    for (const std::size_t i : reached) {
        end = std::max(end, p.at(position, i)[0] + p.at(radius, i));
        height = std::max(height, p.at(position, i)[1] + p.at(radius, i));
        kinetic += 0.5 * p.at(mass, i) * p.at(velocity, i).squaredNorm();
    }
    EXPECT_LT(kinetic, 1e-4 * m * g * top_at * double(reached.size())); // it rests
    EXPECT_GT(reached.size(), 0.9 * double(p.size()));
    return {top_at / wide, end / wide - 1, height / wide};
}

TEST(LongColumnCollapse, RunsOutByAPowerOfTheHeight)
{
    const models::Case c("V54", "column of discs", across);
    auto table = models::results("column_collapse.csv", "aspect,runout,height");
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (double stacked : {4.0, 7.5, 13.5, 27.0}) {
        const auto heap = collapse(stacked);
        table << heap.aspect << ',' << heap.runout << ',' << heap.height << '\n';
        std::printf("a %.2f: runout %.2f, height %.2f widths\n", heap.aspect, heap.runout, heap.height);
        const double x = std::log(heap.aspect), y = std::log(heap.runout);
        n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    const double exponent = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    std::printf("exponent %.3f, prefactor %.2f\n", exponent, std::exp((sy - exponent * sx) / n));
    c.at_least("exponent of the runout", exponent, 0.6);
    c.at_most("exponent of the runout", exponent, 0.75);
}

} // namespace
