// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The boxes of the dam break: the column of Martin & Moyce, those on which other codes have been timed, and those
/// in which pressure has been measured; with their sensors.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <spate/core/box.hpp>
#include <spate/measure/front.hpp>
#include <spate/measure/gauge.hpp>
#include <spate/measure/probe.hpp>

/// A column of water in a tank; the first axis is along, the last one up.
template <int Dim>
struct Column {
    spate::Box<Dim> tank, water;
    double spacing;                                        ///< of the particles [m]
    double alpha;                                          ///< of artificial viscosity [-]
    double mu = 1e-3;                                      ///< of laminar viscosity: that of water [Pa s]
    double g = 9.81;                                       ///< [m/s^2]
    double fastest = std::sqrt(2 * g * water.hi[Dim - 1]); ///< speed of the flow: from the height of the column [m/s]
    std::optional<double> smoothing = {};                  ///< h/dx [-]; the kernel's where the case does not say
    spate::Face open = spate::top;
    spate::Box<Dim> box = empty; ///< stands in the tank

    static constexpr double infinity = std::numeric_limits<double>::infinity();
    inline static const spate::Box<Dim> empty = [] {
        spate::Box<Dim> b;
        for (int c = 0; c < Dim; ++c) b.lo[c] = infinity, b.hi[c] = -infinity;
        return b;
    }();
    using Pressure = spate::Probe<spate::Pressure, Dim>;
    using Depth = spate::Gauge<Dim>;
    std::vector<Pressure> sensors = {}; ///< columns of history.csv
    std::vector<Depth> gauges = {};

    /// Of the water, which runs to the left where it stands on the right.
    [[nodiscard]] spate::Front front() const
    {
        if (water.lo[0] == tank.lo[0]) return {spacing};
        return {.spacing = -spacing, .share = 0.005}; // the same share of it is not yet there
    }
};

/// \param name     default, lobovsky; big, small, seed or obstacle (3D); 2d (2D)
/// \param spacing  0: that of the case; else one that divides its boxes [m]
template <int Dim>
Column<Dim> column(std::string const& name, double spacing);
