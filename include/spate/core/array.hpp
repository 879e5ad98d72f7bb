// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Memory for columns and records: aligned to a cache line, readable a few packs past its end.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace spate {

template <class T>
struct Aligned {
    using value_type = T;
    Aligned() = default;
    template <class U>
    Aligned(Aligned<U> const&)
    {}
    T* allocate(std::size_t n)
    {
        constexpr std::size_t past_the_end = 256; // bytes: a whole-vector load may start at the last element
        return static_cast<T*>(::operator new(n * sizeof(T) + past_the_end, std::align_val_t(64)));
    }
    void deallocate(T* p, std::size_t) { ::operator delete(p, std::align_val_t(64)); }
    template <class U>
    bool operator==(Aligned<U> const&) const
    {
        return true;
    }
};
template <class T>
using Array = std::vector<T, Aligned<T>>;

} // namespace spate
