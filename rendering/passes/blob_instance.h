/// @file blob_instance.h
/// A blob as the GPU gets it; shaders/shared/blob_instance.glsl reads this layout.
#pragma once

#include <glm/vec4.hpp>

#include <cstddef>

namespace fx::render {

struct BlobInstance
{
    glm::vec4 centerRadius; ///< xyz [m] relative to the eye, world axes; w radius [m]
    glm::vec4 medium; ///< x cross section [m2]; y heat [K]; z detail amount [1]; w seed of the detail [0, 1)
    glm::vec4
        sun; ///< rgb light scattered to the eye from the sun, exposed; w noise periods across the radius
    glm::vec4 sky;      ///< rgb light scattered from everywhere else, exposed; w layer * 2 + share of fire
    glm::vec4 emission; ///< rgb emitted light, exposed; w power of temperature by which it follows the detail
};
static_assert(sizeof(BlobInstance) == 80 && offsetof(BlobInstance, emission) == 64);

} // namespace fx::render
