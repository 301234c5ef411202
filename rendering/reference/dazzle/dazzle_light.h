/// @file dazzle_light.h
/// Light as an integer number of quanta, so that the sums of the glare are exact for any size of the picture.
#pragma once

#include "rendering/passes/dazzle_pass.h"

#include <cstdint>
#include <span>

namespace fx::render {

/// [quantum] the sum of a 16K picture with all values 65504 needs 67 bits per channel
__extension__ typedef unsigned __int128 DazzleCount;

/// Light of one channel value.
struct DazzleQuanta
{
    uint64_t overflow; ///< [quantum] value - white, or 0
    uint64_t headroom; ///< [quantum] white - value, or 0
    uint64_t all;      ///< [quantum] value
};

/// Converts channel values to quanta, like shaders/dazzle/dazzle_shared.glsl.
class DazzleCounter
{
public:
    explicit DazzleCounter(float white);

    /// Bits of the value clamped to 0 .. `white` * kDazzleLargest. NaN becomes 0, +inf becomes 65504 (or the
    /// upper limit, if that is smaller). @param ioReplaced counts changed values
    uint32_t sanitized(uint32_t bits, uint32_t& ioReplaced) const;
    /// Quanta of a sanitized value; fractions of a quantum are dropped.
    DazzleQuanta count(uint32_t bits) const;

    const DazzleScale& scale() const { return scale_; }

private:
    DazzleScale scale_;
    double quantaPerUnit_; ///< a power of two, so that the product is exact
    uint32_t largest_;
    uint32_t infinity_;
};

/// Sums of one channel. They are integers, so that the order of additions does not matter.
struct DazzleSum
{
    DazzleCount overflow = 0;
    DazzleCount headroom = 0;
};

struct DazzleSums
{
    DazzleSum channels[3]; ///< red, green, blue
    uint32_t replaced = 0; ///< channel values that were not finite, negative or too large
};

/// Adds pixels of four floats to the sums. A picture may be added in several calls.
void addDazzleLight(std::span<const float> rgba, const DazzleCounter& counter, DazzleSums& ioSums);

} // namespace fx::render
