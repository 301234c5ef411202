/// @file blob_shading.h
/// Light of each blob: what it emits, and what it scatters of the sun, the sky and the fires.
#pragma once

#include "rendering/frame/exposure.h"
#include "rendering/frame/view_types.h"
#include "rendering/lights/effect_lights.h"
#include "rendering/lights/extinction_grid.h"
#include "rendering/media/blob_gather.h"
#include "rendering/passes/blob_instance.h"

#include <span>

namespace fx::render {

/// What the shading of one frame needs; lights are relative to the eye.
struct ShadingContext
{
    const Lighting* lighting;
    const Light* sun;
    const MediaShadow* shadow; ///< of the blob's own effect
    std::span<const BallLight> fires;
    float exposure; ///< [m2/cd] exposed value per luminance
    bool orthographic;
    glm::vec3 forward; ///< unit
};

BlobInstance shadeBlob(const GatheredBlob& blob, const ShadingContext& context);

} // namespace fx::render
