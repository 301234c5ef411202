/// @file same_bytes.h
/// Whether two arrays hold the same bits.
#pragma once

#include <cstring>
#include <span>
#include <type_traits>

namespace fx::base {

/// Zeros of both signs differ, and so may padding. No elements may have a null pointer.
template <class T>
bool sameBytes(std::span<const T> a, std::span<const T> b)
{
    static_assert(std::is_trivially_copyable_v<T>);
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

} // namespace fx::base
