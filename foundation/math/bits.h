/// @file bits.h
/// Tests of floating-point values by their bits. Compiler options such as -ffast-math do not remove these
/// tests.
#pragma once

#include <bit>
#include <cstdint>
#include <initializer_list>

namespace fx::base {

inline bool isFinite(float x)
{
    return (std::bit_cast<uint32_t>(x) & 0x7F800000u) != 0x7F800000u;
}
inline bool isFinite(double x)
{
    return (std::bit_cast<uint64_t>(x) & 0x7FF0000000000000u) != 0x7FF0000000000000u;
}

/// True when every value is finite.
template <class T>
bool allFinite(const T* values, int count)
{
    for (int i = 0; i < count; ++i)
        if (!isFinite(values[i]))
            return false;
    return true;
}

} // namespace fx::base
