// SPDX-License-Identifier: BSD-3-Clause
// Sums over an infinite square lattice, written out from the formulas and not from the library's kernels, and the table
// that they must give. With them the equations of small waves on a lattice have exact solutions.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace lattice {

/// f'(q)/q of a kernel of support 2h and its sigma, for h = 1.
struct Shape {
    std::string name; // as in the table
    double (*g)(double q);
    double sigma;
};
template <int Dim>
Shape cubic()
{
    constexpr double pi = std::numbers::pi, s[] = {1.0 / 6, 5 / (14 * pi), 1 / (4 * pi)};
    return {"cubic", [](double q) { return q < 1 ? -12 + 9 * q : q < 2 ? -3 * (2 - q) * (2 - q) / q : 0; }, s[Dim - 1]};
}
template <int Dim>
Shape wendland_c2()
{
    static_assert(Dim > 1);
    constexpr double pi = std::numbers::pi, s[] = {0, 7 / (4 * pi), 21 / (16 * pi)};
    return {"wc2", [](double q) { return q < 2 ? -5 * std::pow(1 - q / 2, 3) : 0; }, s[Dim - 1]};
}

/// f(x, r^2, G) for each neighbour of the origin on the lattice of spacing 1, grad W = G x.
template <int Dim>
void each(Shape const& shape, double h, auto const& f)
{
    const int n = int(2 * h) + 1;
    std::array<int, 3> k{};
    for (k[2] = Dim > 2 ? -n : 0; k[2] <= (Dim > 2 ? n : 0); ++k[2])
        for (k[1] = Dim > 1 ? -n : 0; k[1] <= (Dim > 1 ? n : 0); ++k[1])
            for (k[0] = -n; k[0] <= n; ++k[0]) {
                const std::array<double, 3> x{double(k[0]), double(k[1]), double(k[2])};
                const double r2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
                if (r2 > 0) f(x, r2, shape.sigma / std::pow(h, Dim + 2) * shape.g(std::sqrt(r2) / h));
            }
}
/// |k_eff|: the symbol of the gradient for a wave vector: omega = c0 k_eff.
template <int Dim>
double k_eff(Shape const& shape, double h, std::array<double, 3> const& k)
{
    std::array<double, 3> sum{};
    each<Dim>(shape, h, [&](auto const& x, double, double G) {
        const double s = std::sin(k[0] * x[0] + k[1] * x[1] + k[2] * x[2]);
        for (std::size_t c = 0; c < 3; ++c) sum[c] -= s * G * x[c];
    });
    return std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
}
/// Decay rate over nu of a wave along x under the Morris form of viscosity, [1/length^2].
template <int Dim>
double laplacian(Shape const& shape, double h, double k, double eps)
{
    double sum = 0;
    each<Dim>(shape, h, [&](auto const& x, double r2, double G) {
        sum -= 2 * G * r2 / (r2 + eps * h * h) * (1 - std::cos(k * x[0]));
    });
    return sum;
}

/// An entry of tests/data/kernel_lattice_constants.csv or kernel_stability_constants.csv.
inline double table(std::string const& file, std::string const& kernel, int dim, double h, std::string const& column)
{
    const auto path = std::filesystem::path(__FILE__).parent_path().parent_path() / "data" / file;
    std::ifstream in(path);
    if (!in) throw std::runtime_error("cannot read " + path.string());
    auto cells = [](std::string const& line) {
        std::vector<std::string> all;
        std::istringstream s(line);
        for (std::string cell; std::getline(s, cell, ',');) all.push_back(cell);
        return all;
    };
    std::vector<std::string> head;
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line[0] == '#') continue;
        const auto row = cells(line);
        if (head.empty()) {
            head = row;
            continue;
        }
        if (row[0] != kernel || std::stoi(row[1]) != dim || std::abs(std::stod(row[2]) - h) > 1e-9) continue;
        for (std::size_t k = 0; k < head.size(); ++k)
            if (head[k] == column) return std::stod(row[k]);
    }
    throw std::runtime_error("no " + column + " of " + kernel + " in " + file);
}

} // namespace lattice
