// SPDX-License-Identifier: BSD-3-Clause
// Scenes at random, most of them nonsense: each ends well, with a state that is finite and where it must be, or it says why
// not. A failure prints the seed of its scene.
#include "extreme/scene.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace extreme;
using Point = Vec<2, double>;

class Dice {
public:
    explicit Dice(std::uint64_t seed) : random_(seed) {}
    bool once_in(int n) { return below(n) == 0; }
    int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
    double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
    double power(double lo, double hi) { return std::pow(10, uniform(lo, hi)); }
    double sign() { return once_in(2) ? 1 : -1; }
    template <class T>
    T of(std::vector<T> const& all)
    {
        return all[std::size_t(below(int(all.size())))];
    }
    /// A number that is wrong now and then.
    double hostile(double good)
    {
        if (!once_in(200)) return good;
        constexpr double big = std::numeric_limits<double>::max(), inf = std::numeric_limits<double>::infinity();
        return of<double>({0, -0.0, -good, inf, -inf, std::nan(""), big, 5e-324, 1e-310, 1e300, -1});
    }

private:
    std::mt19937_64 random_;
};

/// A coordinate: anywhere, on a face, a rounding beside one, on a lattice, outside.
double coordinate(Dice& dice, double length, double lattice)
{
    switch (dice.below(8)) {
    case 0: return dice.of<double>({0, -0.0, length, length / 2});
    case 1: return std::nextafter(dice.of<double>({0, length}), dice.sign() * 1e9);
    case 2: return double(std::nextafterf(float(length), 0.0F));
    case 3: return lattice * dice.below(10);
    case 4: return dice.of<double>({5e-324, 1e-300, 1e-40});
    case 5: return dice.once_in(20) ? dice.sign() * length * dice.power(0, 9) : dice.uniform(0, length);
    default: return dice.uniform(0, length);
    }
}
struct Outcome {
    std::string name, what;
};
Outcome one_scene(std::uint64_t seed)
{
    Dice dice(seed);
    extreme::Setup s;
    s.kind = dice.of<Kind>({Kind::fluid, Kind::fluid, Kind::walled, Kind::grains, Kind::grains});
    s.real = dice.of<Real>({Real::double_, Real::float_});
    s.integrator = dice.below(4);
    s.threads = 1 + dice.below(2);
    s.cell = dice.of<int>({0, 1, 3, 32});
    s.periodic = dice.once_in(2);
    s.watch.energy_every = 1 + dice.below(20);
    if (dice.once_in(3)) s.watch.overlap = 2;
    const double size = dice.hostile(dice.power(-4, 4));
    s.dx = size / 20;
    if (s.kind == Kind::walled) s.dx = size / dice.of<double>({8, 10, 16});
    s.box = {{{0, 0}}, {{size, size}}};
    s.smoothing = dice.hostile(dice.uniform(0.8, 2));
    s.c0 = dice.hostile(dice.power(-2, 4)), s.rho0 = dice.hostile(dice.power(-2, 4));
    s.alpha = dice.hostile(dice.of<double>({0, 0.02, 0.5, 10}));
    s.largest = dice.hostile(size * dice.of<double>({0.003, 0.02, 0.05}));
    s.k = dice.hostile(dice.power(0, 13));
    if (dice.once_in(2)) s.g = {{dice.hostile(0), dice.hostile(-9.81)}};
    const double speed = dice.of<double>({0, 1e-3, 0.1, 1, 20}) * (s.kind == Kind::grains ? size : s.c0);
    const int n = dice.of<int>({0, 1, 2, 3, 20, 60});

    Outcome out;
    std::unique_ptr<Scene> scene;
    spate::RunOptions o{.steps = 1 + dice.below(dice.once_in(10) ? 200 : 40)};
    o.cfl = dice.hostile(dice.of<double>({0.1, 0.25, 1, 10}));
    if (dice.once_in(3)) o.dt = dice.hostile(dice.power(-9, 0));
    try {
        const End end = end_of([&] {
            scene = make(s);
            if (s.kind != Kind::grains && dice.once_in(3))
                scene->fill({{{0, 0}}, {{s.dx * (1 + dice.below(8)), s.dx * (1 + dice.below(8))}}});
            Point last{};
            for (int k = 0; k < n; ++k) {
                Point x;
                for (int c = 0; c < 2; ++c) x[c] = dice.hostile(coordinate(dice, size, s.dx));
                if (k > 0 && dice.once_in(30)) x = last; // twice at one place
                last = x;
                const double r = s.largest * dice.of<double>({1, 1, 0.5, 1e-3}),
                             heavy = dice.of<double>({1, 1, 1e-6, 1e3});
                scene->add(x, {{dice.hostile(speed * dice.uniform(-1, 1)), dice.hostile(speed * dice.uniform(-1, 1))}},
                           s.kind == Kind::grains ? dice.hostile(heavy) : 0, dice.hostile(r));
            }
            scene->run(o);
        });
        out = {end.name, end.message};
    }
    catch (std::exception const& other) {
        return {"other", other.what()};
    }
    if (out.name == "BadInput" && scene && scene->steps() > 0) return {"late", out.what};
    if (out.name != "ok") return out;
    if (scene->steps() != o.steps) return {"short", "ran " + std::to_string(scene->steps())};
    const auto all = scene->states();
    if (!finite(all)) return {"not finite", ""};
    for (auto const& p : all) {
        if (s.kind != Kind::grains && !(p.rho > 0)) return {"density", spate::text(p.rho)};
        if (s.kind == Kind::grains && !s.periodic)
            for (int c = 0; c < 2; ++c)
                if (p.x[c] < 0 || p.x[c] > size) return {"outside", spate::text(p.x[c])};
    }
    return out;
}
void run_scenes(std::uint64_t first, int count)
{
    const std::vector<std::string> good{"ok",
                                        "BadInput",
                                        "NonFinite",
                                        "OutOfDomain",
                                        "DtCollapse",
                                        "SkinOutrun",
                                        "IndexOverflow",
                                        "EosDomain",
                                        "OverlapTooDeep",
                                        "EnergyRunaway",
                                        "CoincidentParticles"};
    std::map<std::string, int> ends;
    int failures = 0;
    for (int k = 0; k < count && failures < 20; ++k) {
        const Outcome end = one_scene(first + std::uint64_t(k));
        ++ends[end.name];
        if (std::find(good.begin(), good.end(), end.name) != good.end()) continue;
        ++failures;
        ADD_FAILURE() << "seed " << first + std::uint64_t(k) << ": " << end.name << ": " << end.what;
    }
    for (auto const& [name, number] : ends) std::printf("  %6d %s\n", number, name.c_str());
    EXPECT_GT(ends["ok"], count / 10); // not all of it is nonsense
    EXPECT_GT(ends["BadInput"], count / 100);
}
TEST(Fuzz, EachSceneEndsWellOrSaysWhyNot) { run_scenes(1, 2000); }
/// 1e5 of them, in ten parts.
class LongFuzz : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Part, LongFuzz, testing::Range(0, 10));
TEST_P(LongFuzz, EachSceneEndsWellOrSaysWhyNot) { run_scenes(1000000 + std::uint64_t(GetParam()) * 10000, 10000); }

} // namespace
