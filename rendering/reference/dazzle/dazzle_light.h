/// @file dazzle_light.h
/// Light as an integer number of quanta, so that the sums of the glare are exact for any size of the picture.
#pragma once

#include "rendering/passes/dazzle_pass.h"

#include <cstdint>
#include <span>

namespace fx::render {

/// [quantum] Sum of light in 128 bits. 64 bits do not suffice: for a 16K picture with all values 65504, the
/// sum of a channel has 67 bits.
__extension__ typedef unsigned __int128 DazzleCount;

/// One channel value, divided into light above white and headroom below white.
struct DazzleQuanta
{
    uint64_t overflow; ///< [quantum] light above white: max(value - white, 0)
    uint64_t headroom; ///< [quantum] headroom below white: max(white - value, 0)
    uint64_t all;      ///< [quantum] the channel value
};

/// Converts channel values to quanta, by the method of shaders/dazzle/dazzle_shared.glsl.
class DazzleCounter
{
public:
    explicit DazzleCounter(float white);

    /// Clamps a float, given as bits, to 0 .. `white` * kDazzleLargest, and returns the bits of the result.
    /// NaN becomes 0; +inf becomes 65504 or the upper limit, whichever is smaller. @param ioReplaced counts
    /// changed values
    uint32_t sanitized(uint32_t bits, uint32_t& ioReplaced) const;
    /// Converts a sanitized value to quanta; fractions of a quantum are dropped.
    DazzleQuanta count(uint32_t bits) const;

    const DazzleScale& scale() const { return scale_; }

private:
    DazzleScale scale_;
    /// [quantum] Quanta per unit of a channel value; a power of two, so that the product is exact.
    double quantaPerUnit_;
    uint32_t largest_;
    uint32_t infinity_;
};

/// Sums of one channel. The sums are integers, so that the order of additions does not matter.
struct DazzleSum
{
    DazzleCount overflow = 0;
    DazzleCount headroom = 0;
};

struct DazzleSums
{
    DazzleSum channels[3]; ///< red, green, blue
    /// Number of channel values that were replaced because they were not finite, negative or too large.
    uint32_t replaced = 0;
};

/// Adds pixels of four floats to the sums. The pixels of a picture may be added in several calls.
void addDazzleLight(std::span<const float> rgba, const DazzleCounter& counter, DazzleSums& ioSums);

} // namespace fx::render
