// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The load of the developed dam break at any resolution: where its particles are, without what they do. Each
/// particle of the computed state is cut into m^3 on a lattice of its own; the markers of the tank are laid anew.
#pragma once

#include <spate/core/vec.hpp>

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace bench {

/// Species 0 is water, species 1 the tank: 1.0 x 0.4 x 0.5 m, open at the top, three layers of markers.
class Load {
public:
    static constexpr double spacing = 0.01, range = 2.4 * spacing; ///< of the computed state [m]

    /// \param file  position, velocity and density by id, as bench/support/developed.hpp writes them
    Load(std::string const& file, int m) : m_(m)
    {
        std::ifstream in(file, std::ios::binary | std::ios::ate);
        if (!in) throw std::runtime_error(file + " is not there: bash bench/run.sh step computes it");
        state_.resize(std::size_t(in.tellg()) / sizeof(double));
        in.seekg(0).read(reinterpret_cast<char*>(state_.data()), std::streamsize(state_.size() * sizeof(double)));
    }
    [[nodiscard]] int finer() const { return m_; }
    [[nodiscard]] double reach() const { return range / m_; }
    /// Places of the lattice, by species; of the tank's many are not occupied.
    [[nodiscard]] std::size_t places(int s) const
    {
        if (s == 0) return state_.size() / 7 * children();
        return std::size_t(along(0)) * std::size_t(along(1)) * std::size_t(along(2));
    }
    [[nodiscard]] bool occupied(int s, std::size_t id) const
    {
        if (s == 0) return true;
        std::size_t rest = id;
        bool inside = true;
        for (int c = 0; c < 3; ++c) {
            const auto n = std::size_t(along(c));
            const auto k = int(rest % n);
            rest /= n;
            inside = inside && k >= layers && k < layers + size[c] * m_;
        }
        return !inside;
    }
    /// \param t  moved on for so long, each at its own speed [s]
    [[nodiscard]] spate::Vec<3, double> at(int s, std::size_t id, double t = 0) const
    {
        const double dx = spacing / m_;
        spate::Vec<3, double> x;
        std::size_t rest = s == 0 ? id % children() : id;
        for (int c = 0; c < 3; ++c) {
            const auto n = std::size_t(s == 0 ? m_ : along(c));
            const auto k = double(rest % n);
            rest /= n;
            if (s == 1) x[c] = (k - layers + 0.5) * dx;
            else {
                double const* d = &state_[7 * (id / children())];
                x[c] = d[c] + t * d[3 + c] + (k + 0.5) * dx - 0.5 * spacing;
            }
        }
        return x;
    }

private:
    static constexpr int layers = 3, size[3] = {100, 40, 50};
    [[nodiscard]] std::size_t children() const { return std::size_t(m_) * std::size_t(m_) * std::size_t(m_); }
    [[nodiscard]] int along(int c) const { return size[c] * m_ + (c == 2 ? layers : 2 * layers); }

    int m_;
    std::vector<double> state_;
};

} // namespace bench
