// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Values that a term computes with: a scalar, or a SIMD pack of scalars with the same operators.
/// The only header that names xsimd or an intrinsic; terms see arithmetic, where, max, min, abs and sqrt.
#pragma once

#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#if defined(__GNUC__) && !defined(__clang__)
// GCC PR105593: false positives inside _mm512 intrinsics. Not restored: g++ raises them where the code is inlined.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif
#include <xsimd/xsimd.hpp>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#ifdef __FAST_MATH__
#error "spate: do not compile with -ffast-math: the watch must see NaN, and bits must not depend on the optimiser"
#endif

namespace spate {

template <class T>
concept Real = std::same_as<T, double> || std::same_as<T, float>;

namespace detail {
template <class B>
struct ScalarOf {
    using type = B;
};
template <class T, class A>
struct ScalarOf<xsimd::batch<T, A>> {
    using type = T;
};
template <class B>
using scalar_of = typename ScalarOf<B>::type;

template <class T>
void only_read()
{
    static_assert(sizeof(T) == 0, "spate: the term changes a field that it only reads; name it in the term's writes or "
                                  "adds (a pair term changes i only)");
}
} // namespace detail

namespace detail {
/// The lanes in which a comparison of packs holds. Not a bool: on AVX-512 a mask is an integer, and `if`
/// would take it.
template <class M>
struct LaneMask {
    M m;
    template <class U = void>
    explicit operator bool() const
    {
        static_assert(sizeof(U*) == 0, "spate: a condition on packs is where(condition, a, b), not if, ?: or &&");
        return false;
    }
    [[gnu::always_inline]] friend LaneMask operator&(LaneMask const& a, LaneMask const& b) { return {a.m & b.m}; }
    [[gnu::always_inline]] friend LaneMask operator|(LaneMask const& a, LaneMask const& b) { return {a.m | b.m}; }
};
template <class M>
[[gnu::always_inline]] inline auto mask(M m)
{
    if constexpr (std::same_as<M, bool>) return m;
    else return LaneMask<M>{m};
}
} // namespace detail

/// Lanes of a SIMD register (or one scalar) with the operators of a number. Any arithmetic constant converts to it, so
/// that a term reads the same in double and in float.
template <class B>
struct Lanes {
    B b;

    Lanes() = default;
    [[gnu::always_inline]] Lanes(B const& value) : b(value) {}
    template <class U>
    requires(std::is_arithmetic_v<U> && !std::same_as<U, B>) [[gnu::always_inline]] Lanes(U value)
        : b(static_cast<detail::scalar_of<B>>(value))
    {}
    [[gnu::always_inline]] friend Lanes operator+(Lanes const& x, Lanes const& y) { return x.b + y.b; }
    [[gnu::always_inline]] friend Lanes operator-(Lanes const& x, Lanes const& y) { return x.b - y.b; }
    [[gnu::always_inline]] friend Lanes operator*(Lanes const& x, Lanes const& y) { return x.b * y.b; }
    [[gnu::always_inline]] friend Lanes operator/(Lanes const& x, Lanes const& y) { return x.b / y.b; }
    [[gnu::always_inline]] friend Lanes operator-(Lanes const& x) { return -x.b; }
    [[gnu::always_inline]] Lanes& operator+=(Lanes const& y) { return *this = *this + y; }
    [[gnu::always_inline]] Lanes& operator-=(Lanes const& y) { return *this = *this - y; }
    [[gnu::always_inline]] Lanes& operator*=(Lanes const& y) { return *this = *this * y; }
    template <class U>
    requires(std::is_arithmetic_v<U>) [[gnu::always_inline]] Lanes& operator=(U value) { return *this = Lanes(value); }
    // Fields that a term may only read are const: these say so.
    template <class U>
    requires(std::same_as<U, Lanes> || std::is_arithmetic_v<U>) void operator=(U const&) const
    {
        detail::only_read<U>();
    }
    void operator+=(Lanes const&) const { detail::only_read<B>(); }
    void operator-=(Lanes const&) const { detail::only_read<B>(); }
    void operator*=(Lanes const&) const { detail::only_read<B>(); }
    [[gnu::always_inline]] friend auto operator<(Lanes const& x, Lanes const& y) { return detail::mask(x.b < y.b); }
    [[gnu::always_inline]] friend auto operator>(Lanes const& x, Lanes const& y) { return detail::mask(x.b > y.b); }
    [[gnu::always_inline]] friend auto operator<=(Lanes const& x, Lanes const& y) { return detail::mask(x.b <= y.b); }
    [[gnu::always_inline]] friend auto operator>=(Lanes const& x, Lanes const& y) { return detail::mask(x.b >= y.b); }
    [[gnu::always_inline]] friend auto operator==(Lanes const& x, Lanes const& y) { return detail::mask(x.b == y.b); }
};

namespace detail {
template <class V>
struct LanesTraits {
    using scalar = V;
    static constexpr int width = 1;
};
template <class T>
struct LanesTraits<Lanes<T>> {
    using scalar = T;
    static constexpr int width = 1;
};
template <class T, class A>
struct LanesTraits<Lanes<xsimd::batch<T, A>>> {
    using scalar = T;
    static constexpr int width = int(xsimd::batch<T, A>::size);
};
} // namespace detail

/// As many values of T as one SIMD register holds.
template <Real T>
using Pack = Lanes<xsimd::batch<T>>;
/// One value of T: the exact oracle of the pack. (float is wrapped: a bare float would compute in double beside a
/// double parameter.)
template <Real T>
using Scalar = std::conditional_t<std::same_as<T, double>, double, Lanes<T>>;

/// Lanes of V: 1 for a scalar.
template <class V>
inline constexpr int width = detail::LanesTraits<V>::width;
/// The scalar of which V is made.
template <class V>
using scalar_t = typename detail::LanesTraits<V>::scalar;

/// m ? a : b, lane by lane: the condition of a term (an `if` on a pack does not compile).
[[gnu::always_inline]] inline double where(bool m, double a, double b) { return m ? a : b; }
template <class B>
[[gnu::always_inline]] inline Lanes<B> where(auto const& m, Lanes<B> const& a, std::type_identity_t<Lanes<B>> const& b)
{
    if constexpr (std::is_arithmetic_v<B>) return m ? a : b;
    else return xsimd::select(m.m, a.b, b.b);
}
[[gnu::always_inline]] inline double max(double a, double b) { return a > b ? a : b; }
template <class B>
[[gnu::always_inline]] inline Lanes<B> max(Lanes<B> const& a, std::type_identity_t<Lanes<B>> const& b)
{
    if constexpr (std::is_arithmetic_v<B>) return where(a > b, a, b);
    else return xsimd::max(a.b, b.b);
}
[[gnu::always_inline]] inline double min(double a, double b) { return a < b ? a : b; }
template <class B>
[[gnu::always_inline]] inline Lanes<B> min(Lanes<B> const& a, std::type_identity_t<Lanes<B>> const& b)
{
    if constexpr (std::is_arithmetic_v<B>) return where(a < b, a, b);
    else return xsimd::min(a.b, b.b);
}
using std::abs; // not one of our own: beside `using namespace spate` a plain abs(x) would be ambiguous
template <class B>
[[gnu::always_inline]] inline Lanes<B> abs(Lanes<B> const& a)
{
    if constexpr (std::is_arithmetic_v<B>) return std::fabs(a.b);
    else return xsimd::abs(a.b);
}
using std::sqrt;
template <class B>
[[gnu::always_inline]] inline Lanes<B> sqrt(Lanes<B> const& a)
{
    if constexpr (std::is_arithmetic_v<B>) return std::sqrt(a.b);
#if defined(__AVX512F__)
    // Not _mm512_sqrt_pd: in g++ it merges into an undefined value, so that no two roots of a number are the same one and
    // none is moved out of a loop.
    else if constexpr (std::same_as<B, xsimd::batch<double>>) return B(_mm512_maskz_sqrt_pd(__mmask8(-1), a.b));
#endif
    else return xsimd::sqrt(a.b);
}
[[gnu::always_inline]] inline bool any(bool m) { return m; }
template <class M>
[[gnu::always_inline]] inline bool any(detail::LaneMask<M> const& m)
{
    return xsimd::any(m.m);
}
/// One bit a lane.
[[gnu::always_inline]] inline unsigned bits(bool m) { return unsigned(m); }
template <class T, class A>
[[gnu::always_inline]] inline unsigned bits(detail::LaneMask<xsimd::batch_bool<T, A>> const& m)
{
#if defined(__AVX512F__)
    return unsigned(m.m.data);
#elif defined(__AVX2__)
    if constexpr (std::same_as<T, double>) return unsigned(_mm256_movemask_pd(m.m.data));
    else return unsigned(_mm256_movemask_ps(m.m.data));
#else
    constexpr auto W = xsimd::batch_bool<T, A>::size;
    bool lane[W];
    m.m.store_unaligned(lane);
    unsigned all = 0;
    for (std::size_t k = 0; k < W; ++k) all |= unsigned(lane[k]) << k;
    return all;
#endif
}

/// V from width<V> values at p, of any alignment.
template <class V>
[[gnu::always_inline]] inline V load(scalar_t<V> const* p)
{
    if constexpr (width<V> == 1) return *p;
    else return V(decltype(V::b)::load_unaligned(p));
}
/// The same from values of another precision.
template <class V, Real T>
requires(!std::same_as<T, scalar_t<V>>) [[gnu::always_inline]] inline V load(T const* p)
{
    alignas(64) scalar_t<V> lane[std::size_t(width<V>)];
    for (int k = 0; k < width<V>; ++k) lane[k] = scalar_t<V>(p[k]);
    return load<V>(lane);
}
template <class V>
[[gnu::always_inline]] inline void store(scalar_t<V>* p, V const& v)
{
    if constexpr (std::is_arithmetic_v<V>) *p = v;
    else if constexpr (width<V> == 1) *p = v.b;
    else v.b.store_unaligned(p);
}
/// Stores the first `lanes` lanes only: the end of a cell must not touch the next one.
template <class V, Real T>
[[gnu::always_inline]] inline void store_first(T* p, V const& v, int lanes)
{
    if constexpr (std::same_as<T, scalar_t<V>>)
        if (lanes >= width<V>) return store(p, v);
    alignas(64) scalar_t<V> lane[std::size_t(width<V>)];
    store(lane, v);
    for (int k = 0; k < lanes; ++k) p[k] = T(lane[k]);
}
/// The largest of the first lanes; a NaN in a lane may be lost (the watch looks for NaN by itself).
template <class V>
[[gnu::always_inline]] inline scalar_t<V> largest(V const& v, int lanes = width<V>)
{
    alignas(64) scalar_t<V> lane[std::size_t(width<V>)];
    store(lane, v);
    scalar_t<V> m = lane[0];
    for (int k = 1; k < lanes; ++k) m = lane[k] > m ? lane[k] : m;
    return m;
}

namespace detail {
#if defined(__AVX512F__)
template <int Count, int f>
[[gnu::always_inline]] inline void transpose(double const* const (&p)[8], Pack<double> (&out)[std::size_t(Count)])
{
    auto two = [&](int a, int b) __attribute__((always_inline))
    {
        return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(p[a] + f)), _mm256_loadu_pd(p[b] + f), 1);
    };
    const __m512d r0 = two(0, 2), r1 = two(1, 3), r2 = two(4, 6), r3 = two(5, 7);
    const __m512d t0 = _mm512_unpacklo_pd(r0, r1), t1 = _mm512_unpackhi_pd(r0, r1);
    const __m512d t2 = _mm512_unpacklo_pd(r2, r3), t3 = _mm512_unpackhi_pd(r2, r3);
    out[f].b = _mm512_shuffle_f64x2(t0, t2, 0x88);
    if constexpr (f + 1 < Count) out[f + 1].b = _mm512_shuffle_f64x2(t1, t3, 0x88);
    if constexpr (f + 2 < Count) out[f + 2].b = _mm512_shuffle_f64x2(t0, t2, 0xdd);
    if constexpr (f + 3 < Count) out[f + 3].b = _mm512_shuffle_f64x2(t1, t3, 0xdd);
}
template <int Count, int f> // a rest of one or two values
[[gnu::always_inline]] inline void transpose_rest(double const* const (&p)[8], Pack<double> (&out)[std::size_t(Count)])
{
    auto four = [&](int a, int b, int c, int d) __attribute__((always_inline))
    {
        const __m256d lo =
            _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(p[a] + f)), _mm_loadu_pd(p[b] + f), 1);
        const __m256d hi =
            _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(p[c] + f)), _mm_loadu_pd(p[d] + f), 1);
        return _mm512_insertf64x4(_mm512_castpd256_pd512(lo), hi, 1);
    };
    const __m512d a = four(0, 2, 4, 6), b = four(1, 3, 5, 7);
    out[f].b = _mm512_unpacklo_pd(a, b);
    if constexpr (f + 1 < Count) out[f + 1].b = _mm512_unpackhi_pd(a, b);
}
template <int Count, int f>
[[gnu::always_inline]] inline void transpose(float const* const (&p)[16], Pack<float> (&out)[std::size_t(Count)])
{
    auto four = [&](int k) __attribute__((always_inline))
    { // records k, k + 4, k + 8, k + 12
        const __m256 lo =
            _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(p[k] + f)), _mm_loadu_ps(p[k + 4] + f), 1);
        const __m256 hi =
            _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(p[k + 8] + f)), _mm_loadu_ps(p[k + 12] + f), 1);
        return _mm512_castpd_ps(
            _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_castps_pd(lo)), _mm256_castps_pd(hi), 1));
    };
    const __m512 r0 = four(0), r1 = four(1), r2 = four(2), r3 = four(3);
    const __m512d t0 = _mm512_castps_pd(_mm512_unpacklo_ps(r0, r1)), t1 = _mm512_castps_pd(_mm512_unpackhi_ps(r0, r1));
    const __m512d t2 = _mm512_castps_pd(_mm512_unpacklo_ps(r2, r3)), t3 = _mm512_castps_pd(_mm512_unpackhi_ps(r2, r3));
    out[f].b = _mm512_castpd_ps(_mm512_unpacklo_pd(t0, t2));
    if constexpr (f + 1 < Count) out[f + 1].b = _mm512_castpd_ps(_mm512_unpackhi_pd(t0, t2));
    if constexpr (f + 2 < Count) out[f + 2].b = _mm512_castpd_ps(_mm512_unpacklo_pd(t1, t3));
    if constexpr (f + 3 < Count) out[f + 3].b = _mm512_castpd_ps(_mm512_unpackhi_pd(t1, t3));
}
#elif defined(__AVX2__)
template <int Count, int f>
[[gnu::always_inline]] inline void transpose(double const* const (&p)[4], Pack<double> (&out)[std::size_t(Count)])
{
    const __m256d a = _mm256_loadu_pd(p[0] + f), b = _mm256_loadu_pd(p[1] + f);
    const __m256d c = _mm256_loadu_pd(p[2] + f), d = _mm256_loadu_pd(p[3] + f);
    const __m256d t0 = _mm256_unpacklo_pd(a, b), t1 = _mm256_unpackhi_pd(a, b);
    const __m256d t2 = _mm256_unpacklo_pd(c, d), t3 = _mm256_unpackhi_pd(c, d);
    out[f].b = _mm256_permute2f128_pd(t0, t2, 0x20);
    if constexpr (f + 1 < Count) out[f + 1].b = _mm256_permute2f128_pd(t1, t3, 0x20);
    if constexpr (f + 2 < Count) out[f + 2].b = _mm256_permute2f128_pd(t0, t2, 0x31);
    if constexpr (f + 3 < Count) out[f + 3].b = _mm256_permute2f128_pd(t1, t3, 0x31);
}
#endif

template <class T>
inline constexpr bool transposes_in_registers =
#if defined(__AVX512F__)
    std::same_as<T, double> || std::same_as<T, float>;
#elif defined(__AVX2__)
    std::same_as<T, double>;
#else
    false;
#endif
} // namespace detail

/// out[f] lane k = base[at[k] + f], f < Count: width<V> records, transposed in registers.
/// May read up to three values beyond the last record.
template <int Stride, int Count, class V>
[[gnu::always_inline]] inline void load_records(scalar_t<V> const* base, std::int32_t const* at,
                                                V (&out)[std::size_t(Count)])
{
    using T = scalar_t<V>;
    constexpr int W = width<V>;
    if constexpr (W == 1) {
        for (int f = 0; f < Count; ++f) out[f] = base[std::size_t(std::uint32_t(*at)) + std::size_t(f)];
    }
    else if constexpr (detail::transposes_in_registers<T> && (Stride > 2 || (Stride == 2 && W == 8))) {
        T const* p[std::size_t(W)];
        for (int k = 0; k < W; ++k) p[k] = base + std::size_t(std::uint32_t(at[k]));
#if defined(__AVX512F__)
        constexpr bool rest = W == 8 && (Count % 4 == 1 || Count % 4 == 2);
#else
        [[maybe_unused]] constexpr bool rest = false;
#endif
#if defined(__AVX2__) || defined(__AVX512F__)
        constexpr int fours = rest ? Count / 4 : (Count + 3) / 4;
        [&]<std::size_t... g>(std::index_sequence<g...>) __attribute__((always_inline))
        {
            (detail::transpose<Count, int(4 * g)>(p, out), ...);
        }
        (std::make_index_sequence<std::size_t(fours)>{});
#endif
#if defined(__AVX512F__)
        if constexpr (rest) detail::transpose_rest<Count, Count / 4 * 4>(p, out);
#endif
    }
    else {
        alignas(64) T t[std::size_t(Count)][std::size_t(W)];
        for (int k = 0; k < W; ++k)
            for (int f = 0; f < Count; ++f) t[f][k] = base[std::size_t(std::uint32_t(at[k])) + std::size_t(f)];
        for (int f = 0; f < Count; ++f) out[f] = V(decltype(V::b)::load_aligned(t[f]));
    }
}

/// Some lanes of a pack, whose values lie side by side in memory.
template <class V>
class SomeLanes {
public:
    using T = scalar_t<V>;
    [[gnu::always_inline]] explicit SomeLanes(unsigned set) : set_(set) {}

    /// Values from p on in these lanes, in order; the others are 0. May read width<V> values.
    [[gnu::always_inline]] V load(T const* p) const
    {
#if defined(__AVX512F__) && defined(__BMI2__)
        if constexpr (in_registers)
            return V(decltype(V::b)(_mm512_maskz_permutexvar_pd(
                __mmask8(set_), lanes(_pdep_u64(0x0706050403020100u, bytes())), _mm512_loadu_pd(p))));
        else
#endif
        {
            T lane[std::size_t(width<V>)];
            for (int k = 0; k < width<V>; ++k) lane[k] = ((set_ >> k) & 1) != 0 ? *p++ : T(0);
            return spate::load<V>(lane);
        }
    }
    /// These lanes of v to p on.
    [[gnu::always_inline]] void store(T* p, V const& v) const
    {
#if defined(__AVX512F__) && defined(__BMI2__)
        if constexpr (in_registers)
            _mm512_mask_storeu_pd(p, __mmask8((1u << std::popcount(set_)) - 1),
                                  _mm512_permutexvar_pd(lanes(_pext_u64(0x0706050403020100u, bytes())), v.b));
        else
#endif
        {
            T lane[std::size_t(width<V>)];
            spate::store(lane, v);
            for (int k = 0; k < width<V>; ++k)
                if (((set_ >> k) & 1) != 0) *p++ = lane[k];
        }
    }

private:
#if defined(__AVX512F__) && defined(__BMI2__)
    // Not expand and compress: compilers make one with memory of them, which takes a hundred cycles on some processors.
    static constexpr bool in_registers = std::same_as<V, Pack<double>>;
    [[nodiscard, gnu::always_inline]] std::uint64_t bytes() const
    {
        return _pdep_u64(set_, 0x0101010101010101u) * 0xff; // one a lane
    }
    [[gnu::always_inline]] static __m512i lanes(std::uint64_t of_bytes)
    {
        return _mm512_cvtepu8_epi64(_mm_cvtsi64_si128(std::int64_t(of_bytes)));
    }
#endif
    unsigned set_;
};

/// to[k * W + l] = factor * row[l][s + k] for k, l < 8: eight entries of eight lists, interleaved.
inline void interleave_8(std::int32_t const* const* row, std::int32_t s, int W, std::int32_t factor, std::int32_t* to)
{
#if defined(__AVX2__)
    __m256i r[8], t[8];
    for (int l = 0; l < 8; ++l)
        r[l] = _mm256_mullo_epi32(_mm256_loadu_si256(reinterpret_cast<__m256i const*>(row[l] + s)),
                                  _mm256_set1_epi32(factor));
    for (int l = 0; l < 8; l += 2) { // pairs of lists, then fours, then eights
        t[l] = _mm256_unpacklo_epi32(r[l], r[l + 1]);
        t[l + 1] = _mm256_unpackhi_epi32(r[l], r[l + 1]);
    }
    for (int l = 0; l < 8; l += 4) {
        r[l] = _mm256_unpacklo_epi64(t[l], t[l + 2]);
        r[l + 1] = _mm256_unpackhi_epi64(t[l], t[l + 2]);
        r[l + 2] = _mm256_unpacklo_epi64(t[l + 1], t[l + 3]);
        r[l + 3] = _mm256_unpackhi_epi64(t[l + 1], t[l + 3]);
    }
    for (int k = 0; k < 4; ++k) {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + std::ptrdiff_t(k) * W),
                            _mm256_permute2x128_si256(r[k], r[k + 4], 0x20));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + std::ptrdiff_t(k + 4) * W),
                            _mm256_permute2x128_si256(r[k], r[k + 4], 0x31));
    }
#else
    for (int k = 0; k < 8; ++k)
        for (int l = 0; l < 8; ++l) to[k * W + l] = row[l][s + k] * factor;
#endif
}

/// Appends to `list` the numbers first + k of those of 16 candidates that are nearer than the reach; at most
/// `count` candidates count. Writes up to 16 entries past the returned end. Returns how many were appended and
/// adds to `within` how many of them are nearer than the inner distance.
template <int Dim>
[[gnu::always_inline]] inline int select_near(float const* const (&x)[std::size_t(Dim)], std::int32_t const* number,
                                              int count, float const (&at)[std::size_t(Dim)], float reach2,
                                              float inner2, std::int32_t self, std::int32_t* list, std::int64_t& within)
{
#if defined(__AVX512F__)
    __m512 d2 = _mm512_setzero_ps();
    for (int c = 0; c < Dim; ++c) {
        const __m512 d = _mm512_sub_ps(_mm512_loadu_ps(x[c]), _mm512_set1_ps(at[c]));
        d2 = _mm512_add_ps(d2, _mm512_mul_ps(d, d));
    }
    const __mmask16 valid = count >= 16 ? __mmask16(0xffff) : __mmask16((1u << count) - 1u);
    const __m512i J = _mm512_loadu_si512(number);
    const __mmask16 other = _mm512_mask_cmp_epi32_mask(valid, J, _mm512_set1_epi32(self), _MM_CMPINT_NE);
    const __mmask16 near = _mm512_mask_cmp_ps_mask(other, d2, _mm512_set1_ps(reach2), _CMP_LT_OQ);
    const __mmask16 inner = _mm512_mask_cmp_ps_mask(near, d2, _mm512_set1_ps(inner2), _CMP_LT_OQ);
    _mm512_storeu_si512(list, _mm512_maskz_compress_epi32(near, J));
    within += std::popcount(unsigned(inner));
    return std::popcount(unsigned(near));
#else
    int m = 0;
    for (int k = 0; k < (count < 16 ? count : 16); ++k) {
        float d2 = 0;
        for (int c = 0; c < Dim; ++c) {
            const float d = x[c][k] - at[c];
            d2 += d * d;
        }
        const bool near = number[k] != self && d2 < reach2;
        list[m] = number[k];
        m += near;
        within += near && d2 < inner2;
    }
    return m;
#endif
}

} // namespace spate
