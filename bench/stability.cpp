// SPDX-License-Identifier: BSD-3-Clause
// Maps of stability: small noise on a lattice under sound and viscosity, and on a closed chain of pressed discs under springs
// and dashpots, at many steps and dampings; and on a chain of two masses, at many stiffnesses and ratios of mass. Each point is
// a run of 2000 steps, beside it what linear theory says. Not a measure of time.
#include <spate/spate.hpp>

#include <benchmark/benchmark.h>

#include <complex>
#include <random>

using namespace spate;

namespace {

constexpr int steps = 2000;
constexpr double noise =
    1e-10; // over the speed of sound, or of a contact: shear, which nothing holds, stays within 1e-6 dx

/// Largest |R| of a mode over the integrators' maps of v' = -omega^2 x - gamma v, x' = v at z = omega dt, g = gamma dt.
template <class Integrator>
double factor(double z, double g)
{
    using Complex = std::complex<double>;
    if constexpr (Integrator::imaginary_limit > 0) { // staggered: R^2 - (2 - g - z^2) R + 1 - g = 0
        const double half = (g + z * z) / 2, square = half * half - z * z;
        if (square < 0) return std::sqrt(1 - g);
        return std::max(std::abs(1 - half + std::sqrt(square)), std::abs(1 - half - std::sqrt(square)));
    }
    else {
        double most = 0;
        const Complex root = std::sqrt(Complex(g * g / 4 - z * z));
        for (const Complex mu : {-g / 2 + root, -g / 2 - root})
            most = std::max(most, std::abs(1.0 + mu + (Integrator::order == 2 ? 0.5 * mu * mu : Complex(0))));
        return most;
    }
}
/// omega and gamma of a mode [1/s].
struct Mode {
    double omega, gamma;
};
template <class Integrator>
double largest_factor(std::vector<Mode> const& modes, double dt)
{
    double most = 0;
    for (auto const& m : modes) most = std::max(most, factor<Integrator>(m.omega * dt, m.gamma * dt));
    return most;
}
/// The step up to which no mode grows, over 2 / omega; 0: none.
template <class Integrator>
double limit(std::vector<Mode> const& modes, double omega)
{
    double low = 1e-4, high = 10;
    auto stable = [&](double x) { return largest_factor<Integrator>(modes, 2 * x / omega) <= 1 + 1e-12; };
    if (!stable(low)) return 0;
    while (high / low > 1.001) (stable(std::sqrt(low * high)) ? low : high) = std::sqrt(low * high);
    return low;
}
Mode stiffest(std::vector<Mode> const& modes)
{
    Mode most{0, 0};
    for (auto const& m : modes) most = {std::max(most.omega, m.omega), std::max(most.gamma, m.gamma)};
    return most;
}

/// Runs and looks at each wave of the noise every three steps: its largest in the second and in the last quarter. 0 stable:
/// none has grown; 1 bounded: one has, and no stop has come; 2 stopped.
/// \param waves  appends the amplitude of each to a vector
template <class S>
void look(benchmark::State& state, S& sim, double dt, double theory, auto const& waves)
{
    auto& c = state.counters;
    std::vector<double> now, start, early, late;
    auto take = [&](std::vector<double>& most) {
        now.clear(), waves(now);
        most.resize(now.size());
        for (std::size_t k = 0; k < now.size(); ++k) most[k] = std::max(most[k], now[k]);
    };
    take(start);
    bool stopped = false;
    RunOptions how{.steps = 3};
    if (dt > 0) how.dt = dt;
    for (auto _ : state) {
        try {
            while (sim.steps() < steps) {
                sim.run(how);
                if (sim.steps() > steps / 4 && sim.steps() <= steps / 2) take(early);
                if (sim.steps() > 3 * steps / 4) take(late);
            }
        }
        catch (Stop const& stop) {
            stopped = true;
            state.SetLabel(stop.name());
        }
    }
    const double all = *std::max_element(start.begin(), start.end());
    double grown = 1;
    if (!stopped)
        for (std::size_t k = 0; k < late.size(); ++k)
            if (late[k] > 1e-2 * all) grown = std::max(grown, late[k] / early[k]); // else down to the roundings
    c["growth"] = std::log(grown) / (steps / 2);
    c["theory"] = std::log(theory);
    c["state"] = stopped ? 2 : grown < 1.05 ? 0 : 1;
    c["steps"] = double(sim.steps());
}
/// Amplitudes of the waves of a square lattice of n by n places (n by 1: a line), of values that are given by place.
class Waves {
public:
    Waves(int nx, int ny) : nx_(nx), ny_(ny)
    {
        for (int k = 0; k < nx; ++k) turn_.push_back(std::polar(1.0, 2 * std::numbers::pi * k / nx));
    }
    /// \param of  (place, which): value of one of `count` quantities
    void append(std::vector<double>& to, int count, auto const& of) const
    {
        for (int kx = 0; kx <= nx_ / 2; ++kx)
            for (int ky = 0; ky < ny_; ++ky) {
                double sum = 0;
                for (int q = 0; q < count; ++q) {
                    std::complex<double> wave = 0;
                    for (int y = 0; y < ny_; ++y)
                        for (int x = 0; x < nx_; ++x)
                            wave += of(std::size_t(y * nx_ + x), q) * turn_[std::size_t((kx * x + ky * y) % nx_)];
                    sum += std::norm(wave);
                }
                to.push_back(std::sqrt(sum));
            }
    }

private:
    int nx_, ny_;
    std::vector<std::complex<double>> turn_;
};

// ---- the acoustic lattice

constexpr int side = 12;
constexpr double rho0 = 1000, c0 = 1, h = 1.3; // spacing 1 m
const LaminarViscosity unit{.mu = rho0};

std::vector<Mode> modes_of_the_lattice(double nu)
{
    const CubicSpline<2> kernel{h};
    std::vector<Mode> all;
    for (int kx = 0; kx <= side / 2; ++kx)
        for (int ky = 0; ky <= kx; ++ky) {
            const Vec<2, double> k{2 * std::numbers::pi * kx / side, 2 * std::numbers::pi * ky / side};
            Vec<2, double> gradient{};
            double decay = 0;
            detail::each_lattice_point<2>(1, 2 * h, [&](Vec<2, double> const& x) {
                const double r2 = x.squaredNorm(), F = kernel.sigma() / (h * h) * kernel.g(std::sqrt(r2) / h);
                gradient += (F * std::sin(k.dot(x))) * x;
                decay -= F * unit.acoustic_damping(rho0, h, r2, 0) * (1 - std::cos(k.dot(x)));
            });
            all.push_back({c0 * std::sqrt(gradient.squaredNorm()), nu * decay}); // along the gradient
            all.push_back({0, nu * decay});                                      // across
        }
    return all;
}
/// x: dt over 2 / largest omega; y: largest gamma over largest omega.
template <class Integrator>
void lattice(benchmark::State& state)
{
    const double x = std::pow(10, 0.1 * double(state.range(0))),
                 y = state.range(1) < -90 ? 0 : std::pow(10, 0.1 * double(state.range(1)));
    const Mode of_unit = stiffest(modes_of_the_lattice(1));
    const double nu = y * of_unit.omega / of_unit.gamma, dt = x * 2 / of_unit.omega;
    auto water = wcsph(CubicSpline<2>{h}, LinearEos{.rho0 = rho0, .c0 = c0}, Continuity<2>{}, PressureForce<2>{},
                       LaminarViscosity{.mu = rho0 * nu});
    const Box<2> box{{0, 0}, {side, side}};
    Simulation sim(water, Integrator{}, Periodic(box), Serial{});
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> u(-1, 1);
    sim.fill(box, 1, [&](auto& p, std::size_t i) { p.put(velocity, i, {noise * u(random), noise * u(random)}); });
    auto& p = sim.particles();
    const Vec<2, double> drift = (1 / sim.total_mass()) * sim.momentum();
    for (std::size_t i = 0; i < p.size(); ++i) p.put(velocity, i, p.at(velocity, i) - drift);
    const Waves waves(side, side);
    std::vector<std::array<double, 3>> at(p.size());
    look(state, sim, dt, largest_factor<Integrator>(modes_of_the_lattice(nu), dt), [&](std::vector<double>& to) {
        for (std::size_t i = 0; i < p.size(); ++i) // ids are in the order of the lattice
            at[p.id()[i]] = {p.at(velocity, i)[0], p.at(velocity, i)[1], c0 * (p.at(density, i) / rho0 - 1)};
        waves.append(to, 3, [&](std::size_t place, int q) { return at[place][std::size_t(q)]; });
    });
    state.counters["x"] = x, state.counters["y"] = y;
    state.counters["limit"] = limit<Integrator>(modes_of_the_lattice(nu), of_unit.omega);
}

// ---- the chain of contacts

constexpr int links = 8;
constexpr double r = 0.01, m = 0.1, gap = 1.9 * r; // [m], [kg], [m]

/// A closed chain of discs of mass m and m / ratio in turn, each pressed into the next by a tenth of a radius.
template <class Integrator>
class Chain {
public:
    Chain(double k, double zeta, double ratio) : k_(k), sim_(scene(k))
    {
        std::get<1>(sim_.system().terms()).zeta = zeta;
        std::mt19937_64 random(1);
        std::uniform_real_distribution<double> u(-1, 1);
        std::vector<double> v(links);
        double momentum = 0, total = 0;
        for (int i = 0; i < links; ++i) {
            v[std::size_t(i)] = noise * r * std::sqrt(k / m) * u(random);
            momentum += mass_of(i, ratio) * v[std::size_t(i)], total += mass_of(i, ratio);
        }
        for (int i = 0; i < links; ++i) {
            const auto n = sim_.add({(i + 0.25) * gap, 0.5}, {v[std::size_t(i)] - momentum / total, 0});
            sim_.particles().put(mass, n, mass_of(i, ratio)), sim_.particles().put(radius, n, r);
        }
    }
    auto& scene() { return sim_; }
    /// Appends the amplitude of each wave of equal discs, (speed, omega displacement).
    void waves(std::vector<double>& to)
    {
        read();
        static const Waves all(links, 1);
        const double omega = std::sqrt(k_ / m);
        all.append(to, 2, [&](std::size_t i, int q) { return q == 0 ? v_[i] : omega * stretch(i); });
    }
    /// Appends the root of the energy of the noise [J^(1/2)].
    void whole(std::vector<double>& to)
    {
        read();
        double sum = 0;
        for (std::size_t i = 0; i < links; ++i) sum += m_[i] * v_[i] * v_[i] + k_ * stretch(i) * stretch(i);
        to.push_back(std::sqrt(sum / 2));
    }

private:
    void read()
    {
        auto const& p = sim_.particles();
        for (std::size_t i = 0; i < p.size(); ++i)
            x_[p.id()[i]] = p.at(position, i)[0], v_[p.id()[i]] = p.at(velocity, i)[0], m_[p.id()[i]] = p.at(mass, i);
    }
    /// Of the contact of disc i with the next one.
    [[nodiscard]] double stretch(std::size_t i) const
    {
        const double s = x_[(i + 1) % links] - x_[i] - gap;
        return s - links * gap * std::round(s / (links * gap));
    }
    static double mass_of(int i, double ratio) { return i % 2 == 0 ? m : m / ratio; }
    static auto scene(double k)
    {
        return Simulation(dem<2>(Mixture{.largest = r}, LinearSpring{.k = k}, Dashpot{.e = 1}), Integrator{},
                          Periodic(Box<2>{{0, 0}, {links * gap, 1}}), Serial{});
    }
    double k_;
    decltype(scene(1)) sim_;
    std::array<double, links> x_{}, v_{}, m_{};
};
/// x: dt over 2 / largest omega, which is 2 sqrt(k/m); y: largest gamma, 4 c / m, over it.
template <class Integrator>
void chain(benchmark::State& state)
{
    constexpr double k = 1e5;
    const double x = std::pow(10, 0.1 * double(state.range(0))),
                 y = state.range(1) < -90 ? 0 : std::pow(10, 0.1 * double(state.range(1)));
    const double omega = 2 * std::sqrt(k / m), dt = x * 2 / omega;
    std::vector<Mode> modes;
    for (int q = 1; q <= links / 2; ++q) {
        const double s = std::sin(std::numbers::pi * q / links);
        modes.push_back({omega * s, y * omega * s * s});
    }
    Chain<Integrator> discs(k, y / (2 * std::numbers::sqrt2), 1); // c = 2 zeta sqrt(k m/2)
    look(state, discs.scene(), dt, largest_factor<Integrator>(modes, dt),
         [&](std::vector<double>& to) { discs.waves(to); });
    state.counters["x"] = x, state.counters["y"] = y;
    state.counters["limit"] = limit<Integrator>(modes, omega);
}
/// x: stiffness [N/m]; y: ratio of mass; steps of 1e-5 s, or by the criteria.
void two_masses(benchmark::State& state, double dt)
{
    const double k = std::pow(10, 0.1 * double(state.range(0))), ratio = std::pow(10, 0.1 * double(state.range(1)));
    const double omega = std::sqrt(2 * k * (1 + ratio) / m); // of the light between heavy ones
    Chain<Leapfrog> discs(k, 0, ratio);
    const double by_criterion = std::numbers::pi / 25 / std::sqrt(2 * k * ratio / m);
    look(state, discs.scene(), dt, factor<Leapfrog>(omega * (dt > 0 ? dt : by_criterion), 0),
         [&](std::vector<double>& to) { discs.whole(to); });
    state.counters["x"] = k, state.counters["y"] = ratio;
    if (dt > 0) state.counters["limit"] = 2 * m / (dt * dt) / (1 + ratio);
    state.counters["dt"] = discs.scene().dt(), state.counters["z"] = omega * discs.scene().dt();
}

/// x and y in tenths of a decade: steps, and dampings with none at all below the line.
void steps_and_dampings(benchmark::internal::Benchmark* b)
{
    for (int x = -25; x <= 4; ++x) {
        b->Args({x, -99});
        for (int y = -30; y <= 6; y += 2) b->Args({x, y});
    }
    b->Iterations(1);
}
void stiffnesses_and_ratios(benchmark::internal::Benchmark* b)
{
    for (int x = 20; x <= 100; x += 4)
        for (int y = 0; y <= 60; y += 4) b->Args({x, y});
    b->Iterations(1);
}
BENCHMARK(lattice<ForwardEuler>)->Apply(steps_and_dampings);
BENCHMARK(lattice<RungeKutta2>)->Apply(steps_and_dampings);
BENCHMARK(lattice<SymplecticEuler>)->Apply(steps_and_dampings);
BENCHMARK(lattice<Leapfrog>)->Apply(steps_and_dampings);
BENCHMARK(chain<ForwardEuler>)->Apply(steps_and_dampings);
BENCHMARK(chain<RungeKutta2>)->Apply(steps_and_dampings);
BENCHMARK(chain<SymplecticEuler>)->Apply(steps_and_dampings);
BENCHMARK(chain<Leapfrog>)->Apply(steps_and_dampings);
BENCHMARK_CAPTURE(two_masses, fixed, 1e-5)->Apply(stiffnesses_and_ratios);
BENCHMARK_CAPTURE(two_masses, by_criterion, 0.0)->Apply(stiffnesses_and_ratios);

} // namespace
