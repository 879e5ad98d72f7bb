// SPDX-License-Identifier: BSD-3-Clause
// What users write themselves, each the smallest that its concept allows: no base class, no attribute, no registration.
#pragma once

#include <spate/spate.hpp>

namespace smallest {

using namespace spate;

// A field of the user's own, with a rate: it is stored, packed, saved and advanced because a term adds to its rate.
//[field
struct Temperature;
inline constexpr struct TemperatureRate : ScalarField {
    static constexpr std::string_view name = "temperature_rate", unit = "K/s";
    using rate_of = Temperature;
    static constexpr bool derived = true;
} temperature_rate{};
inline constexpr struct Temperature : ScalarField {
    static constexpr std::string_view name = "temperature", unit = "K";
    static constexpr Kind kind = Kind::drift;
    using rates = Fields<TemperatureRate>;
} temperature{};
//]

//[conduction
/// Heat conduction (Cleary & Monaghan 1999) at equal conductivity: dT_i/dt = sum_j 2 a V_j T_ij x_ij . grad W_ij / r^2.
struct HeatConduction {
    static constexpr Fields reads{temperature};
    static constexpr Fields reads_j{mass, density};
    static constexpr Fields adds{temperature_rate};
    double a; // diffusivity [m^2/s]
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        const auto V_j = j[mass] / j[density];
        i[temperature_rate] += 2 * a * V_j * ij.over_r2 * (i[temperature] - j[temperature]) * ij.x.dot(ij.grad_w);
    }
};
//]

// A particle term and a pair term: a declaration and a line.
//[terms
struct Drag {
    static constexpr Fields reads{velocity};
    static constexpr Fields adds{acceleration};
    double k; // [1/s]
    void operator()(auto& i) const { i[acceleration] -= k * i[velocity]; }
};
struct Alignment {
    static constexpr Fields reads{velocity};
    static constexpr Fields adds{acceleration};
    double k; // [m^2/s]
    void operator()(auto& i, auto const& j, auto const& ij) const
    {
        i[acceleration] += (k * ij.w) * (j[velocity] - i[velocity]);
    }
};
static_assert(ParticleTerm<Drag> && !PairTerm<Drag>);
static_assert(PairTerm<Alignment> && !ParticleTerm<Alignment>);
//]

// A kernel: what Kernel asks for and no more.
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

// An integrator: eight constants, how it grows, and a step made of the verbs of the system.
//[integrator
struct DriftKick { // x+ = x + dt v; v+ = v + dt a(x+)
    static constexpr const char* name = "drift_kick";
    static constexpr int order = 1, evaluations = 1;
    static constexpr bool saves = false;
    static constexpr double imaginary_limit = 2, real_limit = 2;
    static constexpr double ahead_velocity = 1, ahead_acceleration = 0; // rates are taken at x + dt v
    static double growth(double) { return 0; }
    void step(auto& s, double dt) const
    {
        s.rates(s.driven);
        s.advance(s.drifting, dt);
        s.rates(s.kicked);
        s.advance(s.kicked, dt);
    }
};
static_assert(Integrator<DriftKick>);
//]

struct Nowhere { // space without an end
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
struct Backwards { // tasks from the last to the first
    static constexpr const char* name = "backwards";
    int cell = 0;
    int threads() const { return 1; }
    void check() const {}
    void for_each(std::size_t tasks, auto const& run) const
    {
        while (tasks-- > 0) run(tasks);
    }
};

} // namespace smallest
