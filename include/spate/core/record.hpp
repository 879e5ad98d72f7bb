// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A record: one value of each field of a set, in registers; and its layout in memory, where it is packed.
#pragma once

#include "spate/core/fields.hpp"

namespace spate {

template <class F, int Dim, class V>
struct Slot {
    Value<F, Dim, V> value;
};

/// One value of V a field (else as many as it has components); one base class a field, so that it splits into registers.
template <int Dim, class V, class S>
struct Record;
template <int Dim, class V, class... F>
struct Record<Dim, V, Fields<F...>> : Slot<F, Dim, V>... {
    static constexpr Fields<F...> fields{};
    using value_type = V;
    template <class G>
    static constexpr bool has = Fields<F...>::template contains<G>;
    template <Field G>
    [[gnu::always_inline]] auto& operator[](G)
    {
        return static_cast<Slot<G, Dim, V>&>(*this).value;
    }
    template <Field G>
    [[gnu::always_inline]] auto const& operator[](G) const
    {
        return static_cast<Slot<G, Dim, V> const&>(*this).value;
    }
};

/// Where a field lies in the packed record, and how long the record is: a multiple of 4 values, or at most 2; a long one at
/// least even.
template <int Dim, class S>
struct Layout;
template <int Dim, class... F>
struct Layout<Dim, Fields<F...>> {
    static constexpr Fields<F...> fields{};
    static constexpr int count = (0 + ... + components<F, Dim>);
    static constexpr int stride = count <= 2  ? (count == 0 ? 1 : count)
                                  : count > 8 ? (count + 1) / 2 * 2
                                              : (count + 3) / 4 * 4;
    template <class G>
    static constexpr int offset = [] {
        int at = -1, o = 0;
        ((std::same_as<F, G> ? void(at = o) : void(), o += components<F, Dim>), ...);
        return at;
    }();
};

/// The records of width<V> particles, gathered from where they lie in the packed array.
template <class V, int Dim, class... F>
[[gnu::always_inline]] inline auto gathered(scalar_t<V> const* base, std::int32_t const* at, Layout<Dim, Fields<F...>>)
{
    using L = Layout<Dim, Fields<F...>>;
    V flat[std::size_t(L::count)];
    load_records<L::stride, L::count>(base, at, flat);
    Record<Dim, V, Fields<F...>> r;
    auto one = [&]<class G>(G g) __attribute__((always_inline))
    {
        if constexpr (G::rank == 0) r[g] = flat[L::template offset<G>];
        else
            for (int c = 0; c < components<G, Dim>; ++c) r[g][c] = flat[L::template offset<G> + c];
    };
    (one(F{}), ...);
    return r;
}

template <int Dim, class V, class... F>
[[gnu::always_inline]] inline void clear(Record<Dim, V, Fields<F...>>& r)
{
    auto one = [&]<class G>(G g) __attribute__((always_inline))
    {
        if constexpr (G::rank == 0) r[g] = V(0);
        else
            for (int c = 0; c < components<G, Dim>; ++c) r[g][c] = V(0);
    };
    (one(F{}), ...);
}

} // namespace spate
