/// @file morton.h
/// Positions along a Morton curve, which interleaves the bits of three coordinates.
#pragma once

#include <bit>
#include <cstdint>

namespace fx::sim {

/// Bits per axis. A key of three axes has 63 bits.
constexpr uint32_t kMortonAxisBits = 21;
constexpr uint32_t kMortonBits = 3 * kMortonAxisBits;

/// Moves bit k of `value` (< 2^21) to bit 3 k.
inline uint64_t spreadBits(uint64_t value)
{
    value = (value | value << 32) & 0x001F00000000FFFFu;
    value = (value | value << 16) & 0x001F0000FF0000FFu;
    value = (value | value << 8) & 0x100F00F00F00F00Fu;
    value = (value | value << 4) & 0x10C30C30C30C30C3u;
    value = (value | value << 2) & 0x1249249249249249u;
    return value;
}

/// Key of a cell.
inline uint64_t mortonKey(uint32_t cellX, uint32_t cellY, uint32_t cellZ)
{
    return spreadBits(cellX) | spreadBits(cellY) << 1 | spreadBits(cellZ) << 2;
}

/// Number of the highest bit in which two keys differ, counted from 1; 0 for equal keys.
inline uint32_t differingBits(uint64_t a, uint64_t b)
{
    return uint32_t(std::bit_width(a ^ b));
}

} // namespace fx::sim
