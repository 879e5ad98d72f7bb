// SPDX-License-Identifier: BSD-3-Clause
// The decay of vortices in a periodic box (Taylor & Green 1937) at Re = 100 and 1000: numerics V15.
#include "models/case.hpp"
#include "models/internal_flow.hpp"
#include "models/results.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace {

using namespace spate;
using At = Vec<2, double>;

constexpr double U = 1, k = 2 * std::numbers::pi; // L = 1 m
struct Vortices {
    double nu; // [m^2/s]: 1/Re
    [[nodiscard]] double slower(double t) const { return std::exp(-2 * nu * k * k * t); }
    [[nodiscard]] At at(At const& x, double t) const
    {
        const double u = U * slower(t);
        return {-u * std::cos(k * x[0]) * std::sin(k * x[1]), u * std::sin(k * x[0]) * std::cos(k * x[1])};
    }
};
struct Errors {
    double velocity = 0, speed = 0; ///< L1 over that of the solution [-]
};
Errors errors(Vortices const& exact, auto const& s)
{
    auto const& p = s.particles();
    double v = 0, speed = 0, size = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const At is = p.at(velocity, i), u = exact.at(p.at(position, i), s.time());
        const double fast = std::sqrt(u.squaredNorm());
        v += std::sqrt((is - u).squaredNorm()), speed += std::abs(std::sqrt(is.squaredNorm()) - fast), size += fast;
    }
    return {v / size, speed / size};
}
/// The compositions: the one of all flows without a free surface, and the corrected one for those without walls.
struct Usual {
    static constexpr const char* name = "";
    static auto at(double sound, double dx, double nu) { return models::internal_flow_at(sound, dx, 1, nu, U); }
};
struct Corrected {
    static constexpr const char* name = "corrected, ";
    static auto at(double sound, double dx, double nu) { return models::corrected_flow_at(sound, dx, 1, nu, U); }
};
constexpr double none = std::numeric_limits<double>::infinity();
/// From a lattice or a jittered one, to some whole time. Gives the error of velocity at t = 1.
/// \param gate  of it; infinite: none
/// \param sound  over the fastest flow
template <class With = Usual>
double decay(int n, double Re, bool jittered, int until, double gate = none, double sound = 10)
{
    const std::string start = With::name + std::string(jittered ? "jittered" : "lattice"), re = std::to_string(int(Re));
    const models::Case c("V15", "Re = " + re + ", " + start + (sound > 10 ? ", c0 raised with n" : ""), n);
    const Vortices exact{1 / Re};
    const double dx = 1.0 / n, c0 = sound * U;
    const Box<2> box{{0, 0}, {1, 1}};
    Simulation s(With::at(sound, dx, exact.nu), SymplecticEuler{}, Periodic(box));
    std::mt19937_64 dice(1);
    auto draw = [&] { return (double(dice() >> 11) * 0x1p-52 - 1) * (jittered ? 0.2 : 0) * dx; };
    s.fill(box, dx, [&](auto& p, std::size_t i) {
        At x = p.at(position, i);
        for (int d = 0; d < 2; ++d) x[d] += draw();
        p.put(position, i, x);
        p.put(velocity, i, exact.at(x, 0));
        p.put(density, i, 1 - U * U / (4 * c0 * c0) * (std::cos(2 * k * x[0]) + std::cos(2 * k * x[1])));
    });
    const double energy = s.energy().kinetic;
    auto file = models::results("taylor_green_" + std::to_string(n) + (Re > 100 ? "_Re" + re : "") +
                                    (*With::name ? "_corrected" : "") + (sound > 10 ? "_sound" : "") +
                                    (jittered ? "_jittered.csv" : ".csv"),
                                "t,speed,exact");
    double at_1 = 0;
    for (int tenth = 1; tenth <= 10 * until; ++tenth) {
        s.run({.until = tenth / 10.0});
        file << s.time() << ',' << std::sqrt(s.energy().kinetic / energy) << ',' << exact.slower(s.time()) << '\n';
        if (tenth != 10 && tenth != 10 * until) continue;
        const Errors e = errors(exact, s);
        const std::string when = ", L1, t = " + std::to_string(tenth / 10);
        if (tenth == 10 && std::isfinite(gate)) c.at_most("error of velocity" + when, e.velocity, gate);
        else c.told("error of velocity" + when, e.velocity);
        c.told("error of speed" + when, e.speed);
        c.told("rate of decay to t = " + std::to_string(tenth / 10) + ", off by",
               std::log(s.energy().kinetic / energy) / (2 * std::log(exact.slower(s.time()))) - 1);
        if (tenth == 10) at_1 = e.velocity;
    }
    EXPECT_LT(models::emptiest(s, box, dx), 1); // without shifting there are voids at the stagnation points
    return at_1;
}
// L1 <= 5 % at 50^2 and Re = 100, order >= 1 over 25, 50, 100.
void converges(double Re, bool jittered, int until)
{
    const double coarse = decay(25, Re, jittered, until), fine = decay(100, Re, jittered, until);
    models::Case("V15", "Re = " + std::to_string(int(Re)) + (jittered ? ", jittered" : ", lattice"), 0)
        .at_least("order of the error of velocity, 25 to 100, t = 1", models::order(coarse, fine), 1);
}
TEST(TaylorGreen, DecaysFromALattice) { decay(50, 100, false, 1, 0.05); }
TEST(TaylorGreen, DecaysFromAJitteredLattice) { decay(50, 100, true, 1, 0.05); }
TEST(LongTaylorGreen, ConvergesFromALattice) { converges(100, false, 2); }
TEST(LongTaylorGreen, ConvergesFromAJitteredLattice) { converges(100, true, 2); }
TEST(TaylorGreen, DecaysWithCorrectedGradients) { decay<Corrected>(50, 100, true, 1, 0.05); }
// At a fixed speed of sound the error comes to that of a compressible fluid; with c0 raised as the spacing falls it does not.
// The order asked for is that of corrected gradients.
TEST(LongTaylorGreen, ConvergesWithSoundRaised)
{
    decay(50, 100, true, 1, none, 20);
    const double coarse = decay(25, 100, true, 1), fine = decay(100, 100, true, 1, none, 40);
    models::Case("V15", "Re = 100, jittered, c0 raised with n", 0)
        .told("order of the error of velocity, 25 to 100, t = 1", models::order(coarse, fine));
}
TEST(LongTaylorGreen, ConvergesWithSoundRaisedAndCorrectedGradients)
{
    const double coarse = decay<Corrected>(25, 100, true, 1);
    decay<Corrected>(50, 100, true, 1, none, 20);
    decay<Corrected>(100, 100, true, 1, none, 40);
    const double fine = decay<Corrected>(200, 100, true, 1, none, 80);
    models::Case("V15", "Re = 100, corrected, jittered, c0 raised with n", 0)
        .at_least("order of the error of velocity, 25 to 200, t = 1", std::log2(coarse / fine) / 3, 1.8);
}
TEST(LongTaylorGreen, ConvergesAtReynolds1000)
{
    decay(50, 1000, true, 5);
    converges(1000, true, 5);
}

} // namespace
