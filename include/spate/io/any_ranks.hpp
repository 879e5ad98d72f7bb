// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Ranks whatever their type: what states and files ask of them is compiled once. Not a transport: those are the
///        models of Ranks.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "spate/core/message.hpp"
#include "spate/core/ranks.hpp"
#include "spate/core/together.hpp"

namespace spate::io {

/// All calls but rank(), count() and communicator() are made by all ranks, in the same order.
class AnyRanks {
public:
    static constexpr bool alone = false; ///< nobody knows before the run
    [[nodiscard]] virtual int rank() const = 0;
    [[nodiscard]] virtual int count() const = 0;
    [[nodiscard]] virtual std::vector<Parcel> scatter(std::vector<Parcel> parcels) const = 0;
    [[nodiscard]] virtual bool any(bool mine) const = 0;
    virtual void sum(std::vector<std::uint64_t>& values) const = 0;  ///< each over all ranks, modulo 2^64
    virtual void together(std::function<void()> const& f) const = 0; ///< as spate::together
    /// Of processes that share one of MPI's: its Fortran handle, by which a library that knows MPI can reach them all.
    [[nodiscard]] virtual std::optional<int> communicator() const = 0;

protected:
    ~AnyRanks() = default;
};

/// These ranks, as AnyRanks or as what else is one.
template <Ranks R, class As = AnyRanks>
class TheseRanks : public As {
public:
    explicit TheseRanks(R ranks) : ranks_(std::move(ranks)) {}

    [[gnu::cold]] int rank() const final { return ranks_.rank(); }
    [[gnu::cold]] int count() const final { return ranks_.count(); }
    [[gnu::cold]] std::vector<Parcel> scatter(std::vector<Parcel> parcels) const final
    {
        return ranks_.scatter(std::move(parcels));
    }
    [[gnu::cold]] bool any(bool mine) const final { return ranks_.all(mine, agree::Or{}); }
    [[gnu::cold]] void sum(std::vector<std::uint64_t>& values) const final { ranks_.each(values, agree::Sum{}); }
    [[gnu::cold]] void together(std::function<void()> const& f) const final { spate::together(ranks_, f); }
    [[gnu::cold]] std::optional<int> communicator() const final
    {
        if constexpr (requires { ranks_.communicator(); }) return ranks_.communicator();
        else return {};
    }

private:
    R ranks_;
};

} // namespace spate::io
