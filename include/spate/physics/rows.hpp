// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A matrix of each particle as vector fields, one a row; and what a term does with a small symmetric one.
#pragma once

#include "spate/core/fields.hpp"

namespace spate {

/// Fields{Row<0>, Row<1>, ...}, Dim of them.
template <template <int> class Row, int Dim>
constexpr auto rows_of()
{
    return []<int... k>(std::integer_sequence<int, k...>) { return Fields<Row<k>...>{}; }
    (std::make_integer_sequence<int, Dim>{});
}
/// f(row, k) for each row of such a set.
[[gnu::always_inline]] inline void each_row(auto set, auto const& f)
{
    int k = 0;
    for_each(
        set, [&](auto row) __attribute__((always_inline)) { f(row, k++); });
}

/// A = L D L^T of a symmetric matrix, lane by lane, without a branch. The pivots D are all positive if and only if A
/// is positive definite (Sylvester); where one is not, what follows from it is not finite and is not to be used.
template <int N, class V>
struct Factored {
    V l[std::size_t(N)][std::size_t(N)];
    V pivot[std::size_t(N)];

    [[gnu::always_inline]] explicit Factored(V const (&a)[std::size_t(N)][std::size_t(N)])
    {
        for (int k = 0; k < N; ++k) {
            pivot[k] = a[k][k];
            for (int c = 0; c < k; ++c) pivot[k] = pivot[k] - l[k][c] * l[k][c] * pivot[c];
            for (int r = k + 1; r < N; ++r) {
                l[r][k] = a[r][k];
                for (int c = 0; c < k; ++c) l[r][k] = l[r][k] - l[r][c] * l[k][c] * pivot[c];
                l[r][k] = l[r][k] / pivot[k];
            }
        }
    }
    [[gnu::always_inline]] void solve(V (&b)[std::size_t(N)]) const
    {
        for (int k = 0; k < N; ++k)
            for (int c = 0; c < k; ++c) b[k] = b[k] - l[k][c] * b[c];
        for (int k = N - 1; k >= 0; --k) {
            b[k] = b[k] / pivot[k];
            for (int r = k + 1; r < N; ++r) b[k] = b[k] - l[r][k] * b[r];
        }
    }
    [[nodiscard, gnu::always_inline]] V least() const
    {
        V least = pivot[0];
        for (int k = 1; k < N; ++k) least = min(pivot[k], least); // a NaN is not less: the pivot before it was 0
        return least;
    }
    [[nodiscard, gnu::always_inline]] V most() const
    {
        V most = pivot[0];
        for (int k = 1; k < N; ++k) most = max(pivot[k], most);
        return most;
    }
};

} // namespace spate
