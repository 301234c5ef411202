/// @file blob_shading.h
/// What a blob emits, and what it scatters where no medium shadows it; the rest of its light is found when it
/// is drawn.
#pragma once

#include "rendering/media/blob_gather.h"
#include "rendering/passes/blob_instance.h"

namespace fx::render {

/// @param exposure [m2/cd] exposed value per luminance
BlobInstance shadeBlob(const GatheredBlob& blob, float exposure);

} // namespace fx::render
