/// @file block_noise.h
/// Noise by which the builders of blocks make irregular outlines. Equal on all machines.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace fx::sim {

/// Sum of octaves of interpolated random values at the points of a lattice; each octave has half the length
/// and half the amplitude of the one before.
class BlockNoise
{
public:
    /// @param length [m] of a cell of the largest octave, > 0 @param octaves 1..8
    BlockNoise(uint64_t seed, float length, uint32_t octaves)
        : seed_(seed), perLength_(1.0f / length), octaves_(octaves)
    {}

    /// Value in [-1, 1]; its mean is 0.
    float at(const glm::vec3& position) const;

private:
    float octaveAt(const glm::vec3& position, uint32_t octave) const;

    uint64_t seed_;
    float perLength_;
    uint32_t octaves_;
};

} // namespace fx::sim
