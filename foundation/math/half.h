/// @file half.h
/// Conversion of 32-bit floats to half floats (binary16). The vectorized conversion of the particle kernels
/// gives the same bits.
#pragma once

#include <bit>
#include <cstdint>

namespace fx::base {

/// Converts a float to a half float, rounded to nearest, ties to even. Values outside of [0, 65504] are
/// clamped; NaN becomes 0.
inline uint32_t toHalf(float x)
{
    const float bounded = x > 0.0f ? (x < 65504.0f ? x : 65504.0f) : 0.0f;
    const uint32_t bits = std::bit_cast<uint32_t>(bounded);
    if (bounded < 0x1p-14f)
        return std::bit_cast<uint32_t>(bounded + 0.5f) - (126u << 23);
    return (bits - (112u << 23) + 0xFFFu + ((bits >> 13) & 1u)) >> 13;
}

/// The value of a half float that is not negative. Infinities and NaN give values of 65536 and more.
inline float fromHalf(uint32_t half)
{
    if (half < 0x400u)
        return float(half) * 0x1p-24f; // exact: subnormal
    return std::bit_cast<float>((half << 13) + (112u << 23));
}

/// Packs a value of the column "color": red is in the lowest 16 bits, then green, blue and opacity.
inline uint64_t packHalfs(float red, float green, float blue, float opacity)
{
    return uint64_t(toHalf(red)) | uint64_t(toHalf(green)) << 16 | uint64_t(toHalf(blue)) << 32 |
           uint64_t(toHalf(opacity)) << 48;
}

} // namespace fx::base
