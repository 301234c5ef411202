/// @file same_bytes.h
/// Tests whether two arrays have the same bits.
#pragma once

#include <cstring>
#include <span>
#include <type_traits>

namespace fx::base {

/// True if both arrays have the same bytes. Therefore +0 differs from -0, and padding bytes are compared too.
/// Pointers may be null when there are no elements.
template <class T>
bool sameBytes(std::span<const T> a, std::span<const T> b)
{
    static_assert(std::is_trivially_copyable_v<T>);
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

} // namespace fx::base
