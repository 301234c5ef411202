/// @file same_bytes.h
/// Whether two arrays hold the same bits.
#pragma once

#include <cstring>
#include <span>
#include <type_traits>

namespace fx::base {

/// Compares bytes, so that +0 differs from -0 and padding bytes count. Pointers may be null when there are no
/// elements.
template <class T>
bool sameBytes(std::span<const T> a, std::span<const T> b)
{
    static_assert(std::is_trivially_copyable_v<T>);
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

} // namespace fx::base
