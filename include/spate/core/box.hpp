// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief An axis-aligned box, its axes and its faces.
#pragma once

#include "spate/core/errors.hpp"
#include "spate/core/vec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spate {

template <int Dim>
struct Box {
    Vec<Dim, double> lo; ///< lower corner [m]
    Vec<Dim, double> hi; ///< upper corner [m]

    [[nodiscard]] Vec<Dim, double> size() const { return hi - lo; }
    [[nodiscard]] bool contains(Vec<Dim, double> const& x) const
    {
        for (int c = 0; c < Dim; ++c)
            if (!(x[c] >= lo[c] && x[c] <= hi[c])) return false;
        return true;
    }
    /// To the surface [m], negative within.
    [[nodiscard]] double distance(Vec<Dim, double> const& x) const
    {
        Vec<Dim, double> out{};
        double inside = -std::numeric_limits<double>::max();
        for (int c = 0; c < Dim; ++c) {
            const double d = std::max(lo[c] - x[c], x[c] - hi[c]);
            out[c] = std::max(d, 0.0), inside = std::max(inside, d);
        }
        return inside > 0 ? std::sqrt(out.squaredNorm()) : inside;
    }
    [[nodiscard]] Box grown(double by) const
    {
        Box b = *this;
        for (int c = 0; c < Dim; ++c) b.lo[c] -= by, b.hi[c] += by;
        return b;
    }
};

/// "box length along axis 1": the name of a parameter in a message.
[[gnu::cold]] inline std::string along_axis(std::string what, int axis)
{
    what += " along axis ";
    what += std::to_string(axis);
    return what;
}

/// A face of a box: the lower or the upper end of an axis; the last axis points up.
struct Face {
    int axis; ///< 0, 1, 2; -1: the last axis of the space; -2: the middle one, in 3D only; -3: none
    bool upper;
};
inline constexpr Face left{0, false}, right{0, true}, front{-2, false}, back{-2, true}, bottom{-1, false},
    top{-1, true};
inline constexpr Face nowhere{-3, false}; ///< open(nowhere): no face is open
inline constexpr int x_axis = 0, y_axis = 1, z_axis = 2;

/// The axis of a face in a space.
template <int Dim>
int axis_of(Face f)
{
    if (f.axis == -2 && Dim != 3) throw BadInput("face", "front or back", "left, right, bottom or top below 3D");
    const int axis = f.axis == -2 ? 1 : f.axis == -1 ? Dim - 1 : f.axis;
    if (axis < 0 || axis >= Dim) throw BadInput("face", "axis " + std::to_string(axis), "an axis of the space");
    return axis;
}

/// What ends space at a face.
enum class Edge { open, wall, periodic };

/// One entry for each face: faces[2 * axis + upper].
template <int Dim>
struct Edges {
    std::array<Edge, std::size_t(2 * Dim)> face;

    explicit Edges(Edge all) { face.fill(all); }
    [[nodiscard]] Edge at(int axis, bool upper) const { return face[std::size_t(2 * axis + upper)]; }
    [[gnu::cold]] void set(Face f, Edge e)
    {
        if (f.axis != nowhere.axis) face[std::size_t(2 * axis_of<Dim>(f) + f.upper)] = e;
    }
    void set_axis(int axis, Edge e)
    {
        set({axis, false}, e);
        set({axis, true}, e);
    }
    [[nodiscard]] bool periodic(int axis) const { return at(axis, false) == Edge::periodic; }
};

/// Options of a boundary: open(top, left), periodic(x_axis).
template <std::size_t N>
struct OpenFaces {
    std::array<Face, N> faces;
};
template <class... F>
OpenFaces<sizeof...(F)> open(F... f)
{
    return {{f...}};
}
template <std::size_t N>
struct PeriodicAxes {
    std::array<int, N> axes;
};
template <class... A>
PeriodicAxes<sizeof...(A)> periodic(A... a)
{
    return {{a...}};
}
template <int Dim, std::size_t N>
void apply(Edges<Dim>& e, OpenFaces<N> const& o)
{
    for (Face f : o.faces) e.set(f, Edge::open);
}
template <int Dim, std::size_t N>
void apply(Edges<Dim>& e, PeriodicAxes<N> const& p)
{
    for (int a : p.axes) e.set_axis(a, Edge::periodic);
}

} // namespace spate
