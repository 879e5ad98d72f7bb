// SPDX-License-Identifier: BSD-3-Clause
// What ten scenes store, pack, advance and add up: the listed minimum and nothing else (numerics A.13 i).
// Each set is compared by the compiler; the test prints them.
#include <spate/spate.hpp>

#include <gtest/gtest.h>

#include <cstdio>

using namespace spate;

namespace {

template <class... F, class... G>
constexpr bool same(Fields<F...> a, Fields<G...> b)
{
    return a <= b && b <= a;
}

/// The sets of a scene under an integrator that asks for all rates at once.
template <class Physics, class Boundary>
struct Scene {
    using M = Model<Physics, Boundary>;
    using S = System<Physics, Boundary, Serial, Double>;
    static constexpr int dim = M::dim;
    static constexpr auto plan = M::template rates_plan<Set<S::all>>();

    static constexpr Mask added(int species)
    {
        Mask fields = 0;
        for (int k = 0; k < plan.count; ++k) {
            const Stage stage = plan.stage[std::size_t(k)];
            if (stage.action != Action::sweep || stage.species != species) continue;
            for (int t = 0; t < M::terms; ++t)
                if (((stage.terms >> t) & 1) != 0) fields |= M::planner.term[std::size_t(t)].adds;
        }
        return fields;
    }
    static constexpr int swept(int species)
    {
        int terms = 0;
        for (int k = 0; k < plan.count; ++k)
            if (plan.stage[std::size_t(k)].action == Action::sweep && plan.stage[std::size_t(k)].species == species)
                for (int t = 0; t < M::terms; ++t) terms += int((plan.stage[std::size_t(k)].terms >> t) & 1);
        return terms;
    }
    static constexpr auto sums = M::template fields<added(0)>();
    static constexpr auto wall_sums = M::template fields<added(1)>();
    static constexpr auto evolving = M::template evolving<0>();
    static constexpr auto record = M::template record<0>();
    using Packed = Layout<dim, Set<record>>;
    static constexpr int values = Layout<dim, Set<M::mobile>>::count; // stored for a mobile particle
    static constexpr int wall_values = Layout<dim, Set<M::marker>>::count;
};
template <class P, class B>
Scene<P, B> scene(P, B);

void print(char const* name, auto s)
{
    using S = decltype(s);
    std::printf("%s\n  mobile   %2d values: %s\n", name, S::values, to_string(S::M::mobile).c_str());
    std::printf("  uniform           : %s\n", to_string(S::M::template uniform<0>()).c_str());
    if (S::M::markers) std::printf("  marker   %2d values: %s\n", S::wall_values, to_string(S::M::marker).c_str());
    std::printf("  record   %2d of %2d  : %s\n", S::Packed::count, S::Packed::stride, to_string(S::record).c_str());
    std::printf("  evolving          : %s\n", to_string(S::evolving).c_str());
    std::printf("  sweep of %d terms  : %s\n", S::swept(0), to_string(S::sums).c_str());
    if (S::M::markers) std::printf("  sweep on markers %d: %s\n", S::swept(1), to_string(S::wall_sums).c_str());
}

constexpr CubicSpline<3> kernel{.h = 0.012};
constexpr Tait eos{.rho0 = 1000, .c0 = 30};
constexpr Gravity<3> gravity{{0, 0, -9.81}};
const Box<3> box{{0, 0, 0}, {1, 1, 1}};
[[maybe_unused]] auto adami() { return Bce(box, 0.01, Adami{}, open(top)); }
[[maybe_unused]] auto by_continuity() { return Bce(box, 0.01, ByContinuity{}, open(top)); }

// The dam of the front page.
[[maybe_unused]] auto water()
{
    return wcsph(kernel, eos, Continuity<2>{}, DensityDiffusion{}, PressureForce<2>{},
                 ArtificialViscosity{.alpha = 0.02}, gravity);
}
using Dam = decltype(scene(water(), adami()));
constexpr Fields of_water{position, velocity, density, pressure, density_rate, acceleration, build_position};
static_assert(same(Dam::M::mobile, of_water) && Dam::values == 15);
static_assert(same(Dam::M::uniform<0>(), Fields{mass}));
static_assert(same(Dam::M::marker, Fields{position, density, pressure, pressure_sum, kernel_sum}) &&
              Dam::wall_values == 7);
static_assert(same(Dam::M::uniform<1>(), Fields{mass, velocity}));
static_assert(same(Dam::record, Fields{position, velocity, density, pressure}));
static_assert(Dam::Packed::count == 8 && Dam::Packed::stride == 8);            // one cache line
static_assert(same(Dam::M::record<1>(), Fields{position, density, pressure})); // a wall at rest sends no velocity
static_assert(same(Dam::evolving, Fields{position, velocity, density}) && Set<Dam::M::evolving<1>()>::size == 0);
static_assert(same(Dam::sums, Fields{density_rate, acceleration}) && Dam::swept(0) == 5); // gravity rides along
static_assert(same(Dam::wall_sums, Fields{pressure_sum, kernel_sum}) && Dam::swept(1) == 1);

// Without viscosity: no field less, since continuity reads velocities too; one term less in the loop.
[[maybe_unused]] auto inviscid()
{
    return wcsph(kernel, eos, Continuity<2>{}, DensityDiffusion{}, PressureForce<2>{}, gravity);
}
using Inviscid = decltype(scene(inviscid(), adami()));
static_assert(same(Inviscid::M::mobile, of_water) && same(Inviscid::record, Dam::record) && Inviscid::swept(0) == 4);

// Without continuity and its diffusion: density stays as it was given; its rate is gone, and velocity leaves the record.
[[maybe_unused]] auto frozen() { return wcsph(kernel, eos, PressureForce<2>{}, gravity); }
using Frozen = decltype(scene(frozen(), adami()));
static_assert(same(Frozen::M::mobile, of_water - Fields{density_rate}) && Frozen::values == 14);
static_assert(same(Frozen::record, Fields{position, density, pressure}));
static_assert(Frozen::Packed::count == 5 && Frozen::Packed::stride == 8);
static_assert(same(Frozen::evolving, Fields{position, velocity}));
static_assert(same(Frozen::sums, Fields{acceleration}) && Frozen::swept(0) == 2);

// Without forces: nothing accelerates, and pressure, which nobody reads, is not packed.
[[maybe_unused]] auto free_flight() { return wcsph(kernel, eos, Continuity<2>{}); }
using FreeFlight = decltype(scene(free_flight(), Open{}));
static_assert(same(FreeFlight::M::mobile, of_water - Fields{acceleration}) && FreeFlight::values == 12);
static_assert(same(FreeFlight::record, Fields{position, velocity}));
static_assert(FreeFlight::Packed::count == 6 && FreeFlight::Packed::stride == 8);
static_assert(same(FreeFlight::evolving, Fields{position, density}));
static_assert(same(FreeFlight::sums, Fields{density_rate}) && FreeFlight::swept(0) == 1);
static_assert(Set<FreeFlight::M::marker>::size == 0);

// Walls by continuity: a marker carries density and its rate, and no acceleration; gravity does not move it.
using Seed = decltype(scene(water(), by_continuity()));
static_assert(same(Seed::M::mobile, of_water));
static_assert(same(Seed::M::marker, Fields{position, density, density_rate, pressure}) && Seed::wall_values == 6);
static_assert(same(Seed::M::evolving<1>(), Fields{density}));
static_assert(same(Seed::wall_sums, Fields{density_rate}) && Seed::swept(1) == 1); // no diffusion into the wall

// Equal discs: two coordinates are all that a neighbour sends.
[[maybe_unused]] auto grains() { return dem<2>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}); }
using Grains = decltype(scene(grains(), Open{}));
static_assert(same(Grains::M::mobile, Fields{position, velocity, acceleration, build_position}) && Grains::values == 8);
static_assert(same(Grains::M::uniform<0>(), Fields{mass, radius}));
static_assert(same(Grains::record, Fields{position}) && Grains::Packed::count == 2 && Grains::Packed::stride == 2);
static_assert(same(Grains::evolving, Fields{position, velocity}));
static_assert(same(Grains::sums, Fields{acceleration}) && Grains::swept(0) == 1);

// Rough ones turn: spin and its rate, and what a contact remembers, one number a pair in a plane, three in space. An angle
// is nobody's business.
template <int Dim>
[[maybe_unused]] auto rough_grains()
{
    return dem<Dim>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}, Dashpot{.e = 0.7}, Friction{.mu = 0.5});
}
template <int Dim>
using Rough = decltype(scene(rough_grains<Dim>(), Open{}));
constexpr Fields of_rough{position, velocity, angular_velocity, acceleration, angular_acceleration, build_position};
static_assert(same(Rough<2>::M::mobile, of_rough) && Rough<2>::values == 10);
static_assert(same(Rough<3>::M::mobile, of_rough) && Rough<3>::values == 18);
static_assert(same(Rough<3>::M::uniform<0>(), Fields{mass, radius}));
static_assert(same(Rough<3>::record, Fields{position, velocity, angular_velocity}));
static_assert(Rough<2>::Packed::count == 5 && Rough<3>::Packed::count == 9);
static_assert(same(Rough<3>::evolving, Fields{position, velocity, angular_velocity}));
static_assert(same(Rough<3>::sums, Fields{acceleration, angular_acceleration}) && Rough<3>::swept(0) == 3);
static_assert(Rough<2>::S::kept_values<0, 0> == 1 && Rough<3>::S::kept_values<0, 0> == 3);
static_assert(Grains::S::kept_values<0, 0> == 0);

// A dashpot alone does not turn anything; it sends velocities too.
[[maybe_unused]] auto damped_grains()
{
    return dem<3>({.mass = 0.1, .radius = 0.01}, LinearSpring{.k = 1e5}, Dashpot{.e = 0.7});
}
using Damped = decltype(scene(damped_grains(), Open{}));
static_assert(same(Damped::M::mobile, Fields{position, velocity, acceleration, build_position}));
static_assert(same(Damped::record, Fields{position, velocity}) && Damped::S::kept_values<0, 0> == 0);

// Of many sizes: mass and radius are columns; a neighbour sends its mass to the dashpot.
[[maybe_unused]] auto mixture()
{
    return dem<3>(Mixture{.largest = 0.01}, LinearSpring{.k = 1e5}, Dashpot{.e = 0.7}, Friction{.mu = 0.5},
                  Dissipation{});
}
using Assorted = decltype(scene(mixture(), Open{}));
static_assert(same(Assorted::M::mobile, of_rough | Fields{mass, radius, dissipated, dissipation_rate}));
static_assert(same(Assorted::record, Fields{position, radius, velocity, mass, angular_velocity}));

} // namespace

TEST(FieldSets, AreTheListedMinimum)
{
    print("dam of the front page, Adami walls", Dam{});
    print("... without viscosity", Inviscid{});
    print("... without continuity and diffusion", Frozen{});
    print("... by continuity alone, no walls", FreeFlight{});
    print("dam of the front page, walls by continuity", Seed{});
    print("equal discs", Grains{});
    print("... damped spheres", Damped{});
    print("... rough discs", Rough<2>{});
    print("... rough spheres", Rough<3>{});
    print("rough spheres of many sizes that count what they lose", Assorted{});
}

// The columns themselves, not only their sets: what a particle costs, ids and padding aside.
TEST(FieldSets, AreAllThatParticlesHold)
{
    Simulation dam(water(), SymplecticEuler{}, adami());
    auto& p = dam.particles();
    const std::size_t empty = p.bytes(), n = 3200;
    p.resize(n);
    const std::size_t padded = (n + 2 * p.padding - 1) / std::size_t(p.padding) * std::size_t(p.padding);
    EXPECT_LE(p.bytes() - empty, 15 * 8 * padded + 4 * n);
    EXPECT_GE(p.bytes() - empty, 15 * 8 * n + 4 * n);
}
