// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Bytes on their way from one rank to another: values are put in and taken out in the same order. All ranks run
/// the same program on like machines, so that the bytes of a value are its message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace spate {

class Message {
public:
    Message() = default;
    explicit Message(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

    template <class T>
    void put(std::span<T> values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::size_t o = bytes_.size();
        bytes_.resize(o + values.size_bytes());
        if (!values.empty()) std::memcpy(bytes_.data() + o, values.data(), values.size_bytes());
    }
    template <class T>
    void put(T const& value)
    {
        put(std::span<T const>(&value, 1));
    }
    template <class T>
    void put(std::vector<T> const& values)
    {
        put(std::uint64_t(values.size()));
        put(std::span<T const>(values));
    }
    template <class T>
    void take(std::span<T> values)
    {
        if (!values.empty()) std::memcpy(values.data(), bytes_.data() + at_, values.size_bytes());
        at_ += values.size_bytes();
    }
    template <class T>
    T take()
    {
        T value;
        take(std::span<T>(&value, 1));
        return value;
    }
    template <class T>
    std::vector<T> take_all()
    {
        std::vector<T> values(std::size_t(take<std::uint64_t>()));
        take(std::span<T>(values));
        return values;
    }
    [[nodiscard]] bool empty() const { return at_ == bytes_.size(); }
    [[nodiscard]] std::vector<std::byte> const& bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
    std::size_t at_ = 0;
};

/// A message and the rank that it goes to, or comes from.
struct Parcel {
    int rank;
    Message message;
};
/// A stretch of memory that goes to a rank, or waits for what comes from it.
struct Packet {
    int rank;
    std::span<std::byte> bytes;
};

} // namespace spate
