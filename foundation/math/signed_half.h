/// @file signed_half.h
/// Conversion of floats of either sign to half floats (binary16).
#pragma once

#include "foundation/math/half.h"

#include <cmath>

namespace fx::base {

constexpr uint32_t kHalfSign = 0x8000;

/// As toHalf() for numbers of either sign; beyond 65504 they are clamped, and NaN becomes 0.
inline uint32_t toSignedHalf(float x)
{
    return toHalf(std::abs(x)) | (x < 0.0f ? kHalfSign : 0u);
}

/// Inverse of toSignedHalf().
inline float fromSignedHalf(uint32_t half)
{
    const float size = fromHalf(half & ~kHalfSign);
    return (half & kHalfSign) != 0 ? -size : size;
}

} // namespace fx::base
