// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A start from a data file of LAMMPS, atom_style sphere, SI units. What has no meaning here is refused, not skipped.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "spate/io/detail/lines.hpp"
#include "spate/io/start.hpp"

namespace spate::io {

namespace detail {

/// Reads the header, then the sections, into atoms in the order of their numbers.
class LammpsData {
public:
    struct Atom {
        std::int64_t number = 0;
        double diameter = 0, density = 0; ///< [m], [kg/m^3]
        Vec<3, double> x{}, v{}, spin{};  ///< [m], [m/s], [1/s]
    };

    [[gnu::cold]] explicit LammpsData(std::filesystem::path const& file) : lines_(file)
    {
        const std::string title = lines_.any();
        const std::size_t units = title.find("units = ");
        if (units != title.npos && trimmed(std::string_view(title).substr(units + 8)) != "si")
            lines_.refuse("the units", title.substr(units + 8), "si: metre, kilogram, second");
        header();
        while (!lines_.text().empty()) section();
        if (!read_atoms_) lines_.refuse_file("without a section Atoms", "a data file of atom_style sphere");
        std::sort(atoms_.begin(), atoms_.end(), [](Atom const& a, Atom const& b) { return a.number < b.number; });
        for (std::size_t k = 1; k < atoms_.size(); ++k)
            if (atoms_[k].number == atoms_[k - 1].number)
                lines_.refuse_file("with atom " + std::to_string(atoms_[k].number) + " twice", "each number once");
        give_velocities();
    }
    [[nodiscard]] std::vector<Atom> const& atoms() const { return atoms_; }
    [[nodiscard]] Box<3> const& box() const { return box_; }
    /// Refuses a coordinate that is not 0.
    void require_flat(Atom const& a) const
    {
        for (double out : {a.x[2], a.v[2], a.spin[0], a.spin[1]})
            if (out != 0)
                lines_.refuse_file("of three dimensions: atom " + std::to_string(a.number) + " leaves the plane z = 0",
                                   "one with z = 0, vz = 0 and spin about z alone");
    }

private:
    /// Up to the first line that begins with a word.
    void header()
    {
        std::array<bool, 3> bounded{};
        std::int64_t atoms = -1;
        while (lines_.next()) {
            const auto w = lines_.words();
            double first = 0;
            if (!reads_as(w[0], first)) break;
            const std::string_view last = w.back();
            if (w.size() == 2 && last == "atoms") atoms = lines_.whole_number(w[0], "the number of atoms");
            else if (w.size() == 3 && w[1] == "atom" && last == "types")
                types_ = lines_.whole_number(w[0], "the number of atom types");
            else if (w.size() == 4 && last.size() == 3 && last.substr(1) == "hi" && last[0] >= 'x' && last[0] <= 'z')
                bounded[bounds(w)] = true;
            else if (last == "yz" || last == "cvec" || last == "bvec" || last == "avec") tilt(w);
            else if (w.size() >= 2 && w[0] == "0") continue; // 0 bonds
            else lines_.refuse("the header", Lines::quoted(lines_.text()), "atoms, atom types, xlo xhi and the like");
        }
        if (atoms < 0) lines_.refuse_file("without the number of atoms", "N atoms in the header");
        if (atoms == 0) lines_.refuse_file("without particles", "1 atom or more");
        if (atoms > 4294967295) lines_.refuse_file("too long", "at most 4294967295 atoms");
        for (bool b : bounded)
            if (!b) lines_.refuse_file("without a box", "xlo xhi, ylo yhi and zlo zhi in the header");
        count_ = std::size_t(atoms);
    }
    std::size_t bounds(std::vector<std::string_view> const& w)
    {
        const auto axis = std::size_t(w[3][0] - 'x');
        const double lo = lines_.number(w[0], std::string(w[2])), hi = lines_.number(w[1], std::string(w[3]));
        if (w[2] != std::string{w[3][0], 'l', 'o'})
            lines_.refuse("the header", Lines::quoted(lines_.text()), "xlo xhi, ylo yhi or zlo zhi");
        if (!(hi > lo)) lines_.refuse(std::string(w[3]), text(hi), "above " + std::string(w[2]) + ", " + text(lo));
        box_.lo[int(axis)] = lo, box_.hi[int(axis)] = hi;
        return axis;
    }
    void tilt(std::vector<std::string_view> const& w) const
    {
        bool tilted = w.back() != "yz";
        for (auto word : w) {
            double value = 0;
            tilted = tilted || (reads_as(word, value) && value != 0);
        }
        if (tilted) lines_.refuse("the box", "tilted (" + std::string(lines_.text()) + ")", "a box of right angles");
    }
    void section()
    {
        const std::string name(lines_.text());
        if (name == "Atoms") {
            if (!lines_.comment().empty() && lines_.comment() != "sphere")
                lines_.refuse("the atom_style", std::string(lines_.comment()), "sphere");
            once(read_atoms_, name);
            entries(name, [&](auto const& w) { atom(w); });
        }
        else if (name == "Velocities") {
            once(read_velocities_, name);
            entries(name, [&](auto const& w) { velocity(w); });
        }
        else
            lines_.refuse("the section", Lines::quoted(name),
                          "Atoms or Velocities; write_data FILE nocoeff writes no other for spheres");
        lines_.next();
    }
    void once(bool& read, std::string const& name) const
    {
        if (read) lines_.refuse("the section", name + " for the second time", "each section once");
        read = true;
    }
    void entries(std::string const& name, auto const& entry)
    {
        for (std::size_t k = 0; k < count_; ++k) {
            double number = 0;
            const bool more = lines_.next();
            if (!more || !reads_as(lines_.words()[0], number))
                lines_.refuse_file("with " + std::to_string(k) + " entries of " + name,
                                   std::to_string(count_) + ", as in its header");
            entry(lines_.words());
        }
    }
    void atom(std::vector<std::string_view> const& w)
    {
        if (w.size() != 7 && w.size() != 10)
            lines_.refuse("the number of words", std::to_string(w.size()),
                          "7: number, type, diameter, density, x, y, z; or 10, with the image");
        Atom a;
        a.number = lines_.whole_number(w[0], "the number of the atom");
        if (a.number < 1) lines_.refuse("the number of the atom", std::to_string(a.number), "1 or above");
        const std::int64_t type = lines_.whole_number(w[1], "the type");
        if (type < 1 || type > types_)
            lines_.refuse("the type", std::to_string(type), "1 to " + std::to_string(types_) + ", as in the header");
        a.diameter = lines_.number(w[2], "the diameter"), a.density = lines_.number(w[3], "the density");
        if (!(a.diameter > 0)) lines_.refuse("the diameter", text(a.diameter), "above 0: a point has no contact");
        if (!(a.density > 0)) lines_.refuse("the density", text(a.density), "above 0");
        for (int c = 0; c < 3; ++c) a.x[c] = lines_.number(w[std::size_t(4 + c)], std::string(1, "xyz"[c]));
        atoms_.push_back(a);
    }
    void velocity(std::vector<std::string_view> const& w)
    {
        if (w.size() != 7)
            lines_.refuse("the number of words", std::to_string(w.size()), "7: number, vx, vy, vz, wx, wy, wz");
        Atom a;
        a.number = lines_.whole_number(w[0], "the number of the atom");
        for (int c = 0; c < 3; ++c) {
            a.v[c] = lines_.number(w[std::size_t(1 + c)], std::string("v") + "xyz"[c]);
            a.spin[c] = lines_.number(w[std::size_t(4 + c)], std::string("w") + "xyz"[c]);
        }
        moving_.push_back(a);
    }
    void give_velocities()
    {
        std::sort(moving_.begin(), moving_.end(), [](Atom const& a, Atom const& b) { return a.number < b.number; });
        for (std::size_t k = 0; k < moving_.size(); ++k) {
            if (moving_[k].number != atoms_[k].number)
                lines_.refuse_file("with a velocity of atom " +
                                       std::to_string(std::min(moving_[k].number, atoms_[k].number)) +
                                       " too few or too many",
                                   "one for each atom");
            atoms_[k].v = moving_[k].v, atoms_[k].spin = moving_[k].spin;
        }
    }

    Lines lines_;
    Box<3> box_{};
    std::size_t count_ = 0;
    std::int64_t types_ = 1;
    bool read_atoms_ = false, read_velocities_ = false;
    std::vector<Atom> atoms_, moving_;
};

} // namespace detail

/// Particles in the order of the atoms' numbers; without a section Velocities at rest. Mass is density times 4/3 pi r^3, in
/// 2D too, as LAMMPS has it; types and images are read over. Throws BadInput with the line that cannot be read.
template <int Dim>
[[gnu::cold]] Start<Dim> start_lammps(std::filesystem::path const& file)
{
    static_assert(Dim == 2 || Dim == 3, "spate: atoms of LAMMPS live in 2 or 3 dimensions");
    const detail::LammpsData data(file);
    Start<Dim> start;
    start.box.emplace();
    for (int c = 0; c < Dim; ++c) start.box->lo[c] = data.box().lo[c], start.box->hi[c] = data.box().hi[c];
    bool spins = false;
    for (auto const& a : data.atoms()) {
        if constexpr (Dim == 2) data.require_flat(a);
        Vec<Dim, double> x, v;
        for (int c = 0; c < Dim; ++c) x[c] = a.x[c], v[c] = a.v[c];
        const double r = a.diameter / 2;
        start.x.push_back(x), start.v.push_back(v);
        start.radius.push_back(r), start.mass.push_back(a.density * (4 * std::numbers::pi / 3 * r * r * r));
        start.spin.push_back(a.spin);
        spins = spins || a.spin != Vec<3, double>{};
    }
    if (!spins) start.spin.clear();
    return start;
}

} // namespace spate::io
