// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Planes that reflect particles as a mirror does light, or that grains touch: no markers.
#pragma once

#include "spate/boundary/contact.hpp"
#include "spate/boundary/periodic.hpp"
#include "spate/core/box.hpp"

#include <cmath>
#include <limits>
#include <optional>

namespace spate {

namespace detail {
template <class X>
struct IsContact : std::false_type {};
template <std::size_t N, class S, class M, class... T>
struct IsContact<ContactPart<N, S, M, T...>> : std::true_type {};
template <class X>
inline constexpr bool on_all_faces = false;
template <class M, class... T>
inline constexpr bool on_all_faces<ContactPart<0, NoSolid, M, T...>> = true;
template <class... O>
using ContactsOf = decltype(picked_of<IsContact>(std::declval<O>()...));
} // namespace detail

/// `Walls(Box<2>{...}, open(top))`: elastic walls at the faces of a box; others open or periodic. What has a radius touches
/// them with its surface, what has none with its centre. `Walls(Box<2>{...}, contact(LinearSpring{.k = 1e5}))`: walls that push
/// back as a grain would. docs/models/boundaries.md (9), (11).
template <int Dim, class Parts = std::tuple<>>
class Walls {
public:
    static constexpr bool markers = false;
    static constexpr int bounces = 8; ///< off the two planes of an axis within one step; more is a stop

    template <class... Options>
    explicit Walls(Box<Dim> box, Options... options)
        : box_(box), edges_(Edge::wall), parts_(detail::picked_of<detail::IsContact>(options...))
    {
        [[maybe_unused]] auto edge = [&](auto const& o) {
            if constexpr (!detail::IsContact<std::remove_cvref_t<decltype(o)>>::value) apply(edges_, o);
        };
        (edge(options), ...);
        for (int c = 0; c < Dim; ++c) require_positive(along_axis("Walls.box length", c), box.size()[c], "m");
        each_part([&](auto const& part) {
            for (Face f : part.faces) {
                auto& of = touched_[at(f)];
                require(!of && edges_.face[at(f)] == Edge::wall, along_axis("contact of a face", int(at(f)) / 2), 1,
                        "a face that is a wall, and named once");
                of = true;
            }
        });
    }
    template <int>
    [[nodiscard]] Edges<Dim> const& edges() const
    {
        return edges_;
    }
    template <int>
    [[nodiscard]] std::optional<Box<Dim>> box() const
    {
        return box_;
    }
    void check(double reach) const { Periodic<Dim>::check_periodic(box_, edges_, reach); }
    template <int>
    [[nodiscard]] double beyond(Vec<Dim, double> const& x) const
    {
        double far = -std::numeric_limits<double>::infinity();
        for (int c = 0; c < Dim; ++c) {
            if (edges_.at(c, false) == Edge::wall) far = std::max(far, box_.lo[c] - x[c]);
            if (edges_.at(c, true) == Edge::wall) far = std::max(far, x[c] - box_.hi[c]);
        }
        return far;
    }
    /// Where all walls reflect nothing is ever beyond; through a wall of contact a grain may be pressed.
    [[nodiscard]] double thickness(double range) const { return touches ? range / 2 : 0; }

    /// Whether any wall is one of contact, and whether all faces that are walls are.
    static constexpr bool all_touched = []<class... P>(std::tuple<P...> const*) {
        return (false || ... || detail::on_all_faces<P>);
    }(static_cast<Parts const*>(nullptr));
    static constexpr bool touches = std::tuple_size_v<Parts> > 0;
    static constexpr bool has_velocity = []<class... P>(std::tuple<P...> const*) {
        return (false || ... || !std::same_as<decltype(P::law), Still>);
    }(static_cast<Parts const*>(nullptr));
    /// The contacts as particle terms of a model.
    template <class P>
    [[nodiscard]] auto terms(P const& physics) const requires(touches)
    {
        return [&]<std::size_t... k>(std::index_sequence<k...>)
        {
            return std::tuple{term_of<int(k)>(physics.interaction, std::get<k>(parts_))...};
        }
        (std::make_index_sequence<std::tuple_size_v<Parts>>{});
    }

    /// The planes that reflect, in registers to ask for many particles.
    template <class V>
    struct Mirrors {
        Vec<Dim, V> least, most;

        /// Whether any lane is through one.
        [[nodiscard, gnu::always_inline]] bool any_beyond(Vec<Dim, V> const& x, V const& r) const
        {
            auto beyond = (x[0] - r < least[0]) | (x[0] + r > most[0]);
            for (int c = 1; c < Dim; ++c) beyond = beyond | (x[c] - r < least[c]) | (x[c] + r > most[c]);
            return spate::any(beyond);
        }
    };
    template <class V>
    [[nodiscard]] Mirrors<V> mirrors() const
    {
        Mirrors<V> m;
        for (int c = 0; c < Dim; ++c) m.least[c] = V(least(c, 0)), m.most[c] = V(most(c, 0));
        return m;
    }
    enum class Bounce { none, some, too_many };
    /// x <- 2 wall - x and the outward velocity inwards, until x is inside.
    /// \param r  radius [m]
    Bounce reflect(Vec<Dim, double>& x, Vec<Dim, double>& v, double r) const requires(!all_touched)
    {
        Bounce b = Bounce::none;
        for (int c = 0; c < Dim; ++c) {
            const double lo = least(c, r), hi = most(c, r);
            for (int k = 0; x[c] < lo || x[c] > hi; ++k) {
                if (k == bounces) return Bounce::too_many;
                const bool below = x[c] < lo;
                x[c] = 2 * (below ? lo : hi) - x[c];
                v[c] = below ? std::abs(v[c]) : -std::abs(v[c]);
                b = Bounce::some;
            }
        }
        return b;
    }

private:
    [[nodiscard]] double least(int c, double r) const
    {
        return reflects(c, false) ? box_.lo[c] + r : -std::numeric_limits<double>::infinity();
    }
    [[nodiscard]] double most(int c, double r) const
    {
        return reflects(c, true) ? box_.hi[c] - r : std::numeric_limits<double>::infinity();
    }
    [[nodiscard]] bool reflects(int c, bool upper) const
    {
        return edges_.at(c, upper) == Edge::wall && !all_touched && !touched_[std::size_t(2 * c + upper)];
    }
    static std::size_t at(Face f) { return std::size_t(2 * axis_of<Dim>(f) + f.upper); }
    void each_part(auto const& f) const
    {
        std::apply([&](auto const&... part) { (f(part), ...); }, parts_);
    }
    template <int k, class I, std::size_t N, class S, class M, class... T>
    [[nodiscard]] auto term_of(I const& interaction, ContactPart<N, S, M, T...> const& part) const
    {
        static_assert(std::same_as<M, Still> || Motion<M, Dim>,
                      "spate: the law of a wall has another number of dimensions than the box of the Walls");
        auto with = [&](auto surface) {
            WallContact<I, decltype(surface), M, k * Dim, T...> term{interaction, surface, part.law, part.terms};
            if constexpr (term.moves) term.move_to(0);
            return term;
        };
        if constexpr (std::same_as<S, NoSolid>) {
            Planes<Dim> planes{box_};
            if (N == 0)
                for (std::size_t f = 0; f < planes.on.size(); ++f)
                    planes.on[f] = edges_.face[f] == Edge::wall && !touched_[f];
            for (Face f : part.faces) planes.on[at(f)] = true;
            return with(planes);
        }
        else return with(Surface<S>{part.solid});
    }

    Box<Dim> box_;
    Edges<Dim> edges_;
    Parts parts_;
    std::array<bool, std::size_t(2 * Dim)> touched_{}; ///< by a part that names the face
};
template <int Dim, class... Options>
Walls(Box<Dim>, Options...) -> Walls<Dim, detail::ContactsOf<Options...>>;

} // namespace spate
