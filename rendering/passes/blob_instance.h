/// @file blob_instance.h
/// A blob in the layout of shaders/shared/blob_instance.glsl.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>

namespace fx::render {

struct BlobInstance
{
    glm::vec4 centerRadius; ///< xyz [m] position relative to the eye, along world axes; w radius [m]
    glm::vec4 medium;  ///< x cross section [m2]; y heat [K]; z detail amount [1]; w seed of the detail [0, 1)
    glm::vec4 scatter; ///< rgb albedo; w mean cosine of the phase function
    /// x number of the layer times 2, plus the share of fire; y rank [0, 1) by which balls are chosen where a
    /// list has no room for all: uniform, independent of other properties, and the same in all frames;
    /// z number of the tile + 1 that the extinction follows instead of the kernel, 0: the kernel
    glm::vec4 layer;
    /// rgb emitted light, exposed; w exponent of the factor of detail (temperature factor)^w for the emission
    glm::vec4 emission;
    /// xyz [m] point at which the ball is lit, relative to the eye; w periods of noise per radius. For a
    /// ball in an impostor, w is -1 minus the number of periods, and the ball is lit at its center only.
    glm::vec4 lit;
};
static_assert(sizeof(BlobInstance) == 96 && offsetof(BlobInstance, lit) == 80);

/// Noise coordinates of a ball, for the detail of its field.
struct BlobMaterial
{
    /// xyz [cell] offsets of the noise coordinates of both generations. carried[0].w is the index of the
    /// detail of the ball's effect + 1, or 0 without detail.
    glm::vec4 carried[2];
};
static_assert(sizeof(BlobMaterial) == 32);

/// Consecutive balls of one instance in a list.
struct BlobEffect
{
    uint32_t begin, end; ///< range of the balls in the list
    /// [m] Bounds of all balls of the instance, visible or not, relative to the eye, along world axes.
    glm::vec3 low, high;
    /// [m] quantile of the radii: a quarter of the total cross section is in balls with smaller radii
    float radius;
    int detail = -1; ///< index of the detail of the balls' field; -1: no detail
    int volume = -1; ///< index of the volume that the balls stand for; -1: none
};

} // namespace fx::render
