/// @file rising_run.h
/// What is done to many elements of a last order at once: loops over whole vectors, compiled for each
/// instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fx::render {

constexpr size_t kChainBlock = 16; ///< elements of a chain that share an entry of Chain::blockEnds

/// A walk along a last order, of which what still rises is moved together at the front.
struct Chain
{
    const uint32_t* keys; ///< by element
    uint32_t* order;      ///< [0, kept) is the chain, [at, count) is still to be looked at; kept <= at
    uint32_t* blockEnds;  ///< for each block of the chain, a key that is not below those of its elements
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

/// How many of order[begin, end) have key * 2^32 + element below `pair`; at most kChainBlock elements.
size_t countBelow(const Chain& chain, size_t begin, size_t end, uint64_t pair);

} // namespace fx::render
