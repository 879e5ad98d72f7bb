// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What states are taken from and put back into, whatever the type of the scene: who keeps them is compiled once.
///        Not the scene behind it: that is io/this_scene.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeinfo>
#include <variant>
#include <vector>

#include "spate/io/any_ranks.hpp"

namespace spate::io {

/// Called with the name of each number, or vector of numbers, that a restart needs.
class Notes {
public:
    using Numbers = std::variant<bool*, std::int64_t*, float*, double*, std::vector<float>*, std::vector<double>*,
                                 std::vector<std::int32_t>*, std::vector<std::int64_t>*, std::vector<std::uint32_t>*>;

    template <class N>
    void operator()(std::string_view name, N& value) const
    {
        if constexpr (std::is_integral_v<N> && !std::same_as<N, bool>) {
            std::int64_t now = std::int64_t(value);
            note(name, &now);
            value = N(now);
        }
        else note(name, &value);
    }
    /// What follows is of the next output.
    virtual void next() {}

protected:
    ~Notes() = default;

private:
    virtual void note(std::string_view name, Numbers numbers) const = 0;
};

/// Of a scene, as it is now.
struct Facts {
    struct Corners {
        std::array<double, 3> lo{}, hi{}; ///< [m]
    };
    int dim, species;
    bool single, stopped; ///< columns are of float; a Stop has ended the run
    std::int64_t step;
    double widest_skin; ///< over the range [-]
    std::string_view criterion;
    std::vector<std::string> const* warnings;
    Corners grid;
    std::optional<Corners> walls; ///< of a box that does not grow
};

/// A scene with the outputs that go on with it, and the ranks that share it.
class AnyScene : public AnyRanks {
public:
    using Corners = Facts::Corners;
    /// Told of what a scene is put together from.
    struct Parts {
        virtual void type(std::string_view role, std::type_info const& type) = 0;
        virtual void parameter(std::string_view name, double value) = 0;
        virtual void fields(std::string const& names) = 0; ///< of the next species

    protected:
        ~Parts() = default;
    };
    /// Told of the columns of each field: of float or of double.
    struct Columns {
        virtual void field(std::string_view name, bool lasting, int components, void* const* columns) = 0;

    protected:
        ~Columns() = default;
    };
    /// Told of each patch that holds particles, where skins differ by place.
    struct Patches {
        virtual void patch(int s, std::int32_t const* place, double skin) = 0;

    protected:
        ~Patches() = default;
    };
    /// Told of what terms keep of pairs: how many numbers of each of s <- q, then pairs sorted by ids.
    struct Pairs {
        virtual void kept(int s, int q, std::size_t numbers) = 0;
        virtual void pair(std::uint32_t i, std::uint32_t j, void const* values) = 0;

    protected:
        ~Pairs() = default;
    };
    /// Told of what each patch that holds particles has cost of late, where anybody has looked.
    struct Costs {
        virtual void patch(int s, std::int32_t const* place, std::int64_t cost) = 0;

    protected:
        ~Costs() = default;
    };
    /// Asked by a scene that takes up the state of another time, on many ranks for a part of it.
    struct Past {
        struct Kept {
            std::vector<std::uint32_t> const& ids;
            void const* values;
        };
        virtual void fill() = 0; ///< puts particles and numbers into the scene
        [[nodiscard]] virtual double skin_of(int s, std::int32_t const* place) const = 0;
        /// On many ranks: of each particle that fill() has put here.
        [[nodiscard]] virtual std::vector<double> skins_of(int s) const = 0;
        /// What is known of costs, on one of many ranks.
        virtual void each_cost(Costs& told) const = 0;
        [[nodiscard]] virtual Kept kept(int s, int q, std::size_t numbers) const = 0;

    protected:
        ~Past() = default;
    };

    // Called by all ranks: prepare, parts, interrupted, particles, resume. All else is about what is here.
    [[nodiscard]] virtual bool filled() const = 0;
    [[nodiscard]] virtual bool interrupted() const = 0;
    virtual void prepare() = 0;
    [[nodiscard]] virtual Facts facts() const = 0;
    virtual void parts(Parts& told) const = 0;
    virtual void numbers(Notes const& notes) = 0;
    virtual void notes(Notes& notes) = 0;                         ///< of the outputs
    [[nodiscard]] virtual std::size_t particles(int s) const = 0; ///< on all ranks
    [[nodiscard]] virtual std::vector<std::uint32_t> const& ids(int s) const = 0;
    [[nodiscard]] virtual std::uint32_t next_id(int s) const = 0;
    virtual void set_ids(int s, std::vector<std::uint32_t> const& ids, std::uint32_t next) = 0;
    virtual void columns(int s, Columns& told) = 0;
    virtual void skins(Patches& told) const = 0;
    virtual void costs(Costs& told) const = 0;
    virtual void pairs(Pairs& told) const = 0;
    /// The places of the patches that hold n particles at x; false if one is beyond the index of a grid.
    virtual bool places(Corners const& grid, double const* x, std::size_t n, std::int32_t* place) const = 0;
    /// \param local  skins differ by place
    virtual void resume(Corners const& grid, std::string const& criterion, std::vector<std::string> warnings,
                        bool local, Past& past) = 0;

protected:
    ~AnyScene() = default;
};

} // namespace spate::io
