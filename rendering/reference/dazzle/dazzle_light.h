/// @file dazzle_light.h
/// Light counted in integer quanta, so that the sums of the glare are exact for any size of the picture.
#pragma once

#include "rendering/passes/dazzle_pass.h"

#include <cstdint>
#include <span>

namespace fx::render {

/// [quantum] a 16K picture of 65504 needs 67 bits a channel
__extension__ typedef unsigned __int128 DazzleCount;

/// The light of one channel value.
struct DazzleQuanta
/// [quantum] above white
{
    uint64_t overflow;
    uint64_t headroom; ///< [quantum] below white
    uint64_t all;
};

/// Turns channel values into quanta as shaders/dazzle/dazzle_shared.glsl does.
class DazzleCounter
{
public:
    explicit DazzleCounter(float white);

    /// Bits of a value that is finite, not negative and at most `white` times kDazzleLargest; NaN and
    /// negative become 0, +inf 65504 (or that limit). @param ioReplaced counts the changed values
    uint32_t sanitized(uint32_t bits, uint32_t& ioReplaced) const;
    /// Quanta of a sanitized value; fractions of a quantum are dropped.
    DazzleQuanta count(uint32_t bits) const;

    const DazzleScale& scale() const { return scale_; }

private:
    DazzleScale scale_;
    double quantaPerUnit_; ///< a power of two: the product is exact
    uint32_t largest_;
    uint32_t infinity_;
};

/// Sums of one channel. Integer additions: the same in any order.
struct DazzleSum
{
    DazzleCount overflow = 0;
    DazzleCount headroom = 0;
};

struct DazzleSums
/// red, green, blue
{
    DazzleSum channels[3];
    uint32_t replaced = 0; ///< channel values that were not finite, negative or too large
};

/// Adds pixels of four floats. A picture may be added in pieces.
void addDazzleLight(std::span<const float> rgba, const DazzleCounter& counter, DazzleSums& ioSums);

} // namespace fx::render
