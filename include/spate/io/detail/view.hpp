// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief From space to pixels: parallel projection along a direction, z up; 2D is seen along z.
///        No perspective: lengths can be read off.
#pragma once

#include <array>
#include <cmath>
#include <stdexcept>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "spate/io/detail/canvas.hpp"

namespace spate::io::detail {

struct View {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(); ///< rows: to the right, up, toward the viewer
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< what lies in the middle  [m]
    double scale = 1;                                   ///< [pixels/m]
    Point middle = Point::Zero();                       ///< where it lies  [pixels]

    /// Pixel right, pixel down, depth toward the viewer [pixels].
    Eigen::Vector3d operator()(Eigen::Vector3d const& x) const
    {
        const Eigen::Vector3d seen = scale * (turn * (x - centre));
        return {middle.x() + seen.x(), middle.y() - seen.y(), seen.z()};
    }
    Point place(Eigen::Vector3d const& x) const { return (*this)(x).head<2>(); }
    Eigen::Vector3d toward() const { return turn.row(2); }
};

inline Eigen::Matrix3d turn_toward(std::array<double, 3> const& seen_from)
{
    Eigen::Vector3d toward(seen_from[0], seen_from[1], seen_from[2]);
    if (!toward.allFinite() || toward.norm() == 0)
        throw std::invalid_argument(
            "spate: a picture is seen from a direction that is zero or not finite; use {0.5, -0.8, 0.45}");
    toward.normalize();
    const bool from_above = std::abs(toward.z()) > 0.999;
    const Eigen::Vector3d upward = from_above ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
    Eigen::Matrix3d turn;
    turn.row(0) = upward.cross(toward).normalized();
    turn.row(1) = toward.cross(turn.row(0).transpose());
    turn.row(2) = toward;
    return turn;
}

} // namespace spate::io::detail
