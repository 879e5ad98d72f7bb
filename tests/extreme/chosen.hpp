// SPDX-License-Identifier: BSD-3-Clause
// A kernel and an integrator that are chosen when a test runs: each case of a table then is the same scene type, compiled
// once. What they call are the library's own.
#pragma once

#include "spate/spate.hpp"

#include <string>

namespace chosen {

using namespace spate;

inline int kernel = 0, integrator = 0;                                              // of the scene that runs
inline constexpr const char* kernels[] = {"cubic", "quintic", "wc2", "wc4", "wc6"}; // as in tests/data
inline constexpr const char* integrators[] = {"forward_euler", "symplectic_euler", "leapfrog", "runge_kutta2"};
enum { forward_euler, symplectic_euler, leapfrog, runge_kutta2 };

/// Support over h of the kernel in hand.
inline double support() { return kernel == 1 ? 3 : 2; }

/// `h` is the radius of the support; q' = r/h = q/support().
template <int Dim>
struct AnyKernel {
    static constexpr int dim = Dim;
    static constexpr double radius = 1;
    double h;

    [[nodiscard]] double sigma() const
    {
        return with([&]<class K>(K) { return K{h / support()}.sigma(); });
    }
    template <class V>
    static V f(V const& q)
    {
        return with([&]<class K>(K) { return K::f(V(support() * q)); });
    }
    template <class V>
    static V g(V const& q) // of (sigma/h^2) g(q) x, h the support
    {
        return with([&]<class K>(K) { return V(support() * support() * K::g(V(support() * q))); });
    }

private:
    static auto with(auto const& f)
    {
        switch (kernel) {
        case 0: return f(CubicSpline<Dim>{1});
        case 1: return f(QuinticSpline<Dim>{1});
        case 2: return f(WendlandC2<Dim>{1});
        case 3: return f(WendlandC4<Dim>{1});
        default: return f(WendlandC6<Dim>{1});
        }
    }
};

/// Steps as the one in hand does.
struct AnyIntegrator {
private:
    static auto with(auto const& f)
    {
        switch (integrator) {
        case forward_euler: return f(ForwardEuler{});
        case symplectic_euler: return f(SymplecticEuler{});
        case leapfrog: return f(Leapfrog{});
        default: return f(RungeKutta2{});
        }
    }

public:
    static constexpr const char* name = "chosen";
    static constexpr int order = 1, evaluations = 2;
    static constexpr bool saves = true;
    static constexpr double ahead_velocity = 1, ahead_acceleration = 0.5, imaginary_limit = 0, real_limit = 2;
    static double energy_error(double z)
    {
        return with([&](auto i) { return i.energy_error(z); });
    }
    static double growth(double z)
    {
        return with([&](auto i) { return i.growth(z); });
    }
    void step(auto& s, double dt) const
    {
        if (integrator != runge_kutta2) s.keep(); // as `saves` says
        with([&](auto i) {
            i.step(s, dt);
            return 0;
        });
    }
    static double limit()
    {
        return with([](auto i) { return i.imaginary_limit; });
    }
    static double real()
    {
        return with([](auto i) { return i.real_limit; });
    }
};

} // namespace chosen
