/// @file blob_shading.h
/// What a blob emits, and what it scatters where no medium shadows it; the rest of its light is found when it
/// is drawn.
#pragma once

#include "rendering/frame/exposure.h"
#include "rendering/frame/view_types.h"
#include "rendering/media/blob_gather.h"
#include "rendering/passes/blob_instance.h"

namespace fx::render {

/// What the shading of one frame needs.
struct ShadingContext
{
    const Lighting* lighting;
    float exposure; ///< [m2/cd] exposed value per luminance
};

BlobInstance shadeBlob(const GatheredBlob& blob, const ShadingContext& context);

} // namespace fx::render
