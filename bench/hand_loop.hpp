// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The loop that one would write by hand for one scene: Continuity<2>, PressureForce<2> and LaminarViscosity with
/// the cubic spline in 3D, on records (x, y, z, u, v, w, density, pressure). The yardstick of the engine's sweep.
#pragma once

#include <spate/core/pack.hpp> // for xsimd and intrinsics, and for its word with g++ about false warnings of theirs

#include <cstddef>
#include <cstdint>

namespace hand {

#if defined(__AVX512F__)
using Lanes = __m512d;
constexpr int width = 8;
inline Lanes all(double x) { return _mm512_set1_pd(x); }
inline Lanes of_targets(double const* column, std::int32_t const* target)
{
    return _mm512_i32gather_pd(_mm256_loadu_si256(reinterpret_cast<__m256i const*>(target)), column, 8);
}
inline void store(double* p, Lanes x) { _mm512_storeu_pd(p, x); }
inline Lanes root(Lanes x) { return _mm512_sqrt_pd(x); }
inline Lanes larger(Lanes a, Lanes b) { return _mm512_max_pd(a, b); }
inline Lanes if_less(Lanes a, Lanes b, Lanes yes, Lanes no)
{
    return _mm512_mask_blend_pd(_mm512_cmp_pd_mask(a, b, _CMP_LT_OQ), no, yes);
}
/// Halves of records 0 2, 1 3, 4 6, 5 7 side by side; then pairs, then fours.
[[gnu::always_inline]] inline void transpose(double const* const (&p)[8], int at, Lanes* out)
{
    auto two = [&](int a, int b) __attribute__((always_inline))
    {
        return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(p[a] + at)), _mm256_load_pd(p[b] + at), 1);
    };
    const Lanes r0 = two(0, 2), r1 = two(1, 3), r2 = two(4, 6), r3 = two(5, 7);
    const Lanes t0 = _mm512_unpacklo_pd(r0, r1), t1 = _mm512_unpackhi_pd(r0, r1);
    const Lanes t2 = _mm512_unpacklo_pd(r2, r3), t3 = _mm512_unpackhi_pd(r2, r3);
    out[0] = _mm512_shuffle_f64x2(t0, t2, 0x88), out[1] = _mm512_shuffle_f64x2(t1, t3, 0x88);
    out[2] = _mm512_shuffle_f64x2(t0, t2, 0xdd), out[3] = _mm512_shuffle_f64x2(t1, t3, 0xdd);
}
[[gnu::always_inline]] inline void gather(double const* record, std::int32_t const* place, Lanes (&f)[8])
{
    auto at = [&](int k) {
        return record + std::uint32_t(place[k]);
    }; // one by one: g++ would make a vector of the places
    double const* const p[8] = {at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
    transpose(p, 0, f);
    transpose(p, 4, f + 4);
}
#else
using Lanes = xsimd::batch<double>;
constexpr int width = int(Lanes::size);
inline Lanes all(double x) { return Lanes(x); }
inline Lanes of_targets(double const* column, std::int32_t const* target)
{
    double t[std::size_t(width)];
    for (int k = 0; k < width; ++k) t[k] = column[target[k]];
    return Lanes::load_unaligned(t);
}
inline void store(double* p, Lanes x) { x.store_unaligned(p); }
inline Lanes root(Lanes x) { return xsimd::sqrt(x); }
inline Lanes larger(Lanes a, Lanes b) { return xsimd::max(a, b); }
inline Lanes if_less(Lanes a, Lanes b, Lanes yes, Lanes no) { return xsimd::select(a < b, yes, no); }
inline void gather(double const* record, std::int32_t const* place, Lanes (&f)[8])
{
    double t[8][std::size_t(width)];
    for (int k = 0; k < width; ++k)
        for (int c = 0; c < 8; ++c) t[c][k] = record[std::size_t(std::uint32_t(place[k])) + std::size_t(c)];
    for (int c = 0; c < 8; ++c) f[c] = Lanes::load_unaligned(t[c]);
}
#endif

/// The particles of a cell, and where their sums go.
struct Scene {
    double const* record; ///< all particles, then the sentinel
    double const *x, *y, *z, *u, *v, *w, *rho, *p;
    double *drho, *ax, *ay, *az;
    double h, sigma, mass, mu, eps; ///< sigma: of the kernel, h^-3 in it
};
/// Its lists: the k-th neighbours of block b are records place[width * (begin[b] + k)] and on; lane l is target[b * width + l].
struct List {
    std::int32_t const *begin, *target, *place;
    std::size_t blocks;
    int first, targets; ///< first particle of the cell, and how many
};
inline void scatter(double* column, List const& list, std::size_t block, Lanes x)
{
    double t[std::size_t(width)];
    store(t, x);
    std::int32_t const* target = list.target + block * std::size_t(width);
    const int lanes = list.targets - int(block) * width;
    for (int k = 0; k < (lanes < width ? lanes : width); ++k) column[list.first + target[k]] = t[k];
}

inline void sweep(Scene const& s, List const& list)
{
    const Lanes zero = all(0), one = all(1), two = all(2), three = all(3), nine = all(9), twelve = all(12);
    const Lanes inverse_h = all(1 / s.h), scale = all(-s.mass * s.sigma / (s.h * s.h));
    const Lanes eps_h2 = all(s.eps * s.h * s.h), mu8 = all(8 * s.mu); // 2 mu over ((rho_i + rho_j) / 2)^2
    for (std::size_t b = 0; b < list.blocks; ++b) {
        auto mine = [&](double const* column) {
            return of_targets(column + list.first, list.target + b * std::size_t(width));
        };
        const Lanes xi = mine(s.x), yi = mine(s.y), zi = mine(s.z), ui = mine(s.u), vi = mine(s.v), wi = mine(s.w);
        const Lanes rho_i = mine(s.rho), f_i = mine(s.p) / (rho_i * rho_i);
        Lanes drho = zero, ax = zero, ay = zero, az = zero;
        std::int32_t const* const end = list.place + std::size_t(list.begin[b + 1]) * std::size_t(width);
        for (std::int32_t const* k = list.place + std::size_t(list.begin[b]) * std::size_t(width); k != end;
             k += width) {
            Lanes j[8];
            gather(s.record, k, j);
            const Lanes x = xi - j[0], y = yi - j[1], z = zi - j[2];
            const Lanes r2 = x * x + y * y + z * z;
            const Lanes q = root(r2) * inverse_h, t = larger(two - q, zero);
            const Lanes F = scale * if_less(q, one, twelve - nine * q, three * (t * t) / q); // m |grad W| / r
            const Lanes u = ui - j[3], v = vi - j[4], w = wi - j[5];
            drho = drho + F * (u * x + v * y + w * z);
            const Lanes A = F * (f_i + j[7] / (j[6] * j[6]));
            const Lanes rho = rho_i + j[6];
            const Lanes B = F * (mu8 * r2) / (rho * rho * (r2 + eps_h2));
            ax = ax - (A * x - B * u), ay = ay - (A * y - B * v), az = az - (A * z - B * w);
        }
        scatter(s.drho, list, b, drho);
        scatter(s.ax, list, b, ax), scatter(s.ay, list, b, ay), scatter(s.az, list, b, az);
    }
}

} // namespace hand
