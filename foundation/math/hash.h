/// @file hash.h
/// 64-bit hash of state, for determinism checks and cache keys. The hash is not cryptographic.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fx::base {

/// Mixes one word into a running hash (the finalizer of SplitMix64 [SLF14], doi:10.1145/2660193.2660195).
inline uint64_t hashWord(uint64_t hash, uint64_t word)
{
    uint64_t x = hash ^ (word + 0x9E3779B97F4A7C15u + (hash << 6) + (hash >> 2));
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

/// Mixes `size` bytes and the number `size` into a running hash. Uses XXH3 of the xxHash library, which is
/// about as fast as reading the memory.
uint64_t hashBytes(uint64_t hash, const void* data, size_t size);

} // namespace fx::base
