/// @file blob_share.h
/// How much of the picture blobs cover, about: what an error in them matters.
#pragma once

#include "rendering/frame/screen_share.h"
#include "rendering/frame/view_block.h"
#include "rendering/passes/blob_instance.h"

#include <span>

namespace fx::render {

/// As if the blobs lay about at random: 1 - exp(-sum of their areas).
ScreenShare screenShare(std::span<const BlobInstance> blobs, const CameraGeometry& camera);

} // namespace fx::render
