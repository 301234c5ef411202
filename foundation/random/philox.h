/// @file philox.h
/// Counter-based random numbers: a pure function of key and counter, without state. So results depend on
/// neither the order of calls nor the number of threads.
///
/// @formula philox4x32-10
/// Ten rounds of a multiply-and-xor bijection on a 128-bit counter under a 64-bit key.
/// symbol   unit   meaning
///   key     1      seed of the instance
///   counter 1      (particle index low, particle index high, emitter, purpose)
/// @derivation
///   Each round multiplies two words by odd constants to 64 bits, swaps halves and xors the key,      (1)
///   then the key advances by a Weyl sequence.                                                         (2)
/// @source    [SMDS11] Salmon et al., "Parallel random numbers: as easy as 1, 2, 3",
/// doi:10.1145/2063384.2063405
/// @deviation none
/// @valid     every counter and key
/// @accuracy  integer arithmetic: equal on every machine
/// @tests     tests/foundation/test_philox.cpp
#pragma once

#include <array>
#include <cstdint>

namespace fx::base {

using Random4 = std::array<uint32_t, 4>;

/// Four independent 32-bit words for one counter value.
inline Random4 philox(Random4 counter, uint64_t key)
{
    uint32_t k0 = uint32_t(key);
    uint32_t k1 = uint32_t(key >> 32);
    for (int round = 0; round < 10; ++round) {
        const uint64_t p0 = uint64_t(0xD2511F53u) * counter[0]; // (1)
        const uint64_t p1 = uint64_t(0xCD9E8D57u) * counter[2];
        counter = {uint32_t(p1 >> 32) ^ counter[1] ^ k0, uint32_t(p1), uint32_t(p0 >> 32) ^ counter[3] ^ k1,
                   uint32_t(p0)};
        k0 += 0x9E3779B9u; // (2)
        k1 += 0xBB67AE85u;
    }
    return counter;
}

/// Converts the top 24 bits of `word` to a float in [0, 1). Every result is exact, and 1 is never reached.
inline float toUnitFloat(uint32_t word)
{
    return float(word >> 8) * 0x1.0p-24f;
}

/// Purpose of a random number. Each purpose has its own stream. Therefore a new purpose does not change the
/// numbers of other purposes.
enum class RandomPurpose : uint32_t
{
    BirthPhase,
    Position,
    Direction,
    Life,
    Attributes,
    Noise,
    Gas,
    Spin,
    Axis,
    Bursts,
    Gusts,
    Events,
};

/// Four random numbers in [0, 1) for particle `index` of emitter `emitter` of the instance with seed `seed`.
inline std::array<float, 4> randomUnit4(uint64_t seed, uint32_t emitter, uint64_t index,
                                        RandomPurpose purpose)
{
    const Random4 words = philox({uint32_t(index), uint32_t(index >> 32), emitter, uint32_t(purpose)}, seed);
    return {toUnitFloat(words[0]), toUnitFloat(words[1]), toUnitFloat(words[2]), toUnitFloat(words[3])};
}

} // namespace fx::base
