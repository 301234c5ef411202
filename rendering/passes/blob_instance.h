/// @file blob_instance.h
/// A blob as the GPU gets it; shaders/shared/blob_instance.glsl reads this layout.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>

namespace fx::render {

struct BlobInstance
/// xyz [m] relative to the eye, world axes; w radius [m]
{
    glm::vec4 centerRadius;
    glm::vec4 medium;  ///< x cross section [m2]; y heat [K]; z detail amount [1]; w seed of the detail [0, 1)
    glm::vec4 scatter; ///< rgb albedo; w mean cosine of the phase function
    glm::vec4 layer;   ///< x layer * 2 + share of fire
    glm::vec4 emission; ///< rgb emitted light, exposed; w power of temperature by which it follows the detail
    /// Xyz [m] where the ball is lit, relative to the eye; w noise periods across the radius, or -1 minus
    /// those of a ball in an impostor, which is lit at its center only.
    glm::vec4 lit;
};
static_assert(sizeof(BlobInstance) == 96 && offsetof(BlobInstance, lit) == 80);

/// Noise coordinates of a ball, for the detail of its field.
struct BlobMaterial
/// xyz [cell] coordinates of both generations; w of the first: number of the detail of the ball's effect + 1,
/// or 0
{
    glm::vec4 carried[2];
};
static_assert(sizeof(BlobMaterial) == 32);

/// Consecutive balls of one instance in a list.
struct BlobEffect
/// in the list
{
    uint32_t begin, end;
    glm::vec3 low, high; ///< [m] box around all of its balls, seen or not, relative to the eye, world axes
    float radius;        ///< [m] of its balls, seen or not: smaller ones have a quarter of the cross section
    int detail = -1;     ///< number of the detail of their field; -1: none
};

} // namespace fx::render
