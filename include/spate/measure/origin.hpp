// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Where a value that is not finite comes from: steps are run again, and of the first evaluation that makes one,
/// the first term whose inputs are finite and whose output is not. Cold: nothing of it runs before something went wrong.
#pragma once

#include "spate/core/term.hpp"
#include "spate/measure/nearest_image.hpp"

#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace spate {

/// What made a value that is not finite; no term where it was not one: the sum of a step overflowed, or a hand did it.
struct Origin {
    std::string term;                                        ///< type of the term
    int species = -1;                                        ///< of whom it made the value
    std::int64_t particle = -1;                              ///< its id
    double position[3] = {0, 0, 0}, velocity[3] = {0, 0, 0}; ///< there and then [m], [m/s]
    std::int64_t other = -1;                                 ///< id of the neighbour of whom it made the value
    bool at_one_place = false; ///< the two are at one place, where a contact has no normal
};

namespace detail {
/// The name of a type without its namespace: Continuity<2>.
template <class T>
[[gnu::cold]] std::string type_name()
{
    const std::string_view whole = __PRETTY_FUNCTION__;
    const std::size_t at = whole.find("T = ") + 4, end = whole.find_first_of(";]", at);
    std::string name(whole.substr(at, end - at));
    for (const std::string own : {"spate::", "{anonymous}::", "(anonymous namespace)::"})
        for (std::size_t k = name.find(own); k != std::string::npos; k = name.find(own)) name.erase(k, own.size());
    return name;
}
/// One particle alone, as any term sees it; what else a term may ask of a pair is zero.
template <int Dim, class V, class S>
struct Bare {
    using R = Record<Dim, V, S>;
    R record;

    template <Field F>
    auto& operator[](F f)
    {
        if constexpr (R::template has<F>) return record[f];
        else return nothing<F>();
    }
    template <Field F>
    auto const& operator[](F f) const
    {
        if constexpr (R::template has<F>) return record[f];
        else return nothing<F>();
    }
    template <class... F>
    void clear(Fields<F...>)
    {
        [[maybe_unused]] auto one = [&]<class G>(G g) {
            if constexpr (G::rank == 0) (*this)[g] = V(0);
            else
                for (auto& component : (*this)[g].c) component = V(0);
        };
        (one(F{}), ...);
    }
    template <class... F>
    [[nodiscard]] bool finite(Fields<F...>) const
    {
        [[maybe_unused]] auto one = [&]<class G>(G g) {
            if constexpr (G::rank == 0) return is_finite((*this)[g]);
            else {
                bool all = true;
                for (auto const& component : (*this)[g].c) all = all && is_finite(component);
                return all;
            }
        };
        return (true && ... && one(F{}));
    }

private:
    static bool is_finite(V const& value)
    {
        scalar_t<V> lane;
        store(&lane, value);
        return std::isfinite(double(lane));
    }
    template <class F>
    static auto& nothing()
    {
        thread_local Value<F, Dim, V> zero{};
        return zero;
    }
};
} // namespace detail

/// A system that looks at what each evaluation made: an integrator's step on it ends with the origin, if there was one.
template <class Engine>
class Replay : public Engine {
    using M = typename Engine::M;
    using T = typename Engine::T;
    using V = Scalar<T>;
    static constexpr int dim = Engine::dim;
    static constexpr std::size_t enough = 1000; ///< particles to ask

public:
    explicit Replay(Engine&& engine) : Engine(std::move(engine)) {}
    [[nodiscard]] bool found() const { return found_; }
    [[nodiscard]] Origin const& origin() const { return origin_; }

    template <class... A>
    [[gnu::cold]] void rates(A... asked)
    {
        const bool before = found_ || !good_state();
        Engine::rates(asked...);
        if (!before) look();
    }

private:
    template <int s>
    auto const& of() const
    {
        return this->template species<s>().particles;
    }
    template <int s>
    [[nodiscard]] bool good(std::size_t i, auto fields) const
    {
        bool all = true;
        for_each(fields & of<s>().fields, [&](auto f) {
            for (auto const& column : of<s>().column(f)) all = all && std::isfinite(double(column[i]));
        });
        return all;
    }
    [[nodiscard]] bool good_state() const
    {
        bool all = true;
        this->each_species([&](auto s) {
            for (std::size_t i = 0; i < of<s()>().size(); ++i)
                all = all && this->template good<s()>(i, M::template evolving<s()>());
        });
        return all;
    }
    /// From the bad particle of least id to its bad neighbours, and theirs, until one of them has a term to blame.
    void look()
    {
        std::vector<std::pair<int, std::size_t>> ask;
        std::set<std::pair<int, std::size_t>> asked;
        this->each_species([&](auto s) {
            auto const& p = of<s()>();
            std::size_t first = p.size();
            for (std::size_t i = 0; i < p.size(); ++i)
                if (!this->template good<s()>(i, p.fields) && (first == p.size() || p.id()[i] < p.id()[first]))
                    first = i;
            if (first < p.size()) ask.emplace_back(s(), first);
        });
        found_ = !ask.empty();
        for (std::size_t k = 0; k < ask.size() && k < enough; ++k) {
            const auto [species, i] = ask[k];
            if (!asked.insert(ask[k]).second) continue;
            bool blamed = false;
            this->each_species([&, species = species, i = i](auto s) {
                if (s() == species) blamed = this->template blame<s()>(i, ask);
            });
            if (blamed) return;
        }
    }
    /// Whether a term made something of particle i that is not finite, out of finite inputs; else its bad neighbours follow.
    template <int s>
    bool blame(std::size_t i, std::vector<std::pair<int, std::size_t>>& ask)
    {
        std::array<std::vector<std::size_t>, 2> near;
        const double range = this->physics().interaction.range();
        this->each_species([&](auto q) {
            for (std::size_t j = 0; j < of<q()>().size(); ++j) {
                if (s == q() && i == j) continue;
                if (!(way<s, q()>(i, j).squaredNorm() < range * range)) continue;
                near[std::size_t(q())].push_back(j);
                if (!this->template good<q()>(j, of<q()>().fields)) ask.emplace_back(q(), j);
            }
        });
        return [&]<std::size_t... k>(std::index_sequence<k...>)
        {
            return (false || ... || this->template made_by<s, int(k)>(i, near));
        }
        (std::make_index_sequence<std::size_t(M::terms)>{});
    }
    template <int s, int k>
    bool made_by(std::size_t i, std::array<std::vector<std::size_t>, 2> const& near)
    {
        using Term = std::tuple_element_t<std::size_t(k), typename M::Terms>;
        if constexpr (M::planner.on(k, s) && M::planner.term[std::size_t(k)].when == When::evaluation) {
            auto const& term = std::get<std::size_t(k)>(this->terms());
            constexpr auto changes = spate::adds<Term>() | spate::writes<Term>();
            auto mine = bare<s>(i);
            if (!mine.finite(reads_i<Term>())) return false;
            mine.clear(spate::adds<Term>());
            if constexpr (PairTerm<Term>) {
                bool made = false;
                this->each_species([&](auto q) {
                    if constexpr (M::planner.from(k, s, q())) {
                        for (const std::size_t j : near[std::size_t(q())])
                            made = made || this->template made_with<s, q(), Term>(term, mine, i, j);
                    }
                });
                if (!made) return false;
            }
            else {
                term(mine);
                if (mine.finite(changes)) return false;
            }
            origin_.term = detail::type_name<Term>();
            origin_.species = s, origin_.particle = of<s>().id()[i];
            for (int c = 0; c < dim; ++c) {
                origin_.position[c] = of<s>().at(position, i)[c];
                if constexpr (std::remove_cvref_t<decltype(of<s>())>::template has<Velocity>)
                    origin_.velocity[c] = of<s>().at(velocity, i)[c];
            }
            return true;
        }
        else return false;
    }
    template <int s, int q, class Term>
    bool made_with(Term const& term, auto& mine, std::size_t i, std::size_t j)
    {
        auto theirs = bare<q>(j);
        const auto x = way<s, q>(i, j);
        for (int c = 0; c < dim; ++c) theirs[position][c] = V(T(double(of<s>().at(position, i)[c]) - x[c]));
        if (!theirs.finite(reads_j<Term>())) return false;
        const auto ij = this->physics().interaction.template pair<V>(mine, theirs);
        if constexpr (requires { ij.mask; })
            if (!spate::any(ij.mask)) return false;
        term(mine, theirs, ij);
        if (mine.finite(spate::adds<Term>())) return false;
        origin_.other = of<q>().id()[j];
        origin_.at_one_place = x.squaredNorm() == 0;
        return true;
    }
    /// x_i - x_j, of the nearest image.
    template <int s, int q>
    Vec<dim, double> way(std::size_t i, std::size_t j) const
    {
        return nearest_image<dim>(of<s>().at(position, i) - of<q>().at(position, j), this->grid());
    }
    template <int s>
    auto bare(std::size_t i) const
    {
        constexpr auto kept = []<class... X>(std::tuple<X...> const*) {
            return (Fields<>{} | ... | keeps<X>());
        }(static_cast<typename M::Terms const*>(nullptr));
        constexpr auto fields = M::template stored<s>() | M::template uniform<s>() | kept;
        detail::Bare<dim, V, Set<fields>> b;
        spate::clear(b.record);
        auto one = [&](auto f) {
            const auto value = of<s>().at(f, i);
            if constexpr (decltype(f)::rank == 0) b[f] = V(T(value));
            else
                for (int c = 0; c < components<decltype(f), dim>; ++c) b[f][c] = V(T(value[c]));
        };
        for_each(M::template stored<s>() | M::template uniform<s>(), one);
        return b;
    }

    Origin origin_;
    bool found_ = false;
};

} // namespace spate
