/// @file rising_run.h
/// How a last order is mended: what still rises is kept, what has moved is merged in. Loops over whole
/// vectors, compiled for each instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fx::render {

constexpr size_t kChainBlock = 8; ///< elements of a chain that share an entry of Chain::blockEnds

/// A walk along a last order, of which what still rises is moved together at the front.
struct Chain
{
    const uint32_t* keys; ///< by element
    uint32_t* order;      ///< [0, kept) is the chain, [at, count) is still to be looked at; kept <= at
    uint32_t* blockEnds;  ///< room for a key of each block of the chain
    size_t kept;
    size_t at;
    size_t count;
    uint64_t last;   ///< key * 2^32 + element of the chain's end; 0 when it is empty
    uint64_t* aside; ///< key * 2^32 + element of those that do not fit
    size_t asideCount;
    size_t mostAside;
};

/// Goes on as long as whole vectors of elements rise, or would without one of them, and none is absent.
void keepRisingRun(Chain& chain);

/// Leaves out of a whole last order who is in the set `changed`; the rest is the chain.
/// @param changed see KeyChanges
void keepUnchanged(Chain& chain, const uint8_t* changed);

/// Puts elements among those of the chain, whose order then holds all of them.
/// @param moved key * 2^32 + element, rising  @param count room for so many is behind the chain
void mergeMoved(const Chain& chain, const uint64_t* moved, size_t count);

} // namespace fx::render
