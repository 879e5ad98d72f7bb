// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The particles of one species: a column (SoA) for each component of each stored field, one value for a uniform
/// field, and an id. Not a search structure: who is near whom is cells/.
#pragma once

#include "spate/core/array.hpp"
#include "spate/core/in_parts.hpp"
#include "spate/core/record.hpp"

#include <algorithm>
#include <string>

namespace spate {

/// `Uniform{mass, 1e-3}`: one value for the whole species; no array, no place in a record. Terms do not know.
template <Field F>
struct Uniform {
    F field;
    double value; ///< in the field's unit, each component
};
template <Field F>
Uniform(F, double) -> Uniform<F>;

namespace detail { // of one column: compiled once, not for each field
template <class T>
[[gnu::noinline]] void permute(T const* from, std::vector<std::int32_t> const& order, T* to, std::size_t first,
                               std::size_t last)
{
    for (std::size_t k = first; k < last; ++k) to[k] = from[std::size_t(order[k])];
}
template <class T>
[[gnu::noinline]] void fill_from(Array<T>& a, std::size_t first, T value)
{
    std::fill(a.begin() + std::ptrdiff_t(first), a.end(), value);
}
/// New elements, and old ones from a place on, become zero.
template <class T>
[[gnu::noinline]] void resize(Array<T>& a, std::size_t n, std::size_t zero_from)
{
    a.resize(n);
    std::fill(a.begin() + std::ptrdiff_t(zero_from), a.end(), T(0));
}
/// Room that growth has left, where it is more than a sixteenth.
[[gnu::noinline]] void give_back(auto& a)
{
    if (a.capacity() - a.size() > a.size() / 16) a.shrink_to_fit();
}
} // namespace detail

template <int Dim, Real T, class Stored, class Uniforms>
class Particles;

template <int Dim, Real T, class... F, class... U>
class Particles<Dim, T, Fields<F...>, Fields<U...>> {
public:
    static constexpr int dim = Dim;
    using real = T;
    static constexpr Fields<F...> fields{};
    static constexpr Fields<U...> uniform{};
    static constexpr int padding = 32; ///< columns are whole packs, and one pack may start at the last particle

    [[nodiscard]] std::size_t size() const { return id_.size(); }
    [[nodiscard]] bool empty() const { return id_.empty(); }

    /// n particles, new ones zero; ids of new ones continue from the largest.
    void resize(std::size_t n)
    {
        const std::size_t old = size();
        id_.resize(n);
        for (std::size_t i = old; i < n; ++i) id_[i] = next_id_++;
        fit(std::min(old, n));
    }
    /// The Dim (or 1) columns of a field; column(f)[c][i] is component c of particle i.
    template <Field G>
    auto& column(G)
    {
        return static_cast<Column<G>&>(all_).c;
    }
    template <Field G>
    auto const& column(G) const
    {
        return static_cast<Column<G> const&>(all_).c;
    }
    /// The value of a uniform field, each component.
    template <Field G>
    double& value(G)
    {
        return static_cast<One<G>&>(ones_).value;
    }
    template <Field G>
    double value(G) const
    {
        return static_cast<One<G> const&>(ones_).value;
    }
    /// Whether the field is stored or uniform here.
    template <Field G>
    static constexpr bool has = Fields<F..., U...>::template contains<G>;

    /// Field g of particle i, stored or uniform, as double.
    template <Field G>
    auto at(G g, std::size_t i) const
    {
        Value<G, Dim, double> v;
        if constexpr (Fields<U...>::template contains<G>) {
            if constexpr (G::rank == 0) v = value(g);
            else
                for (int c = 0; c < components<G, Dim>; ++c) v[c] = value(g);
        }
        else if constexpr (G::rank == 0) v = double(column(g)[0][i]);
        else
            for (int c = 0; c < components<G, Dim>; ++c) v[c] = double(column(g)[c][i]);
        return v;
    }
    template <Field G>
    void put(G g, std::size_t i, Value<G, Dim, double> const& v)
    {
        if constexpr (G::rank == 0) column(g)[0][i] = T(v);
        else
            for (int c = 0; c < components<G, Dim>; ++c) column(g)[c][i] = T(v[c]);
    }

    template <class V, Field G>
    [[gnu::always_inline]] Value<G, Dim, V> load_at(G g, std::size_t i) const
    {
        if constexpr (Fields<U...>::template contains<G>) {
            Value<G, Dim, V> v;
            if constexpr (G::rank == 0) v = V(value(g));
            else
                for (int c = 0; c < components<G, Dim>; ++c) v[c] = V(value(g));
            return v;
        }
        else {
            auto const& a = source_of(g);
            if constexpr (G::rank == 0) return load_lanes<V, G>(a[0].data() + i);
            else {
                Value<G, Dim, V> v;
                for (int c = 0; c < components<G, Dim>; ++c) v[c] = load_lanes<V, G>(a[c].data() + i);
                return v;
            }
        }
    }
    template <class V, Field G>
    [[gnu::always_inline]] void store_at(G g, std::size_t i, Value<G, Dim, V> const& v, int lanes = width<V>)
    {
        auto& a = column(g);
        if constexpr (G::rank == 0) store_lanes(a[0].data() + i, v, lanes);
        else
            for (int c = 0; c < components<G, Dim>; ++c) store_lanes(a[c].data() + i, v[c], lanes);
    }
    /// The record of particles i, i + 1, ...
    template <class V, class... G>
    [[gnu::always_inline]] auto record_at(Fields<G...>, std::int32_t i) const
    {
        Record<Dim, V, Fields<G...>> r;
        ((r[G{}] = load_at<V>(G{}, std::size_t(i))), ...);
        return r;
    }
    /// The record of particles first + target[0], first + target[1], ...
    template <class V, class... G>
    [[gnu::always_inline]] auto record_of(Fields<G...>, std::int32_t first, std::int32_t const* target) const
    {
        Record<Dim, V, Fields<G...>> r;
        auto one = [&]<class X>(X g) __attribute__((always_inline))
        {
            auto const& a = source_of(g);
            auto const at = [target](int l) __attribute__((always_inline)) { return target[l]; };
            if constexpr (X::rank == 0) r[g] = lanes_of<V, X>(a[0].data() + first, at);
            else
                for (int c = 0; c < components<X, Dim>; ++c) r[g][c] = lanes_of<V, X>(a[c].data() + first, at);
        };
        (one(G{}), ...);
        return r;
    }
    /// Stores the first `lanes` lanes of a field at particles first + target[0], ...
    template <class V, Field G>
    [[gnu::always_inline]] void store_of(G g, std::int32_t first, std::int32_t const* target, Value<G, Dim, V> const& v,
                                         int lanes)
    {
        auto one = [&](T * a, V const& x) __attribute__((always_inline))
        {
            alignas(64) scalar_t<V> lane[std::size_t(width<V>)];
            store(lane, x);
            for (int l = 0; l < lanes; ++l) a[target[l]] = T(lane[l]);
        };
        auto& a = column(g);
        if constexpr (G::rank == 0) one(a[0].data() + first, v);
        else
            for (int c = 0; c < components<G, Dim>; ++c) one(a[c].data() + first, v[c]);
    }
    /// Brings a line of each column into the cache.
    [[gnu::always_inline]] void ask_for(std::size_t i) const
    {
        for_each(
            fields, [&](auto f) __attribute__((always_inline)) {
                for (auto const& a : column(f)) __builtin_prefetch(a.data() + i);
            });
    }
    template <class V>
    [[gnu::always_inline]] auto uniforms() const
    {
        Record<Dim, V, Fields<U...>> r;
        [[maybe_unused]] auto one = [&]<class G>(G g) {
            if constexpr (G::rank == 0) r[g] = V(value(g));
            else
                for (int c = 0; c < components<G, Dim>; ++c) r[g][c] = V(value(g));
        };
        (one(U{}), ...);
        return r;
    }

    [[nodiscard]] std::vector<std::uint32_t> const& id() const { return id_; }
    /// The id of the next new particle.
    [[nodiscard]] std::uint32_t next_id() const { return next_id_; }
    /// Sets the ids; only for set-up and for input, they are unique in a species.
    /// \param next  the id of the next new one, if it is not the one after the largest
    void set_ids(std::vector<std::uint32_t> id, std::uint32_t next = 0)
    {
        id_ = std::move(id);
        next_id_ = std::max(next, id_.empty() ? 0 : *std::max_element(id_.begin(), id_.end()) + 1);
    }

    /// Particle k becomes what particle order[k] was. \param in_parts  how loops are shared: core/in_parts.hpp
    void permute(std::vector<std::int32_t> const& order, auto const& in_parts)
    {
        const auto one = [&](auto& a, auto& room) {
            room.resize(a.size()); // with the padding
            in_parts(order.size(), [&](std::size_t first, std::size_t last) {
                detail::permute(a.data(), order, room.data(), first, last);
            });
            a.swap(room);
        };
        Array<T> room;
        for_each(fields, [&](auto f) {
            for (auto& a : column(f)) one(a, room);
        });
        std::vector<std::uint32_t> ids;
        one(id_, ids);
        id_.resize(order.size());
        pad();
    }
    void permute(std::vector<std::int32_t> const& order) { permute(order, InOnePart{}); }
    /// Only particles order[0], order[1], ... remain.
    void keep(std::vector<std::int32_t> const& order)
    {
        permute(order);
        fit(order.size());
    }
    /// Room for particles of given ids, all else zero; ids of later new ones are not changed by them.
    void append(std::vector<std::uint32_t> const& ids)
    {
        const std::size_t old = size();
        id_.insert(id_.end(), ids.begin(), ids.end());
        fit(old);
    }
    /// So many ids are taken by particles elsewhere.
    void skip_ids(std::size_t n) { next_id_ += std::uint32_t(n); }
    /// Fills the padding with copies of the last particle, so that a whole pack computes with physical values.
    void pad()
    {
        if (empty()) return;
        for_each(fields, [&](auto f) {
            for (auto& a : column(f)) detail::fill_from(a, size(), a[size() - 1]);
        });
    }
    /// Gives back room that growth one by one has left.
    void fit()
    {
        for_each(fields, [&](auto f) {
            for (auto& a : column(f)) detail::give_back(a);
        });
        detail::give_back(id_);
    }
    /// Bytes in use by columns and ids.
    [[nodiscard]] std::size_t bytes() const
    {
        std::size_t b = id_.capacity() * sizeof(std::uint32_t);
        for_each(fields, [&](auto f) {
            for (auto const& a : column(f)) b += a.capacity() * sizeof(T);
        });
        return b;
    }

    /// What a record of S holds of a stored value; position_tail is what S loses of the position.
    template <class S, class G>
    [[gnu::always_inline]] static S rounded(T x)
    {
        if constexpr (is_tail<G>) return S(x - T(S(x)));
        else return S(x);
    }
    /// The columns from which a record takes a field.
    template <class G>
    [[gnu::always_inline]] auto const& source_of(G g) const
    {
        if constexpr (is_tail<G>) return column(position);
        else return column(g);
    }

private:
    /// Columns as long as there are particles; zero from a place on: the padding was not zero.
    void fit(std::size_t zero_from)
    {
        const std::size_t whole = (size() + std::size_t(2 * padding) - 1) / std::size_t(padding) * std::size_t(padding);
        for_each(fields, [&](auto f) {
            for (auto& a : column(f)) detail::resize(a, whole, zero_from);
        });
    }
    template <class G>
    static constexpr bool is_tail = std::same_as<G, PositionTail>;
    template <class V>
    [[gnu::always_inline]] static void store_lanes(T* a, V const& v, int lanes)
    {
        if constexpr (std::same_as<scalar_t<V>, T>) store_first(a, v, lanes);
        else {
            alignas(64) scalar_t<V> lane[std::size_t(width<V>)];
            store(lane, v);
            for (int l = 0; l < lanes; ++l) a[l] = T(lane[l]);
        }
    }
    /// One element after the other, as V has them.
    template <class V, class G>
    [[gnu::always_inline]] static V load_lanes(T const* a)
    {
        if constexpr (std::same_as<scalar_t<V>, T> && !is_tail<G>) return load<V>(a);
        else return lanes_of<V, G>(a, [](int l) { return l; });
    }
    /// Elements at(0), at(1), ... of a column.
    template <class V, class G>
    [[gnu::always_inline]] static V lanes_of(T const* a, auto const& at)
    {
        alignas(64) scalar_t<V> lane[std::size_t(width<V>)];
        for (int l = 0; l < width<V>; ++l) lane[l] = rounded<scalar_t<V>, G>(a[at(l)]);
        return load<V>(lane);
    }
    template <class G>
    struct Column {
        Array<T> c[std::size_t(components<G, Dim>)];
    };
    template <class G>
    struct One {
        double value = 0;
    };
    struct All : Column<F>... {
    } all_;
    struct Ones : One<U>... {
    } ones_;
    std::vector<std::uint32_t> id_;
    std::uint32_t next_id_ = 0;
};

} // namespace spate
