/// @file blob_shading.h
/// Emitted light of a blob, and its scattered light without shadows of media. Other light is computed when it
/// is drawn.
#pragma once

#include "rendering/media/blob_gather.h"
#include "rendering/passes/blob_instance.h"

namespace fx::render {

/// @param exposure [m2/cd] exposed value per luminance
BlobInstance shadeBlob(const GatheredBlob& blob, float exposure);

} // namespace fx::render
