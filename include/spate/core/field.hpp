// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A field: a named quantity that each particle carries, known by an empty type.
/// Rank, SI unit, and - for a quantity that evolves - its rate and its kind (drift or kick).
#pragma once

#include "spate/core/vec.hpp"

#include <string_view>

namespace spate {

template <class... F>
struct Fields;

/// How an integrator advances a field: positions, angles, densities drift with velocities; velocities, spins are kicked
/// by forces.
enum class Kind { none, drift, kick };

/// The bases of a field. A user's field: `inline constexpr struct Temperature : ScalarField { ... } temperature{};`
struct ScalarField {
    static constexpr int rank = 0;
    static constexpr bool axial = false;
    static constexpr Kind kind = Kind::none;
    using rates = Fields<>;                ///< by what it may evolve: the first of these that the species carries
    using rate_of = void;                  ///< for a rate: the field that it advances
    static constexpr bool derived = false; ///< true: never an initial condition, some term must produce it
    static constexpr std::string_view unit = "-";
};
struct VectorField : ScalarField {
    static constexpr int rank = 1;
};
/// What turns: along the axis in space, and one number in a plane, where there is but one axis.
struct AxialField : VectorField {
    static constexpr bool axial = true;
};

// clang-format off
template <class F>
concept Field = std::is_empty_v<F> && std::is_trivial_v<F> && requires {
    { F::rank } -> std::convertible_to<int>;        // 0 scalar, 1 vector
    { F::kind } -> std::convertible_to<Kind>;       // drift, kick or none
    { F::name } -> std::convertible_to<std::string_view>;
    { F::unit } -> std::convertible_to<std::string_view>; // SI
};
// clang-format on

template <Field F, int Dim>
inline constexpr int components = F::rank == 0 || (F::axial && Dim < 3) ? 1 : Dim;

namespace detail {
template <int Rank, int Components, class V>
struct ValueOf {
    using type = V;
};
template <int Components, class V>
struct ValueOf<1, Components, V> {
    using type = Vec<Components, V>;
};
} // namespace detail
/// V for a scalar field, a Vec of its components for another.
template <Field F, int Dim, class V>
using Value = typename detail::ValueOf<F::rank, components<F, Dim>, V>::type;

struct AngularVelocity;
struct Dissipated;
struct Velocity;
struct Density;

// clang-format off
inline constexpr struct Mass : ScalarField         { static constexpr std::string_view name = "mass", unit = "kg"; } mass{};
inline constexpr struct Radius : ScalarField       { static constexpr std::string_view name = "radius", unit = "m"; } radius{};
inline constexpr struct Viscosity : ScalarField    { static constexpr std::string_view name = "viscosity", unit = "Pa s"; } viscosity{};
inline constexpr struct Pressure : ScalarField     { static constexpr std::string_view name = "pressure", unit = "Pa"; static constexpr bool derived = true; } pressure{};
inline constexpr struct DensityRate : ScalarField  { static constexpr std::string_view name = "density_rate", unit = "kg/m^3/s"; using rate_of = Density; static constexpr bool derived = true; } density_rate{};
inline constexpr struct Density : ScalarField      { static constexpr std::string_view name = "density", unit = "kg/m^3"; static constexpr Kind kind = Kind::drift; using rates = Fields<DensityRate>; } density{};
inline constexpr struct Acceleration : VectorField { static constexpr std::string_view name = "acceleration", unit = "m/s^2"; using rate_of = Velocity; static constexpr bool derived = true; } acceleration{};
inline constexpr struct Velocity : VectorField     { static constexpr std::string_view name = "velocity", unit = "m/s"; static constexpr Kind kind = Kind::kick; using rates = Fields<Acceleration>; } velocity{};
/// The velocity that positions follow where it is not the particle's own (XSPH, transport velocity, shifting).
inline constexpr struct TransportVelocity : VectorField { static constexpr std::string_view name = "transport_velocity", unit = "m/s"; static constexpr bool derived = true; } transport_velocity{};
inline constexpr struct Position : VectorField     { static constexpr std::string_view name = "position", unit = "m"; static constexpr Kind kind = Kind::drift; using rates = Fields<TransportVelocity, Velocity>; } position{};
inline constexpr struct AngularAcceleration : AxialField { static constexpr std::string_view name = "angular_acceleration", unit = "rad/s^2"; using rate_of = AngularVelocity; static constexpr bool derived = true; } angular_acceleration{};
inline constexpr struct AngularVelocity : AxialField { static constexpr std::string_view name = "angular_velocity", unit = "rad/s"; static constexpr Kind kind = Kind::kick; using rates = Fields<AngularAcceleration>; } angular_velocity{};
/// What the contacts of a particle lose, where a model counts it; a kick field, since its rate is at hand with the forces.
inline constexpr struct DissipationRate : ScalarField { static constexpr std::string_view name = "dissipation_rate", unit = "W"; using rate_of = Dissipated; static constexpr bool derived = true; } dissipation_rate{};
inline constexpr struct Dissipated : ScalarField  { static constexpr std::string_view name = "dissipated", unit = "J"; static constexpr Kind kind = Kind::kick; using rates = Fields<DissipationRate>; } dissipated{};
/// For a term that keeps something of a pair: the time since it was kept.
inline constexpr struct Elapsed : ScalarField     { static constexpr std::string_view name = "elapsed", unit = "s"; } elapsed{};
/// In records of pairs that compute in less than the state has: what the position has lost there.
inline constexpr struct PositionTail : VectorField { static constexpr std::string_view name = "position_tail", unit = "m"; static constexpr bool derived = true; } position_tail{};
/// Where a particle was when the neighbour lists were built: lists, bins and order are functions of it alone.
inline constexpr struct BuildPosition : VectorField { static constexpr std::string_view name = "build_position", unit = "m"; } build_position{};
// clang-format on

/// Moment of inertia of a round particle over m R^2 [-], in the plane and in space.
template <int Dim>
inline constexpr double inertia = Dim < 3 ? 0.5 : 0.4;

} // namespace spate
